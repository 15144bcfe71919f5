#include "myoid/pipeline/muscles_csv.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/identification/parameters.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/hill_parameters.h"
#include "myoid/recording/csv_reader.h"
#include "myoid/recording/text_file.h"

namespace myoid::pipeline {

using identification::MuscleSetup;

namespace {

bool given_for_hill(std::string_view name) {
  return std::any_of(muscle::kHillFields.begin(), muscle::kHillFields.end(),
                     [&](const muscle::HillField& field) { return field.name == name; });
}

std::string known_parameters() {
  std::string names;
  for (const identification::ParameterField& field : identification::parameter_fields()) {
    if (field.scope == identification::Scope::muscle)
      names += (names.empty() ? "" : ", ") + std::string(field.name);
  }
  return names;
}

/// Column of a parameter in muscles.csv beyond the eight of the paper's law, in MuscleExtras.
double* extra_field(identification::MuscleExtras& extras, std::string_view name) {
  if (name == "pennation_angle") return &extras.pennation_angle_rad;
  if (name == "passive_force") return &extras.passive_force;
  if (name == "passive_strain") return &extras.passive_strain;
  if (name == "passive_shape") return &extras.passive_shape;
  if (name == "length_activation") return &extras.length_activation;
  if (name == "tendon_strain") return &extras.tendon_strain;
  if (name == "activation_share") return &extras.activation_share;
  return nullptr;
}

}  // namespace

MuscleTable read_muscles_csv(const std::filesystem::path& path, bool within_bounds) {
  const recording::CsvTable table = recording::read_csv_table(path);
  const auto column = [&](const std::string& name) -> std::optional<std::size_t> {
    const auto it = std::find(table.names.begin(), table.names.end(), name);
    return it == table.names.end()
               ? std::nullopt
               : std::optional<std::size_t>(static_cast<std::size_t>(it - table.names.begin()));
  };
  if (!column("muscle"))
    throw ReadError(
        path, 1, "no column 'muscle'; write muscle,max_isometric_force,optimal_fiber_length,...");
  std::vector<std::string> known{"muscle", "emg"};
  for (const identification::ParameterField& field : identification::parameter_fields()) {
    if (field.scope != identification::Scope::muscle) continue;
    for (const char* suffix : {"", "_fixed", "_lower", "_upper", "_prior_sd"})
      known.push_back(std::string(field.name) + suffix);
  }
  for (const std::string& name : table.names) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      throw ReadError(
          path, 1,
          fmt::format("unknown column '{}'; parameters are {} (SI)", name, known_parameters()));
    }
  }
  MuscleTable result;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto fail = [&](const std::string& message) {
      throw ReadError(path, table.lines[r], message);
    };
    const auto cell = [&](const std::string& name) -> std::string {
      const auto c = column(name);
      return c ? table.rows[r][*c] : "";
    };
    const auto number = [&](const std::string& name) -> std::optional<double> {
      if (cell(name).empty()) return std::nullopt;
      auto value = recording::parse_number(cell(name));
      // A cell holds a comma only where another sign stands between the columns.
      if (!value) value = recording::parse_comma_number(cell(name));
      if (!value) fail(fmt::format("{}: expected a number, found '{}'", name, cell(name)));
      return value;
    };
    const auto flag = [&](const std::string& name) -> std::optional<bool> {
      const std::string text = cell(name);
      if (text.empty()) return std::nullopt;
      for (const char* yes : {"true", "1", "yes"}) {
        if (recording::equal_ignoring_case(text, yes)) return true;
      }
      for (const char* no : {"false", "0", "no"}) {
        if (recording::equal_ignoring_case(text, no)) return false;
      }
      fail(fmt::format("{}: expected true or false, found '{}'", name, text));
      return std::nullopt;
    };
    MuscleSetup setup;
    setup.name = cell("muscle");
    if (setup.name.empty()) fail("a muscle without a name");
    for (const MuscleSetup& other : result.muscles) {
      if (other.name == setup.name) fail(fmt::format("muscle '{}' is listed twice", setup.name));
    }
    setup.emg_channel = cell("emg").empty() ? setup.name : cell("emg");
    // With the slopes' ratio alone, the product follows from it.
    const std::string ratio_name = "eccentric_slope_ratio";
    const std::string product_name = "eccentric_curvature_product";
    const std::optional<double> ratio = number(ratio_name);
    const bool by_ratio = ratio && cell(product_name).empty();
    if (by_ratio && !(*ratio > 0.0))
      fail(fmt::format("{}: expected a positive number, found {}", ratio_name, *ratio));
    for (const muscle::HillField& field : muscle::kHillFields) {
      const std::string name(field.name);
      auto start = number(name);
      const auto curvature = number("concentric_curvature"), plateau = number("eccentric_plateau");
      if (by_ratio && name == product_name && curvature && plateau)
        start = muscle::curvature_product_from_slope_ratio(*ratio, *curvature, *plateau);
      if (by_ratio && name == product_name && !start) continue;  // said of those it follows from
      if (!start && name != "tendon_slack_length") {
        fail(
            fmt::format("muscle '{}' has no {}; every parameter needs a starting value in SI units",
                        setup.name, name));
      }
      setup.start.*field.member = start.value_or(0.0);
    }
    try {
      muscle::validate(setup.start);
    } catch (const InvalidInput& error) {
      fail(fmt::format("muscle '{}': {}", setup.name, error.what()));
    }
    setup.priors = identification::literature_priors(setup.start);
    for (const identification::ParameterField& field : identification::parameter_fields()) {
      if (field.scope != identification::Scope::muscle) continue;
      const std::string name(field.name);
      double start = 0.0;
      if (const double* extra = extra_field(setup.extras, name)) start = *extra;
      if (const auto given = number(name)) {
        start = *given;
        if (double* extra = extra_field(setup.extras, name)) *extra = start;
      }
      if (given_for_hill(name)) start = setup.start.*muscle::hill_field(name).member;
      const auto held = flag(name + "_fixed");
      const auto lower = number(name + "_lower");
      const auto upper = number(name + "_upper");
      const auto sd = number(name + "_prior_sd");
      if (sd && !(*sd > 0.0))
        fail(fmt::format("{}_prior_sd: expected a positive number, found {}", name, *sd));
      if (lower || upper) {
        setup.bounds[name] = {lower.value_or(field.bounds.lower),
                              upper.value_or(field.bounds.upper)};
        if (!(setup.bounds[name].lower < setup.bounds[name].upper))
          fail(fmt::format("{}: lower bound {} is not below upper bound {}", name,
                           setup.bounds[name].lower, setup.bounds[name].upper));
      }
      const double least = lower.value_or(field.bounds.lower);
      const double most = upper.value_or(field.bounds.upper);
      if (within_bounds && given_for_hill(name) && !held.value_or(false) &&
          (start < least || start > most)) {
        fail(
            fmt::format("muscle '{}': {} = {}, expected {} to {} (SI units); columns {}_lower and "
                        "{}_upper set other bounds",
                        setup.name, name, start, least, most, name, name));
      }
      if (sd) {
        setup.priors[name] = {.mean = start, .sd = *sd};
        setup.given_priors.push_back(name);
      }
      const bool usual = field.field <= identification::kPlateau;
      // What the paper's law leaves out is held anyway.
      if (held.value_or(false) && (usual || given_for_hill(name))) setup.fixed.push_back(name);
      // Who asks something of the product itself has it as the unknown.
      if (name == "eccentric_curvature_product" && (held.value_or(false) || lower || upper || sd))
        setup.priors.erase("eccentric_slope_ratio");
      const bool the_ratio = by_ratio && name == ratio_name;
      if (the_ratio && held.value_or(false)) {
        identification::ParameterRule rule;
        rule.parameter = name;
        rule.owners = {setup.name};
        rule.free = false;
        rule.value = *ratio;
        result.rules.push_back(rule);
      }
      if (!usual && !held.value_or(!the_ratio)) {
        identification::ParameterRule rule;
        rule.parameter = name;
        rule.owners = {setup.name};
        rule.free = true;
        if (number(name)) rule.value = *number(name);
        if (lower) rule.lower = *lower;
        if (upper) rule.upper = *upper;
        if (sd) rule.prior_sd = *sd;
        result.rules.push_back(rule);
      }
      if (name == "max_shortening_speed" && !held) result.speed_may_be_free.push_back(setup.name);
    }
    result.muscles.push_back(std::move(setup));
  }
  if (!table.last_row_has_end) {
    result.notes.push_back(
        fmt::format("{}:{}: {}", path.string(), table.lines.back(), recording::kLastRowKept));
  }
  if (result.muscles.empty()) throw ReadError(path, 0, "there are no muscles");
  return result;
}

}  // namespace myoid::pipeline
