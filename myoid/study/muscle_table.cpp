#include "myoid/study/muscle_table.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"
#include "myoid/identification/parameters.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid {

using recording::TomlTable;

namespace {

/// The muscle parameter of this name, or an error at the key's line that lists them.
const muscle::HillField& parameter(const TomlTable& table,
                                   std::string_view key,
                                   const std::string& name) {
  std::vector<std::string> names;
  for (const muscle::HillField& field : muscle::kHillFields) {
    if (field.name == name) return field;
    names.emplace_back(field.name);
  }
  const auto near = recording::nearest_word(name, names);
  table.fail(key, fmt::format("no muscle parameter is named '{}'{}; there are {}", name,
                              near ? fmt::format(" (did you mean '{}'?)", *near) : "",
                              fmt::join(names, ", ")));
}

}  // namespace

MuscleSpec read_muscle(TomlTable table) {
  MuscleSpec muscle;
  muscle.name = table.require_text("name", "a short name for the results, name = \"BIC\"");
  muscle.osim = table.texts("osim").value_or(std::vector<std::string>{muscle.name});
  if (muscle.osim.empty()) table.fail("osim", "expected at least one muscle of the model");
  if (table.is_table("emg")) {
    TomlTable tie = *table.table("emg");
    muscle.same_as = tie.require_text("same_as", "the muscle whose electrode serves this one too");
    tie.finish();
  } else {
    muscle.emg = table.require_text(
        "emg", "the EMG channel, or { same_as = \"MUSCLE\" } where there is no electrode");
  }
  if (auto start = table.table("start")) {
    for (const std::string& key : start->keys()) {
      const muscle::HillField& field = parameter(*start, key, key);
      muscle.start[key] = start->number_within(key, 0.0, field.bounds.lower, field.bounds.upper,
                                               symbol(field.unit));
    }
  }
  muscle.fixed = table.texts("fixed").value_or(muscle.fixed);
  for (const std::string& name : muscle.fixed) (void)parameter(table, "fixed", name);
  table.finish();
  return muscle;
}

identification::ParameterRule read_rule(TomlTable table) {
  identification::ParameterRule rule;
  rule.parameter = table.require_text("name", "a parameter, such as \"tendon_slack_length\"");
  try {
    (void)identification::parameter_field(rule.parameter);
  } catch (const InvalidInput& error) {
    table.fail("name", error.what());
  }
  rule.owners = table.texts("of").value_or(rule.owners);
  rule.free = table.flag("free");
  rule.value = table.number("value");
  rule.lower = table.number("lower");
  rule.upper = table.number("upper");
  rule.prior_mean = table.number("prior_mean");
  rule.prior_sd = table.number("prior_sd");
  if (rule.prior_sd && !(*rule.prior_sd > 0.0))
    table.fail("prior_sd", fmt::format("found {}, expected a positive number", *rule.prior_sd));
  if (rule.lower && rule.upper && !(*rule.lower < *rule.upper))
    table.fail("lower", fmt::format("found {}, not below upper = {}", *rule.lower, *rule.upper));
  rule.tie = table.flag("tie").value_or(false);
  table.finish();
  return rule;
}

}  // namespace myoid
