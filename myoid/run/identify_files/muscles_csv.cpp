#include "myoid/run/identify_files/muscles_csv.h"

#include <algorithm>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/muscle/absent_parameters.h"
#include "myoid/muscle/hill_parameters.h"
#include "myoid/recording/tables/csv_reader.h"
#include "myoid/run/identify_files/muscle_columns.h"

namespace myoid::run {

using fit::MuscleSetup;

namespace {

bool given_for_hill(std::string_view name) {
  return std::ranges::any_of(muscle::kHillFields, [&](const muscle::HillField& field) { return field.name == name; });
}

/// Returns the field of MuscleExtras for a column beyond the eight of the paper's law.
double* extra_field(fit::MuscleExtras& extras, std::string_view name) {
  if (name == "pennation_angle") return &extras.pennation_angle_rad;
  if (name == "passive_force") return &extras.passive_force;
  if (name == "passive_strain") return &extras.passive_strain;
  if (name == "passive_shape") return &extras.passive_shape;
  if (name == "length_activation") return &extras.length_activation;
  if (name == "tendon_strain") return &extras.tendon_strain;
  if (name == "activation_share") return &extras.activation_share;
  return nullptr;
}

constexpr const char* kWithoutEmg = "without_emg";
constexpr const char* kProduct = "eccentric_curvature_product";
constexpr const char* kRatio = "eccentric_slope_ratio";
constexpr const char* kSpeed = "max_shortening_speed";

/// One muscle's row of the table.
class Row {
 public:
  Row(const recording::CsvTable& table,
      const std::map<std::string, MuscleColumn>& columns,
      const std::filesystem::path& path,
      std::size_t index)
      : table_(&table), columns_(&columns), path_(&path), index_(index) {}

  [[noreturn]] void fail(const std::string& message) const { throw ReadError(*path_, table_->lines[index_], message); }

  /// Returns the cell's text; empty if there is no such column.
  [[nodiscard]] std::string cell(const std::string& name) const {
    const auto column = columns_->find(name);
    return column == columns_->end() ? "" : table_->rows[index_][column->second.index];
  }

  /// Returns the cell's number in SI; empty for an empty cell.
  [[nodiscard]] std::optional<double> number(const std::string& name) const {
    const std::string text = cell(name);
    if (text.empty()) return std::nullopt;
    auto value = parse_number(text);
    // A comma in a cell is a decimal comma: the columns have another separator.
    if (!value) value = parse_comma_number(text);
    if (!value) fail(fmt::format("{}: expected a number, found '{}'", name, text));
    return *value * columns_->at(name).to_si;
  }

  [[nodiscard]] std::optional<double> positive(const std::string& name) const {
    const std::optional<double> value = number(name);
    if (value && !(*value > 0.0)) fail(fmt::format("{}: expected a positive number, found {}", name, *value));
    return value;
  }

  [[nodiscard]] std::optional<bool> flag(const std::string& name) const {
    const std::string text = cell(name);
    if (text.empty()) return std::nullopt;
    for (const char* yes : {"true", "1", "yes"}) {
      if (equal_ignoring_case(text, yes)) return true;
    }
    for (const char* no : {"false", "0", "no"}) {
      if (equal_ignoring_case(text, no)) return false;
    }
    fail(fmt::format("{}: expected true or false, found '{}'", name, text));
  }

  [[nodiscard]] bool speed_in_fiber_lengths() const { return number(kSpeed) && columns_->at(kSpeed).in_fiber_lengths; }

