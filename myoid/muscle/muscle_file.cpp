#include "myoid/muscle/muscle_file.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/files/toml_table.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/literature.h"

namespace myoid::muscle {
namespace {

using ground::TomlTable;

MusculotendonLaws read_laws(TomlTable& table) {
  MusculotendonLaws laws = laws_of(table.choice("laws", LawSet::millard));
  laws.mode = table.choice("tendon", laws.mode);
  laws.length = table.choice("length_law", laws.length);
  laws.velocity = table.choice("velocity_law", laws.velocity);
  laws.passive = table.choice("passive_law", laws.passive);
  laws.tendon = table.choice("tendon_law", laws.tendon);
  return laws;
}

double required(TomlTable& table, std::string_view key, std::string_view what) {
  const std::optional<double> value = table.number(key);
  if (!value) table.fail(key, fmt::format("expected {} = {}", key, what));
  if (!(*value > 0.0)) table.fail(key, fmt::format("{} = {}: expected {}", key, *value, what));
  return *value;
}

HillParameters<double> read_hill(TomlTable& table, const MusculotendonLaws& laws) {
  HillParameters<double> hill;
  hill.max_isometric_force_n = required(table, "max_isometric_force", "a force in N");
  const double l0 = required(table, "optimal_fiber_length", "a length in m");
  hill.optimal_fiber_length_m = l0;
  hill.tendon_slack_length_m = required(table, "tendon_slack_length", "a length in m");
  if (table.has("max_shortening_speed") && table.has("max_contraction_velocity")) {
    table.fail("max_shortening_speed",
               "give the speed once: max_shortening_speed in m/s, or max_contraction_velocity in "
               "optimal fiber lengths per second");
  }
  hill.max_shortening_speed_mps = table.has("max_shortening_speed")
                                      ? required(table, "max_shortening_speed", "a speed in m/s")
                                      : l0 * table.number("max_contraction_velocity").value_or(kLiteratureSpeed);
  hill.force_length_width_m = table.number("force_length_width")
                                  .value_or((laws.length == LengthLaw::soest ? kSoestWidth : kLiteratureWidth) * l0);
  hill.concentric_curvature = table.number("concentric_curvature").value_or(kLiteratureCurvature);
  hill.eccentric_plateau = table.number("eccentric_plateau").value_or(kLiteraturePlateau);
  hill.eccentric_curvature_product = table.number("eccentric_curvature_product")
                                         .value_or(curvature_product_from_slope_ratio(
                                             kLiteratureSlopeRatio, hill.concentric_curvature, hill.eccentric_plateau));
  return hill;
}

}  // namespace

MuscleFile parse_muscle_file(std::string_view text, const std::filesystem::path& path) {
  const toml::table document = parse_toml(text, path);
  TomlTable root(document, path, "the muscle");
  MuscleFile file;
  std::optional<TomlTable> muscle = root.table("muscle");
  if (!muscle) throw ReadError(path, 0, "has no table [muscle]: write the muscle's numbers under it");
  file.name = muscle->text("name").value_or("muscle");
  file.laws = read_laws(*muscle);
  file.parameters = published_defaults(read_hill(*muscle, file.laws), file.laws);
  const auto number = [&](std::string_view key, double& field, double scale = 1.0) {
    if (const std::optional<double> value = muscle->number(key)) field = *value * scale;
  };
  number("tendon_strain", file.parameters.tendon_strain);
  number("damping", file.parameters.damping);
  number("muscle_mass", file.parameters.muscle_mass_kg);
  number("pennation_deg", file.parameters.pennation_at_optimal_rad, kDegree);
  number("passive_strain", file.parameters.passive_strain);
  if (muscle->has("passive_strain"))
    file.millard.passive.strain_at_one = file.parameters.passive_strain;
  else if (file.laws.passive == PassiveLaw::millard)
    file.parameters.passive_strain = file.millard.passive.strain_at_one;
  file.millard.passive.stiffness_at_one = 2.0 / file.millard.passive.strain_at_one;
  number("passive_shape", file.parameters.passive_shape);
  number("optimal_length_shift", file.parameters.optimal_length_shift);
  number("passive_slack", file.parameters.passive_slack);
  if (muscle->has("eccentric_plateau")) {
    file.millard.velocity.max_eccentric_multiplier = file.parameters.hill.eccentric_plateau;
  }
  muscle->finish();

  if (std::optional<TomlTable> activation = root.table("activation")) {
    ActivationDynamics<double>& dynamics = file.response.activation;
    dynamics.law = activation->choice("law", ActivationLaw::thelen);
    if (activation->flag("calcium").value_or(false)) file.response.calcium.emplace();
    visit_response(file.response, [&](std::string_view key, Unit, double& field) {
      if (const std::optional<double> value = activation->number(key)) field = *value;
    });
    if (const std::optional<double> value = activation->number("steepness")) dynamics.steepness = *value;
    activation->finish();
  }
  root.finish();
  try {
    validate(file.parameters, file.laws);
    validate(file.response);
    static_cast<void>(MillardCurves(file.millard));
  } catch (const InvalidInput& error) {
    throw ReadError(path, 0, error.what());
  }
  return file;
}

std::string muscle_toml(const MuscleFile& file) {
  const MusculotendonParameters<double>& p = file.parameters;
  const MusculotendonLaws& laws = file.laws;
  std::string text = "[muscle]\n";
  const auto line = [&](std::string_view key, const std::string& value) {
    text += fmt::format("{} = {}\n", key, value);
  };
  const auto word = [&](std::string_view key, std::string_view value) { line(key, toml_text(value)); };
  const auto number = [&](std::string_view key, double value) { line(key, toml_number(value)); };
  word("name", file.name);
  word("tendon", choice_name(laws.mode));
  word("length_law", choice_name(laws.length));
  word("velocity_law", choice_name(laws.velocity));
  word("passive_law", choice_name(laws.passive));
  word("tendon_law", choice_name(laws.tendon));
  visit_parameters(p, [&](std::string_view key, Unit, double value) {
    const bool millard = key == "eccentric_plateau" && laws.velocity == VelocityLaw::millard;
    if (key == "pennation_at_optimal")
      number("pennation_deg", value / kDegree);
    else
      number(key, millard ? file.millard.velocity.max_eccentric_multiplier : value);
  });
  text += "\n[activation]\n";
  word("law", choice_name(file.response.activation.law));
  if (file.response.calcium) line("calcium", "true");
  visit_response(file.response, [&](std::string_view key, Unit, double value) { number(key, value); });
  number("steepness", file.response.activation.steepness);
  return text;
}

MuscleFile read_muscle_file(const std::filesystem::path& path) { return parse_muscle_file(read_text_file(path), path); }

}  // namespace myoid::muscle
