#include "myoid/cli/cohort_run.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/core/counted.h"
#include "myoid/core/json_text.h"

namespace myoid::cli {
namespace {

using cohort::OutcomeKind;
using cohort::PersonOutcome;

std::string word_of(const PersonOutcome& each) {
  return each.outcome ? std::string(choice_name(each.outcome->kind)) : "not computed";
}

void print_outcomes(const std::vector<PersonOutcome>& outcomes) {
  std::size_t width = 6;
  for (const PersonOutcome& each : outcomes) width = std::max(width, each.person.size());
  for (const PersonOutcome& each : outcomes) {
    fmt::print("{:<{}}  {:<13}  {}{}\n", each.person, width, word_of(each),
               each.reused ? "(as before: same input) " : "", each.outcome ? each.outcome->message : "");
  }
}

void print_json(const std::vector<PersonOutcome>& outcomes) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const PersonOutcome& each : outcomes) {
    list.push_back({{"person", each.person},
                    {"outcome", word_of(each)},
                    {"message", each.outcome ? each.outcome->message : ""},
                    {"reused", each.reused}});
  }
  fmt::print("{}\n", json_text(list));
}

/// Returns the code of `run` for one person; for several, failures count before gates.
int code_of(const std::vector<PersonOutcome>& outcomes) {
  const auto any = [&](OutcomeKind kind) {
    return std::any_of(outcomes.begin(), outcomes.end(),
                       [&](const PersonOutcome& each) { return each.outcome && each.outcome->kind == kind; });
  };
  const bool open =
      std::any_of(outcomes.begin(), outcomes.end(), [](const PersonOutcome& each) { return !each.outcome; });
  if (any(OutcomeKind::failed) && outcomes.size() == 1) return kBadInput;
  if (open || any(OutcomeKind::failed) || any(OutcomeKind::trials_failed)) return kSomeTrialsFailed;
  return any(OutcomeKind::gate_failed) ? kQualityGateFailed : kDone;
}

}  // namespace

void run_cohort(Context& context,
                commands::CohortOptions options,
                const std::filesystem::path& folder,
                const CohortSteps& steps) {
  options.call = context.call();
  options.heard = [&context](const PersonOutcome& each) {
    if (!each.outcome || each.outcome->kind != OutcomeKind::failed) return;
    context.end_progress();
    context.warn(fmt::format("{} failed: {}", each.person, each.outcome->message));
  };
  commands::prepare_cohort_folder(options, folder, context.overwrite);
  std::vector<PersonOutcome> outcomes;
  if (steps.persons) outcomes = commands::write_cohort_persons(options, folder);
  context.end_progress();
  if (steps.group) {
    const cohort::Group group = commands::write_cohort_group(options, folder);
    for (const PersonOutcome& each : group.outcomes) {
      if (!each.outcome) context.warn(fmt::format("{} is not computed yet", each.person));
    }
    if (!steps.persons) outcomes = group.outcomes;
    if (options.persons.empty()) context.exit_code = code_of(group.outcomes);
  }
  if (context.exit_code == kDone) context.exit_code = code_of(outcomes);
  context.json ? print_json(outcomes) : print_outcomes(outcomes);
  if (steps.group && !context.json) fmt::print("\nreport: {}/report.html\n", folder.string());
}

void add_cohort_options(CLI::App& command, commands::CohortOptions& options) {
  command.add_option("--estimator", options.estimator, "least_squares or posterior, in place of the studies'")
      ->transform(one_of<identification::EstimatorKind>());
  command
      .add_option("--jobs", options.jobs,
                  "Persons at a time (default: as many as threads; the files are the same for "
                  "every number)")
      ->check(CLI::Range(1, 1024));
}

}  // namespace myoid::cli
