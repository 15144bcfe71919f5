#include "myoid/run/identify_files/muscle_specs.h"

#include <algorithm>
#include <string>

#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::run {
namespace {

using fit::MuscleSetup;
using fit::ParameterRule;

bool is_hill(std::string_view name) {
  return std::ranges::any_of(muscle::kHillFields, [&](const muscle::HillField& field) { return field.name == name; });
}

/// Returns what a muscle's row says of one parameter beyond its start; without content it says nothing.
ParameterRule rule_of(const MuscleSetup& setup, const fit::ParameterField& field) {
  const std::string name(field.name);
  ParameterRule rule;
  rule.parameter = name;
  rule.owners = {setup.name};
  if (const auto bounds = setup.bounds.find(name); bounds != setup.bounds.end()) {
    rule.lower = bounds->second.lower;
    rule.upper = bounds->second.upper;
  }
  if (fit::contains(setup.given_priors, name)) {
    rule.prior_mean = setup.priors.at(name).mean;
    rule.prior_sd = setup.priors.at(name).sd;
  }
  if (!is_hill(name) && field.field < fit::kMuscleFieldCount) {
    const auto at = static_cast<std::size_t>(field.field);
    const double value = fit::muscle_values(setup.start, setup.extras)[at];
    if (value != fit::muscle_values(setup.start, {})[at]) rule.value = value;
  }
  if (name == "length_activation" && fit::contains(setup.fixed, name)) rule.free = false;
  return rule;
}

}  // namespace

std::vector<study::MuscleSpec> muscle_specs(const MuscleTable& table) {
  std::vector<study::MuscleSpec> specs;
  for (const MuscleSetup& setup : table.muscles) {
    study::MuscleSpec spec;
    spec.name = setup.name;
    spec.osim = {setup.name};
    if (setup.unseen) {
      spec.without_emg = setup.unseen->by;
    } else {
      spec.emg = setup.emg_channel;
    }
    for (const muscle::HillField& field : muscle::kHillFields) {
      const std::string name(field.name);
      const auto assumed = table.assumed.find(name);
      if (assumed == table.assumed.end() || !fit::contains(assumed->second, setup.name))
        spec.start[name] = setup.start.*field.member;
    }
    std::ranges::copy_if(setup.fixed, std::back_inserter(spec.fixed), is_hill);
    specs.push_back(std::move(spec));
  }
  return specs;
}

std::vector<ParameterRule> parameter_rules(const MuscleTable& table) {
  std::vector<ParameterRule> rules;
  for (const MuscleSetup& setup : table.muscles) {
    for (const fit::ParameterField& field : fit::parameter_fields()) {
      if (field.scope != fit::Scope::muscle) continue;
      ParameterRule rule = rule_of(setup, field);
      if (rule.lower || rule.prior_sd || rule.value || rule.free) rules.push_back(std::move(rule));
    }
  }
  rules.insert(rules.end(), table.rules.begin(), table.rules.end());
  return rules;
}

}  // namespace myoid::run