 private:
  const recording::CsvTable* table_;
  const std::map<std::string, MuscleColumn>* columns_;
  const std::filesystem::path* path_;
  std::size_t index_;
};

/// A muscle with its starting values, and the parameters whose start is the literature's.
struct StartingMuscle {
  MuscleSetup setup;
  /// Stated without the product, which then follows from this ratio.
  std::optional<double> slope_ratio;
  std::vector<std::string> assumed;
};

StartingMuscle read_start(const Row& row) {
  StartingMuscle result;
  MuscleSetup& setup = result.setup;
  setup.name = row.cell("muscle");
  if (setup.name.empty()) row.fail("a muscle without a name");
  setup.emg_channel = row.cell("emg").empty() ? setup.name : row.cell("emg");
  if (const std::string word = row.cell(kWithoutEmg); !word.empty()) {
    const auto by = choice_named<fit::WithoutEmg>(word);
    if (!by || !row.cell("emg").empty())
      row.fail(fmt::format("muscle '{}': found without_emg '{}' and emg '{}', expected {} and an empty emg", setup.name,
                           word, row.cell("emg"), fmt::join(choice_names(fit::WithoutEmg{}), " or ")));
    setup.unseen = fit::UnseenActivation{.by = *by, .parts = {}};
  }
  const std::optional<double> ratio = row.number(kRatio);
  if (ratio && row.cell(kProduct).empty()) result.slope_ratio = row.positive(kRatio);
  for (const muscle::HillField& field : muscle::kHillFields) {
    const std::string name(field.name);
    const std::optional<double> start = row.number(name);
    const bool may_be_absent = name == "tendon_slack_length";
    if (start && *start == 0.0 && !may_be_absent)
      row.fail(fmt::format("muscle '{}': {} = 0, expected a positive number, or an empty cell for the literature's",
                           setup.name, name));
    if (start) {
      setup.start.*field.member = *start;
      continue;
    }
    if (name == "max_isometric_force" || name == "optimal_fiber_length")
      row.fail(fmt::format("muscle '{}' has no {}; it needs a starting value in SI units", setup.name, name));
    if (!may_be_absent && !(result.slope_ratio && name == kProduct)) result.assumed.push_back(name);
  }
  if (row.speed_in_fiber_lengths()) setup.start.max_shortening_speed_mps *= setup.start.optimal_fiber_length_m;
  muscle::complete_by_literature(setup.start, ratio.value_or(muscle::kLiteratureSlopeRatio));
  try {
    muscle::validate(setup.start);
  } catch (const InvalidInput& error) {
    row.fail(fmt::format("muscle '{}': {}", setup.name, error.what()));
  }
  setup.priors = fit::literature_priors(setup.start);
  return result;
}

/// The cells that determine how a parameter is identified.
struct Wishes {
  std::optional<bool> held;
  std::optional<double> lower, upper, prior_sd;

