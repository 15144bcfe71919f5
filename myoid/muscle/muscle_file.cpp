#include "myoid/muscle/muscle_file.h"

#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"
#include "myoid/files/text_file.h"
#include "myoid/files/toml_table.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/literature.h"

namespace myoid::muscle {
namespace {

using muscle::ActivationLaw;
using muscle::LengthLaw;
using muscle::MusculotendonLaws;
using muscle::PassiveLaw;
using muscle::TendonLaw;
using muscle::TendonMode;
using muscle::VelocityLaw;
using recording::TomlTable;

template <typename Law, std::size_t N>
Law choose(TomlTable& table,
           std::string_view key,
           Law otherwise,
           const std::array<std::pair<std::string_view, Law>, N>& words) {
  std::vector<std::string> names;
  std::string_view usual = words.front().first;
  for (const auto& [word, law] : words) {
    names.emplace_back(word);
    if (law == otherwise) usual = word;
  }
  const std::string chosen = table.choice(key, usual, names);
  for (const auto& [word, law] : words) {
    if (chosen == word) return law;
  }
  return otherwise;
}

constexpr std::array<std::pair<std::string_view, TendonMode>, 3> kModes{
    {{"rigid", TendonMode::rigid}, {"equilibrium", TendonMode::equilibrium}, {"mass", TendonMode::mass}}};
constexpr std::array<std::pair<std::string_view, LengthLaw>, 3> kLengthLaws{
    {{"gaussian", LengthLaw::gaussian}, {"de_groote", LengthLaw::de_groote}, {"millard", LengthLaw::millard}}};
constexpr std::array<std::pair<std::string_view, VelocityLaw>, 4> kVelocityLaws{{{"hill", VelocityLaw::hill},
                                                                                 {"thelen", VelocityLaw::thelen},
                                                                                 {"de_groote", VelocityLaw::de_groote},
                                                                                 {"millard", VelocityLaw::millard}}};
constexpr std::array<std::pair<std::string_view, PassiveLaw>, 4> kPassiveLaws{{{"none", PassiveLaw::none},
                                                                               {"thelen", PassiveLaw::thelen},
                                                                               {"de_groote", PassiveLaw::de_groote},
                                                                               {"millard", PassiveLaw::millard}}};
constexpr std::array<std::pair<std::string_view, TendonLaw>, 4> kTendonLaws{{{"linear", TendonLaw::linear},
                                                                             {"thelen", TendonLaw::thelen},
                                                                             {"de_groote", TendonLaw::de_groote},
                                                                             {"millard", TendonLaw::millard}}};
constexpr std::array<std::pair<std::string_view, ActivationLaw>, 5> kActivationLaws{
    {{"envelope", ActivationLaw::envelope},
     {"two_lags", ActivationLaw::two_lags},
     {"thelen", ActivationLaw::thelen},
     {"de_groote", ActivationLaw::de_groote},
     {"recursive", ActivationLaw::recursive}}};

MusculotendonLaws read_laws(TomlTable& table) {
  const std::string set = table.choice("laws", "millard", {"paper", "thelen", "de_groote", "millard"});
  MusculotendonLaws laws = set == "paper"       ? muscle::paper_laws(TendonMode::equilibrium)
                           : set == "thelen"    ? muscle::thelen_laws()
                           : set == "de_groote" ? muscle::de_groote_laws()
                                                : muscle::millard_laws();
  laws.mode = choose(table, "tendon", laws.mode, kModes);
  laws.length = choose(table, "length_law", laws.length, kLengthLaws);
  laws.velocity = choose(table, "velocity_law", laws.velocity, kVelocityLaws);
  laws.passive = choose(table, "passive_law", laws.passive, kPassiveLaws);
  laws.tendon = choose(table, "tendon_law", laws.tendon, kTendonLaws);
  return laws;
}

double required(TomlTable& table, std::string_view key, std::string_view what) {
  const std::optional<double> value = table.number(key);
  if (!value) table.fail(key, fmt::format("expected {} = {}", key, what));
  if (!(*value > 0.0)) table.fail(key, fmt::format("{} = {}: expected {}", key, *value, what));
  return *value;
}

muscle::HillParameters<double> read_hill(TomlTable& table) {
  muscle::HillParameters<double> hill;
  hill.max_isometric_force_n = required(table, "max_isometric_force", "a force in N");
  const double l0 = required(table, "optimal_fiber_length", "a length in m");
  hill.optimal_fiber_length_m = l0;
  hill.tendon_slack_length_m = required(table, "tendon_slack_length", "a length in m");
  if (table.has("max_shortening_speed") && table.has("max_contraction_velocity")) {
    table.fail("max_shortening_speed",
               "give the speed once: max_shortening_speed in m/s, or max_contraction_velocity in "
               "optimal fiber lengths per second");
  }
  hill.max_shortening_speed_mps =
      table.has("max_shortening_speed")
          ? required(table, "max_shortening_speed", "a speed in m/s")
          : l0 * table.number("max_contraction_velocity").value_or(muscle::kLiteratureSpeed);
  hill.force_length_width_m = table.number("force_length_width").value_or(muscle::kLiteratureWidth * l0);
  hill.concentric_curvature = table.number("concentric_curvature").value_or(muscle::kLiteratureCurvature);
  hill.eccentric_plateau = table.number("eccentric_plateau").value_or(muscle::kLiteraturePlateau);
  hill.eccentric_curvature_product =
      table.number("eccentric_curvature_product")
          .value_or(muscle::curvature_product_from_slope_ratio(muscle::kLiteratureSlopeRatio, hill.concentric_curvature,
                                                               hill.eccentric_plateau));
  return hill;
}

}  // namespace

MuscleFile parse_muscle_file(std::string_view text, const std::filesystem::path& path) {
  const toml::table document = recording::parse_toml(text, path);
  TomlTable root(document, path, "the muscle");
  MuscleFile file;
  std::optional<TomlTable> muscle = root.table("muscle");
  if (!muscle) throw ReadError(path, 0, "has no table [muscle]: write the muscle's numbers under it");
  file.name = muscle->text("name").value_or("muscle");
  file.laws = read_laws(*muscle);
  file.parameters = muscle::published_defaults(read_hill(*muscle), file.laws);
  const auto number = [&](std::string_view key, double& field, double scale = 1.0) {
    if (const std::optional<double> value = muscle->number(key)) field = *value * scale;
  };
  number("tendon_strain", file.parameters.tendon_strain);
  number("damping", file.parameters.damping);
  number("muscle_mass", file.parameters.muscle_mass_kg);
  number("pennation_deg", file.parameters.pennation_at_optimal_rad, kDegree);
  number("passive_strain", file.parameters.passive_strain);
  if (muscle->has("passive_strain")) file.millard.passive_strain_at_one = file.parameters.passive_strain;
  file.millard.passive_stiffness_at_one = 2.0 / file.millard.passive_strain_at_one;
  number("passive_shape", file.parameters.passive_shape);
  number("optimal_length_shift", file.parameters.optimal_length_shift);
  if (muscle->has("eccentric_plateau")) {
    file.millard.max_eccentric_multiplier = file.parameters.hill.eccentric_plateau;
  }
  muscle->finish();

  file.activation.law = ActivationLaw::thelen;
  file.activation.activation_time_s = 0.010;
  file.activation.deactivation_time_s = 0.040;
  if (std::optional<TomlTable> activation = root.table("activation")) {
    file.activation.law = choose(*activation, "law", ActivationLaw::thelen, kActivationLaws);
    const auto time = [&](std::string_view key, double& field) {
      if (const std::optional<double> value = activation->number(key)) field = *value;
    };
    time("excitation_time", file.activation.excitation_time_s);
    time("activation_time", file.activation.activation_time_s);
    time("deactivation_time", file.activation.deactivation_time_s);
    time("steepness", file.activation.steepness);
    activation->finish();
  }
  root.finish();
  try {
    muscle::validate(file.parameters, file.laws);
    muscle::validate(file.activation);
    static_cast<void>(muscle::MillardCurves(file.millard));
  } catch (const InvalidInput& error) {
    throw ReadError(path, 0, error.what());
  }
  return file;
}

MuscleFile read_muscle_file(const std::filesystem::path& path) {
  return parse_muscle_file(recording::read_text_file(path), path);
}

}  // namespace myoid::muscle
