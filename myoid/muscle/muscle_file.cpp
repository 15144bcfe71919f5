#include "myoid/muscle/muscle_file.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/files/toml_table.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/literature.h"

namespace myoid::muscle {
namespace {

using ground::TomlTable;

MusculotendonLaws read_laws(TomlTable& table) {
  const std::string set = table.choice("laws", "millard", {"paper", "thelen", "de_groote", "millard"});
  MusculotendonLaws laws = set == "paper"       ? paper_laws(TendonMode::equilibrium)
                           : set == "thelen"    ? thelen_laws()
                           : set == "de_groote" ? de_groote_laws()
                                                : millard_laws();
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

HillParameters<double> read_hill(TomlTable& table) {
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
  hill.force_length_width_m = table.number("force_length_width").value_or(kLiteratureWidth * l0);
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
  file.parameters = published_defaults(read_hill(*muscle), file.laws);
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
  if (muscle->has("eccentric_plateau")) {
    file.millard.velocity.max_eccentric_multiplier = file.parameters.hill.eccentric_plateau;
  }
  muscle->finish();

  file.activation.law = ActivationLaw::thelen;
  file.activation.activation_time_s = 0.010;
  file.activation.deactivation_time_s = 0.040;
  if (std::optional<TomlTable> activation = root.table("activation")) {
    file.activation.law = activation->choice("law", ActivationLaw::thelen);
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
    validate(file.parameters, file.laws);
    validate(file.activation);
    static_cast<void>(MillardCurves(file.millard));
  } catch (const InvalidInput& error) {
    throw ReadError(path, 0, error.what());
  }
  return file;
}

MuscleFile read_muscle_file(const std::filesystem::path& path) { return parse_muscle_file(read_text_file(path), path); }

}  // namespace myoid::muscle
