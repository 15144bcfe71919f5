// The published curves and the equilibrium against OpenSim's own results on its models, muscle by
// muscle and frame by frame. Skipped where the data are not there (see ../shared/data).

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/muscle/musculotendon.h"

#include "tests/support/data_folder.h"
#include "tests/support/places.h"

namespace myoid::muscle {
namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// The number between <tag> and </tag>, if the block has one.
double number(const std::string& block, const std::string& tag, double otherwise) {
  const std::size_t at = block.find('<' + tag + '>');
  if (at == std::string::npos) return otherwise;
  return std::strtod(block.c_str() + at + tag.size() + 2, nullptr);
}

/// Every element <type name="...">...</type> of a model file: name and inner text.
std::map<std::string, std::string> elements(const std::string& model, const std::string& type) {
  std::map<std::string, std::string> found;
  const std::string head = '<' + type + " name=\"";
  for (std::size_t at = model.find(head); at != std::string::npos; at = model.find(head, at + 1)) {
    const std::size_t name = at + head.size();
    const std::size_t end = model.find("</" + type + '>', at);
    found[model.substr(name, model.find('"', name) - name)] = model.substr(at, end - at);
  }
  return found;
}

/// Columns of a .sto file by name.
std::map<std::string, std::vector<double>> columns(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  while (std::getline(stream, line) && line.find("endheader") == std::string::npos) {
  }
  std::getline(stream, line);
  std::vector<std::string> names;
  std::istringstream head(line);
  for (std::string name; head >> name;) names.push_back(name);
  std::map<std::string, std::vector<double>> result;
  while (std::getline(stream, line)) {
    std::istringstream row(line);
    double value = 0.0;
    for (const std::string& name : names) {
      if (row >> value) result[name].push_back(value);
    }
  }
  return result;
}

struct OpenSimMuscle {
  MusculotendonParameters<double> parameters;
  MusculotendonLaws laws;
  MillardShape millard;
  double activation = 0.0;
  bool rigid = false;
};

OpenSimMuscle muscle_of(const std::string& block, bool thelen) {
  HillParameters<double> hill;
  hill.max_isometric_force_n = number(block, "max_isometric_force", 1000.0);
  const double l0 = hill.optimal_fiber_length_m = number(block, "optimal_fiber_length", 0.1);
  hill.tendon_slack_length_m = number(block, "tendon_slack_length", 0.2);
  hill.max_shortening_speed_mps = l0 * number(block, "max_contraction_velocity", 10.0);
  hill.force_length_width_m = l0 * std::sqrt(number(block, "KshapeActive", 0.45));
  hill.concentric_curvature = number(block, "Af", 0.25);
  hill.eccentric_curvature_product = 0.05;
  hill.eccentric_plateau = number(block, "Flen", 1.4);
  OpenSimMuscle m;
  m.laws = thelen ? thelen_laws() : millard_laws();
  m.parameters = published_defaults(hill, m.laws);
  m.parameters.pennation_at_optimal_rad = number(block, "pennation_angle_at_optimal", 0.0);
  if (thelen) {
    m.parameters.tendon_strain = number(block, "FmaxTendonStrain", 0.04);
    m.parameters.passive_strain = number(block, "FmaxMuscleStrain", 0.6);
    m.parameters.passive_shape = number(block, "KshapePassive", 4.0);
    m.parameters.damping = 0.0;
  } else {
    m.parameters.damping = number(block, "fiber_damping", 0.1);
    m.parameters.tendon_strain = number(block, "strain_at_one_norm_force", 0.049);
    MillardShape& s = m.millard;
    s.active.shortest_length = number(block, "min_norm_active_fiber_length", 0.4441);
    s.active.transition_length = number(block, "transition_norm_fiber_length", 0.73);
    s.active.longest_length = number(block, "max_norm_active_fiber_length", 1.8123);
    s.active.shallow_slope = number(block, "shallow_ascending_slope", 0.8616);
    const std::string fiber = block.substr(block.find("<FiberForceLengthCurve"));
    const std::string passive = fiber.substr(0, fiber.find("</FiberForceLengthCurve"));
    s.passive.strain_at_zero = number(passive, "strain_at_zero_force", 0.0);
    s.passive.strain_at_one = number(passive, "strain_at_one_norm_force", 0.7);
    s.passive.stiffness_low = number(passive, "stiffness_at_low_force", 0.2);
    s.passive.stiffness_at_one =
        number(passive, "stiffness_at_one_norm_force", 2.0 / (s.passive.strain_at_one - s.passive.strain_at_zero));
    s.passive.curviness = number(passive, "curviness", 0.75);
    const std::string tendon = block.substr(block.find("<TendonForceLengthCurve"));
    m.parameters.tendon_strain = number(tendon, "strain_at_one_norm_force", 0.049);
  }
  m.rigid = block.find("<ignore_tendon_compliance>true") != std::string::npos;
  m.activation = std::max(number(block, "default_activation", 0.05), number(block, "minimum_activation", 0.01));
  return m;
}

struct Worst {
  double value = 0.0;
  std::string where;
  void take(double miss, const std::string& at) {
    if (!(miss <= value)) {
      value = miss;
      where = at;
    }
  }
};

/// The greatest differences from OpenSim over all muscles and frames of a case: forces over F_max,
/// angles in rad, velocities in optimal lengths per second.
struct Differences {
  Worst active, passive, tendon, pennation, velocity, rigid;
  int compared = 0;
  int left_out = 0;  ///< OpenSim's own search failed, or it holds the fiber at its shortest.
};

Differences compare(const fs::path& folder, const std::string& type, bool thelen) {
  const auto read = [&](const std::string& what) {
    return columns(folder / "opensim" / ("smooth_MuscleAnalysis_" + what + ".sto"));
  };
  const auto length = read("FiberLength"), velocity = read("FiberVelocity");
  const auto active = read("ActiveFiberForce"), passive = read("PassiveFiberForce");
  const auto tendon = read("TendonForce"), tendon_length = read("TendonLength");
  const auto pennation = read("PennationAngle");
  Differences d;
  for (const auto& [name, block] : elements(text_of(folder / "model.osim"), type)) {
    if (!length.contains(name)) continue;
    const OpenSimMuscle m = muscle_of(block, thelen);
    const double f_max = m.parameters.hill.max_isometric_force_n;
    const double l0 = m.parameters.hill.optimal_fiber_length_m;
    const double v_max = m.parameters.hill.max_shortening_speed_mps;
    const auto with_mode = [&](TendonMode mode) {
      MusculotendonLaws laws = m.laws;
      laws.mode = mode;
      return Musculotendon<double>(m.parameters, laws, m.millard);
    };
    const Musculotendon<double> given = with_mode(TendonMode::mass);  // takes both l and v
    const Musculotendon<double> solved = with_mode(TendonMode::equilibrium);
    const Musculotendon<double> rigid = with_mode(TendonMode::rigid);
    for (std::size_t k = 0; k < length.at(name).size(); ++k) {
      const auto at = [&](const auto& table) { return table.at(name).at(k); };
      const std::string where = name + " row " + std::to_string(k);
      const double l = at(length), v = at(velocity), angle = at(pennation);
      const double fiber = (at(active) + at(passive)) * std::cos(angle);
      if (angle > 1.47 || l < 0.1 * l0 || std::abs(v) > v_max || std::abs(fiber - at(tendon)) > 1e-6 * f_max) {
        ++d.left_out;
        continue;
      }
      const MusculotendonInput<double> input{m.activation, at(tendon_length) + l * std::cos(angle),
                                             v / std::cos(angle)};
      const auto o = musculotendon_output(given, input, {l, v});
      d.active.take(std::abs(o.active_force_n - at(active)) / f_max, where);
      d.pennation.take(std::abs(std::acos(o.cos_pennation) - angle), where);
      ++d.compared;
      if (m.rigid) {
        const auto r = musculotendon_output(rigid, input, {});
        d.rigid.take(std::abs(r.tendon_force_n - at(tendon)) / f_max, where);
        continue;
      }
      d.passive.take(std::abs(o.passive_force_n + o.viscous_force_n - at(passive)) / f_max, where);
      d.tendon.take(std::abs(o.tendon_force_n - at(tendon)) / f_max, where);
      const auto balance = musculotendon_output(solved, input, {l, 0.0});
      if (!balance.floored) {
        d.velocity.take(std::abs(balance.fiber_velocity_mps - v) / l0, where);
      }
    }
  }
  return d;
}

void expect_agreement(const Differences& d, int at_least) {
  EXPECT_GE(d.compared, at_least);
  EXPECT_LT(d.active.value, 1e-11) << d.active.where;
  // The files have 12 decimals: 5e-13 m of the shortest tendons (0.03 m, 3.3 %) is 1e-9 F_max, and
  // through the steepest balance (a = 0.01) 1e-6 l0/s.
  EXPECT_LT(d.passive.value, 3e-9) << d.passive.where;
  EXPECT_LT(d.tendon.value, 3e-9) << d.tendon.where;
  EXPECT_LT(d.rigid.value, 1e-10) << d.rigid.where;
  EXPECT_LT(d.pennation.value, 1e-9) << d.pennation.where;
  EXPECT_LT(d.velocity.value, 1e-6) << d.velocity.where;
}

TEST(OpenSimMuscles, MillardCurvesPennationAndDampedEquilibriumAreThoseOfRajagopalsModel) {
  const fs::path folder = test::data_folder() / "opensim/rajagopal2016";
  MYOID_REQUIRE_DATA(folder);
  const Differences d = compare(folder, "Millard2012EquilibriumMuscle", false);
  expect_agreement(d, 4000);
  RecordProperty("left_out", d.left_out);
}

TEST(OpenSimMuscles, ThelenCurvesAndUndampedEquilibriumAreThoseOfArm26AndGait2354) {
  for (const char* model : {"arm26", "gait2354"}) {
    const fs::path folder = test::data_folder() / "opensim" / model;
    MYOID_REQUIRE_DATA(folder);
    const Differences d = compare(folder, "Thelen2003Muscle", true);
    expect_agreement(d, 600);
    EXPECT_LT(d.left_out, d.compared / 10) << model;
  }
}

}  // namespace
}  // namespace myoid::muscle
