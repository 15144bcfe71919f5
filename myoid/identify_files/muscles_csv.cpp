#include "myoid/identify_files/muscles_csv.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/files/text_file.h"
#include "myoid/files/wrong_kind.h"
#include "myoid/identification/parameters.h"
#include "myoid/identify_files/muscle_columns.h"
#include "myoid/muscle/force_velocity.h"
#include "myoid/muscle/hill_parameters.h"
#include "myoid/muscle/literature.h"
#include "myoid/tables/csv_reader.h"

namespace myoid {

using identification::MuscleSetup;

namespace {

bool given_for_hill(std::string_view name) {
  return std::any_of(muscle::kHillFields.begin(), muscle::kHillFields.end(),
                     [&](const muscle::HillField& field) { return field.name == name; });
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

constexpr const char* kProduct = "eccentric_curvature_product";

/// The literature's number for every one that is 0, from the others. The narrowest widths lie
/// below the general bound in muscles of less than 11 mm: that muscle's bound is half of its width.
void fill_in(double slope_ratio, MuscleSetup& setup) {
  muscle::HillParameters<double>& start = setup.start;
  const auto absent = [](double& value, double literature) {
    if (value == 0.0) value = literature;
  };
  absent(start.force_length_width_m, muscle::kLiteratureWidth * start.optimal_fiber_length_m);
  absent(start.concentric_curvature, muscle::kLiteratureCurvature);
  absent(start.eccentric_plateau, muscle::kLiteraturePlateau);
  absent(start.max_shortening_speed_mps, muscle::kLiteratureSpeed * start.optimal_fiber_length_m);
  // Of a plateau of 1 the law in lengthening is level, whatever the product.
  absent(start.eccentric_curvature_product,
         std::max(muscle::hill_field(kProduct).bounds.lower,
                  muscle::curvature_product_from_slope_ratio(
                      slope_ratio, start.concentric_curvature, start.eccentric_plateau)));
}

/// What stands in for what the file does not say.
std::string assumption(const std::filesystem::path& path,
                       const std::map<std::string, std::vector<std::string>>& assumed,
                       std::size_t muscles) {
  std::string text;
  for (const auto& [parameter, names] : assumed) {
    const char* const value = parameter == "force_length_width"     ? "0.45 l_m0"
                              : parameter == "concentric_curvature" ? "0.28"
                              : parameter == "eccentric_plateau"    ? "1.4"
                              : parameter == "max_shortening_speed"
                                  ? "10 l_m0 per second"
                                  : "by a slope in lengthening of 1.5 times that in shortening";
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", parameter, value);
    if (names.size() < muscles) text += fmt::format(" ({})", fmt::join(names, ", "));
  }
  return fmt::format("{}: start from the literature's values: {}", path.string(), text);
}

}  // namespace

MuscleTable read_muscles_csv(const std::filesystem::path& path, bool within_bounds) {
  const std::string mixed_up =
      recording::wrong_kind(path, {".csv", ".tsv", ".txt"}, "a table of muscles (.csv)");
  if (!mixed_up.empty()) throw ReadError(path, 0, mixed_up);
  const recording::CsvTable table = recording::read_csv_table(path);
  const std::map<std::string, MuscleColumn> columns = muscle_columns(table, path);
  MuscleTable result;
  std::map<std::string, std::vector<std::string>> assumed;  // Muscles by parameter.
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const auto fail = [&](const std::string& message) {
      throw ReadError(path, table.lines[r], message);
    };
    const auto cell = [&](const std::string& name) -> std::string {
      const auto c = columns.find(name);
      return c == columns.end() ? "" : table.rows[r][c->second.index];
    };
    const auto number = [&](const std::string& name) -> std::optional<double> {
      if (cell(name).empty()) return std::nullopt;
      auto value = recording::parse_number(cell(name));
      // A cell holds a comma only where another sign stands between the columns.
      if (!value) value = recording::parse_comma_number(cell(name));
      if (!value) fail(fmt::format("{}: expected a number, found '{}'", name, cell(name)));
      return *value * columns.at(name).to_si;
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
    const std::optional<double> ratio = number(ratio_name);
    const bool by_ratio = ratio && cell("eccentric_curvature_product").empty();
    if (by_ratio && !(*ratio > 0.0))
      fail(fmt::format("{}: expected a positive number, found {}", ratio_name, *ratio));
    for (const muscle::HillField& field : muscle::kHillFields) {
      const std::string name(field.name);
      const auto start = number(name);
      if (start && *start == 0.0 && name != "tendon_slack_length")
        fail(
            fmt::format("muscle '{}': {} = 0, expected a positive number, or an empty cell for "
                        "the literature's",
                        setup.name, name));
      if (start) setup.start.*field.member = *start;
      const bool needed = name == "max_isometric_force" || name == "optimal_fiber_length";
      if (!start && needed)
        fail(fmt::format("muscle '{}' has no {}; it needs a starting value in SI units", setup.name,
                         name));
      if (!start && name != "tendon_slack_length" && !(by_ratio && name == kProduct))
        assumed[name].push_back(setup.name);
    }
    if (number("max_shortening_speed") && columns.at("max_shortening_speed").in_fiber_lengths)
      setup.start.max_shortening_speed_mps *= setup.start.optimal_fiber_length_m;
    fill_in(ratio.value_or(muscle::kLiteratureSlopeRatio), setup);
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
      const bool hill = given_for_hill(name);
      if (hill) start = setup.start.*muscle::hill_field(name).member;
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
      const bool literature = hill && cell(name).empty();
      if (literature && start < field.bounds.lower && !lower && !upper && start > 0.0)
        setup.bounds[name] = {0.5 * start, field.bounds.upper};
      const double least = lower.value_or(field.bounds.lower);
      const double most = upper.value_or(field.bounds.upper);
      if (within_bounds && hill && !(literature && !lower && !upper) && !held.value_or(false) &&
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
      if (held.value_or(false) && (usual || hill)) setup.fixed.push_back(name);
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
  if (!assumed.empty()) {
    result.assumed = assumption(path, assumed, result.muscles.size());
    result.notes.push_back(result.assumed);
  }
  if (result.muscles.empty()) throw ReadError(path, 0, "there are no muscles");
  return result;
}

}  // namespace myoid
