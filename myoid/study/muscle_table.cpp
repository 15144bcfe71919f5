#include "myoid/study/muscle_table.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/muscle/hill_parameters.h"
#include "myoid/study/study_ids.h"

namespace myoid::study {

namespace {

constexpr auto kHillNames = [] {
  std::array<std::string_view, muscle::kHillFields.size()> names;
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = muscle::kHillFields[i].name;
  return names;
}();

/// Returns the names of all parameters that can be identified.
ChoiceNames parameter_names() {
  static const std::vector<std::string_view> names = [] {
    std::vector<std::string_view> list;
    for (const fit::ParameterField& field : fit::parameter_fields()) list.push_back(field.name);
    return list;
  }();
  return names;
}

/// Refuses a pennation beyond every muscle's, which most often is in degrees.
void require_in_radians(std::string_view key, std::optional<double> angle_rad, SettingVisitor& v) {
  const double most_rad = fit::parameter_field("pennation_angle").bounds.upper;
  const double found = angle_rad.value_or(0.0);
  v.must(found >= 0.0 && found <= most_rad, key,
         fmt::format("found {:g}, expected 0 to {:g} rad; of an angle in degrees write {:.4g}", found, most_rad,
                     found * kDegree));
}

/// Visits the starting values by the name of the muscle's parameter.
void visit_start(std::map<std::string, double>& start, SettingVisitor& v) {
  for (const muscle::HillField& field : muscle::kHillFields) {
    const std::string name(field.name);
    std::optional<double> value;
    if (const auto found = start.find(name); found != start.end()) value = found->second;
    v.number(field.name, value,
             {.says = field.symbol,
              .limits = within(field.bounds.lower, field.bounds.upper,
                               field.unit == Unit::dimensionless ? "" : symbol(field.unit)),
              .otherwise = "the model's"});
    if (value) start[name] = *value;
  }
}

}  // namespace

void visit(MuscleSpec& muscle, SettingVisitor& v) {
  v.text("name", muscle.name,
         {.says = "Its name in the results.", .required = "a short name for the results, name = \"BIC\""});
  must_be_name(v, "name", muscle.name);
  const bool stated = v.texts("osim", muscle.osim,
                              {.says = "Muscles of the model that act as this one, lumped by their F_max.",
                               .otherwise = "the one of this name"});
  v.must(!stated || !muscle.osim.empty(), "osim", "expected at least one muscle of the model");
  if (muscle.osim.empty()) muscle.osim = {muscle.name};
  v.choice(
      "without_emg", muscle.without_emg,
      {.says = "In place of `emg`: no electrode stands for the muscle. Its [activation](#without-emg) is an unknown "
               "signal about a constant, or about the synergies of the measured EMG.",
       .silent = !muscle.without_emg});
  const bool without = muscle.without_emg.has_value();
  const bool has_emg = v.text(
      "emg", muscle.emg, muscle.same_as,
      {.says =
           "EMG channel; `{ same_as = \"MUSCLE\" }`: another muscle's channel, of a deep muscle without an electrode.",
       .required =
           without ? "" : "the EMG channel, or { same_as = \"MUSCLE\" } or without_emg where there is no electrode",
       .table = "same_as",
       .silent = without});
  v.must(!(without && has_emg), "without_emg", "emg names a channel: leave one of the two out");
  if (!muscle.same_as && !without) must_be_name(v, "emg", muscle.emg);
  muscle.emg = std::string(trim(muscle.emg));  // as the readers of recordings do with their labels
  v.table("start", !muscle.start.empty(), {.says = "Starting values, `start = { max_isometric_force = 900.0 }`."},
          [&muscle](SettingVisitor& inside) { visit_start(muscle.start, inside); });
  v.texts("fixed", muscle.fixed,
          {.says = "Parameters that are held. Unless it is named here, `max_shortening_speed` is free, with the "
                   "literature's spread.",
           .words = kHillNames});
}

void visit(fit::ParameterRule& rule, SettingVisitor& v) {
  v.text("name", rule.parameter,
         {.says = "The parameter.",
          .required = "a parameter, such as \"tendon_slack_length\"",
          .words = parameter_names()});
  v.texts("of", rule.owners, {.says = "Muscles, EMG channels or joints that it is about.", .otherwise = "all"});
  v.flag("free", rule.free, {.says = "It is identified."});
  v.number("value", rule.value,
           {.says = "The value where it starts or is held, in its unit.",
            .limits = any_number(),
            .otherwise = "its prior's mean"});
  v.number("lower", rule.lower, {.says = "Lower bound.", .limits = any_number()});
  v.number("upper", rule.upper, {.says = "Upper bound.", .limits = any_number()});
  v.number("prior_mean", rule.prior_mean, {.says = "The value expected beforehand.", .limits = any_number()});
  v.number("prior_sd", rule.prior_sd, {.says = "The standard deviation of that expectation.", .limits = above_zero()});
  v.flag("tie", rule.tie, {.says = "One unknown for all: their ratios to the starting values are equal."});
  if (rule.parameter == "pennation_angle") {
    require_in_radians("value", rule.value, v);
    require_in_radians("prior_mean", rule.prior_mean, v);
  }
  v.must(!rule.lower || !rule.upper || *rule.lower < *rule.upper, "lower",
         fmt::format("found {}, not below upper = {}", rule.lower.value_or(0.0), rule.upper.value_or(0.0)));
}

}  // namespace myoid::study
