#include "myoid/lab/virtual_person/draw_truth.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/muscle/force_velocity.h"

namespace myoid::lab {
namespace {

using Hill = muscle::HillParameters<double>;

namespace beliefs = fit::beliefs;

constexpr double kTendonSd = 0.03;  // a person's tendon about the model's, which the study holds
constexpr double kLeastWidth = 0.2;
constexpr double kLeastPlateau = 1.05;

bool varies(const TruthSpec& spec, std::string_view parameter) {
  return std::find(spec.vary.begin(), spec.vary.end(), parameter) != spec.vary.end();
}

/// Draws every number, used or not, so that a held parameter does not change the others.
Hill draw(const TruthSpec& spec, const Hill& literature, double shared_strength, math::Random& random) {
  const auto normal = [&](std::string_view parameter) {
    const double z = random.normal();
    return varies(spec, parameter) ? spec.spread * z + spec.offset : 0.0;
  };
  const auto offset_of = [&spec](std::string_view parameter) { return varies(spec, parameter) ? spec.offset : 0.0; };
  Hill p = literature;
  const double strength = normal("max_isometric_force") - offset_of("max_isometric_force");
  p.max_isometric_force_n *= std::exp(kSharedStrengthSd * shared_strength + kStrengthSd * strength +
                                      beliefs::kMaxForce.sd * offset_of("max_isometric_force"));
  p.optimal_fiber_length_m *= 1.0 + kFiberLengthSd * normal("optimal_fiber_length");
  p.force_length_width_m += beliefs::kWidth.sd * normal("force_length_width") * literature.optimal_fiber_length_m;
  p.concentric_curvature *= std::exp(beliefs::kCurvature.sd * normal("concentric_curvature"));
  p.max_shortening_speed_mps *= std::exp(beliefs::kSpeed.sd * normal("max_shortening_speed"));
  p.eccentric_plateau += beliefs::kPlateau.sd * normal("eccentric_plateau");
  p.tendon_slack_length_m *= 1.0 + kTendonSd * normal("tendon_slack_length");

  const double slope = normal("eccentric_curvature_product");
  if (varies(spec, "eccentric_curvature_product")) {
    // The slopes of f_v at rest keep their ratio S, except for its own spread.
    const double ratio = muscle::slope_ratio(literature.velocity_law());
    p.eccentric_curvature_product = muscle::curvature_product_from_slope_ratio(
        ratio * std::exp(beliefs::kSlopeRatio.sd * slope), p.concentric_curvature, p.eccentric_plateau);
  }
  return p;
}

bool sensible(const Hill& p) {
  const bool alive =
      std::all_of(muscle::kHillFields.begin(), muscle::kHillFields.end(), [&p](const muscle::HillField& field) {
        const double value = p.*(field.member);
        return value >= field.bounds.lower && value <= field.bounds.upper;
      });
  return alive && p.optimal_fiber_length_m > 0.0 && p.force_length_width_m >= kLeastWidth * p.optimal_fiber_length_m &&
         p.eccentric_plateau >= kLeastPlateau;
}

}  // namespace

BesideMuscles draw_beside_muscles(const TruthSpec& spec, math::Random random) {
  BesideMuscles drawn;
  if (!spec.beside_muscles) return drawn;
  const auto normal = [&] { return spec.spread * random.normal(); };
  drawn.length_activation = beliefs::kLengthActivation.sd * std::abs(normal());
  drawn.joint_torque_nm = beliefs::kOffset.sd * normal();
  drawn.joint_stiffness_nm_per_rad = beliefs::kStiffness.sd * normal();
  drawn.joint_viscosity_nms_per_rad = beliefs::kViscosity.sd * std::abs(normal());
  for (double& exponent : drawn.emg_exponent)
    exponent = std::exp(std::clamp(beliefs::kEmgExponent.sd * normal(), -0.6, 0.6));
  return drawn;
}

HillSet draw_muscles(const TruthSpec& spec, const HillSet& literature, math::Random& random) {
  const double z = random.normal();
  const double shared_strength = varies(spec, "max_isometric_force") ? spec.spread * z : 0.0;
  HillSet result;
  for (std::size_t i = 0; i < result.size(); ++i) {
    do {
      result[i] = draw(spec, literature[i], shared_strength, random);
    } while (!sensible(result[i]));
    const auto given = spec.values.find(std::string(kArmMuscles[i]));
    if (given == spec.values.end()) continue;
    for (const auto& [parameter, value] : given->second) result[i].*(muscle::hill_field(parameter).member) = value;
  }
  return result;
}

}  // namespace myoid::lab