  [[nodiscard]] bool is_held() const { return held.value_or(false); }
  [[nodiscard]] bool any_bound() const { return lower || upper; }
};

Wishes read_wishes(const Row& row, const std::string& parameter) {
  return {.held = row.flag(parameter + "_fixed"),
          .lower = row.number(parameter + "_lower"),
          .upper = row.number(parameter + "_upper"),
          .prior_sd = row.positive(parameter + "_prior_sd")};
}

/// Refuses a pennation beyond every muscle's, which most often is in degrees.
void require_in_radians(const Row& row, const fit::ParameterField& field, const MuscleSetup& setup) {
  const double angle_rad = setup.extras.pennation_angle_rad;
  if (angle_rad >= field.bounds.lower && angle_rad <= field.bounds.upper) return;
  row.fail(
      fmt::format("muscle '{}': pennation_angle = {:g}, expected {:g} to {:g} rad; is it in degrees? Name the "
                  "column pennation_angle [deg], or write {:.4g}",
                  setup.name, angle_rad, field.bounds.lower, field.bounds.upper, angle_rad * kDegree));
}

/// Sets the parameter's bounds, and refuses a start outside if the method keeps to bounds.
void set_bounds(const Row& row,
                const fit::ParameterField& field,
                const Wishes& wishes,
                double start,
                bool within_bounds,
                MuscleSetup& setup) {
  const std::string name(field.name);
  const double least = wishes.lower.value_or(field.bounds.lower);
  const double most = wishes.upper.value_or(field.bounds.upper);
  if (wishes.any_bound()) {
    setup.bounds[name] = {least, most};
    if (!(least < most)) row.fail(fmt::format("{}: lower bound {} is not below upper bound {}", name, least, most));
  }
  if (!given_for_hill(name)) return;
  if (row.cell(name).empty() && !wishes.any_bound()) {
    // The literature's width of a muscle of less than 11 mm lies below the general bound.
    if (start < least && start > 0.0) setup.bounds[name] = {0.5 * start, most};
    return;
  }
  if (within_bounds && !wishes.is_held() && (start < least || start > most))
    row.fail(fmt::format(
        "muscle '{}': {} = {}, expected {} to {} (SI units); columns {}_lower and {}_upper set other bounds",
        setup.name, name, start, least, most, name, name));
}

/// Returns the rule for a parameter whose cells differ from the default.
std::optional<fit::ParameterRule> rule_of(const Row& row,
                                          const fit::ParameterField& field,
                                          const Wishes& wishes,
                                          const StartingMuscle& muscle) {
  const std::string name(field.name);
  const bool stated_ratio = muscle.slope_ratio && name == kRatio;
  fit::ParameterRule rule;
  rule.parameter = name;
  rule.owners = {muscle.setup.name};
  if (stated_ratio && wishes.is_held()) {
    rule.free = false;
    rule.value = *muscle.slope_ratio;
    return rule;
  }
  const bool of_the_law = field.field <= fit::kPlateau;
  if (of_the_law || wishes.held.value_or(!stated_ratio)) return std::nullopt;
  rule.free = true;
  rule.value = row.number(name);
  rule.lower = wishes.lower;
  rule.upper = wishes.upper;
  rule.prior_sd = wishes.prior_sd;
  return rule;
}

/// Reads start, bounds, prior and freedom of one parameter.
void read_parameter(
    const Row& row, const fit::ParameterField& field, bool within_bounds, StartingMuscle& muscle, MuscleTable& table) {
  MuscleSetup& setup = muscle.setup;
  const std::string name(field.name);
  const bool hill = given_for_hill(name);
  double start = row.number(name).value_or(0.0);
  if (double* extra = extra_field(setup.extras, name)) {
    *extra = row.number(name).value_or(*extra);
    start = *extra;
  }
  if (name == "pennation_angle") require_in_radians(row, field, setup);
  if (hill) start = setup.start.*muscle::hill_field(name).member;
  const Wishes wishes = read_wishes(row, name);
  set_bounds(row, field, wishes, start, within_bounds, setup);
  if (wishes.prior_sd) {
    setup.priors[name] = {.mean = start, .sd = *wishes.prior_sd};
    setup.given_priors.push_back(name);
  }
  // Parameters beyond the paper's law are held by default.
  if (wishes.is_held() && (hill || field.field <= fit::kPlateau)) setup.fixed.push_back(name);
  // A request for the product makes the product the unknown, in place of the ratio of slopes.
  if (name == kProduct && (wishes.is_held() || wishes.any_bound() || wishes.prior_sd)) setup.priors.erase(kRatio);
  if (const auto rule = rule_of(row, field, wishes, muscle)) table.rules.push_back(*rule);
}

}  // namespace

MuscleTable read_muscles_csv(const std::filesystem::path& path, bool within_bounds) {
  const std::string mixed_up = wrong_kind(path, {FileFormat::text_table}, "a table of muscles (.csv)");
  if (!mixed_up.empty()) throw ReadError(path, 0, mixed_up);
  const recording::CsvTable table = recording::read_csv_table(path);
  const std::map<std::string, MuscleColumn> columns = muscle_columns(table, path);
  MuscleTable result;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const Row row(table, columns, path, r);
    for (const MuscleSetup& other : result.muscles) {
      if (other.name == row.cell("muscle")) row.fail(fmt::format("muscle '{}' is listed twice", other.name));
    }
    StartingMuscle muscle = read_start(row);
    for (const std::string& parameter : muscle.assumed) result.assumed[parameter].push_back(muscle.setup.name);
    for (const fit::ParameterField& field : fit::parameter_fields()) {
      if (field.scope == fit::Scope::muscle) read_parameter(row, field, within_bounds, muscle, result);
    }
    result.muscles.push_back(std::move(muscle.setup));
  }
  if (!table.last_row_has_end) {
    result.remarks.push_back({.code = RemarkCode::reading,
                              .says = fmt::format("{}:{}: {}", path.string(), table.lines.back(), kLastRowKept)});
  }
  if (result.muscles.empty()) throw ReadError(path, 0, "there are no muscles");
  return result;
}

}  // namespace myoid::run
