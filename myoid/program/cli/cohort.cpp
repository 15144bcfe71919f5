#include "myoid/program/commands/cohort.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"

namespace myoid::program {
namespace {

using results::OutcomeKind;
using results::PersonOutcome;

std::string word_of(const PersonOutcome& each) {
  return each.outcome ? std::string(choice_name(each.outcome->kind)) : "not computed";
}

/// Prints a line for each person; of many persons for those that are not done, as far as the lines go.
void print_outcomes(const std::vector<PersonOutcome>& outcomes) {
  constexpr std::size_t kMostLines = 20;
  const auto is_done = [](const PersonOutcome& each) {
    return each.outcome && each.outcome->kind == OutcomeKind::done;
  };
  std::vector<PersonOutcome> shown = outcomes;
  if (shown.size() > kMostLines) {
    std::erase_if(shown, is_done);
    shown.resize(std::min(shown.size(), kMostLines));
  }
  std::size_t width = 6;
  for (const PersonOutcome& each : shown) width = std::max(width, in_column(each.person).size());
  for (const PersonOutcome& each : shown) {
    say("{:<{}}  {:<13}  {}{}\n", in_column(each.person), width, word_of(each),
        each.reused ? "(as before: same input) " : "", each.outcome ? each.outcome->message : "");
  }
  if (shown.size() < outcomes.size()) {
    const auto done = static_cast<std::size_t>(std::ranges::count_if(outcomes, is_done));
    const std::size_t others = outcomes.size() - done - shown.size();
    say("{} of {} persons are done{}\n", done, outcomes.size(),
        others > 0 ? fmt::format(", {} more are not", others) : "");
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
  say_whole(json_text(list) + "\n");
}

/// Returns the code of `run` for one person; for several, failures count before gates.
int code_of(const std::vector<PersonOutcome>& outcomes) {
  const auto any = [&](OutcomeKind kind) {
    return std::ranges::any_of(outcomes,
                               [&](const PersonOutcome& each) { return each.outcome && each.outcome->kind == kind; });
  };
  const bool open = std::ranges::any_of(outcomes, [](const PersonOutcome& each) { return !each.outcome; });
  if (any(OutcomeKind::failed) && outcomes.size() == 1) return kBadInput;
  if (open || any(OutcomeKind::failed) || any(OutcomeKind::trials_failed)) return kSomeTrialsFailed;
  return any(OutcomeKind::gate_failed) ? kQualityGateFailed : kDone;
}

/// Computes the persons, the group, or both, prints the outcomes and sets the exit code.
void run_cohort(Context& context, program::CohortOptions options, bool with_persons, bool with_group) {
  const std::filesystem::path folder = options.out;
  options.heard = [&context](const PersonOutcome& each) {
    if (!each.outcome || each.outcome->kind != OutcomeKind::failed) return;
    context.end_progress();
    context.warn(fmt::format("{} failed: {}", each.person, each.outcome->message));
  };
  program::prepare_cohort_folder(options, folder);
  std::vector<PersonOutcome> outcomes;
  if (with_persons) outcomes = program::write_cohort_persons(options, folder);
  context.end_progress();
  if (with_group) {
    const results::Group group = program::write_cohort_group(options, folder);
    for (const PersonOutcome& each : group.outcomes) {
      if (!each.outcome) context.warn(fmt::format("{} is not computed yet", each.person));
    }
    if (!with_persons) outcomes = group.outcomes;
    if (options.persons.empty()) context.exit_code = code_of(group.outcomes);
  }
  if (context.exit_code == kDone) context.exit_code = code_of(outcomes);
  context.json ? print_json(outcomes) : print_outcomes(outcomes);
  if (with_group && !context.json) say("\nreport: {}/report.html\n", folder.string());
}

/// Refuses a pair without an equals sign.
std::string refused_entity(const std::string& pair) {
  const std::size_t equals = pair.find('=');
  return equals == 0 || equals == std::string::npos ? pair + ": expected NAME=VALUE, as run=1" : "";
}

void carry_out(Context& context, const CohortOptions& o, const CLI::App& /*command*/) {
  if (o.workflow) {
    program::prepare_cohort_folder(o, o.out);
    say("{}\n", program::write_cohort_workflow(o, o.out));
  } else if (!o.level) {
    run_cohort(context, o, !o.group, o.group || o.persons.empty());
  } else {
    run_cohort(context, o, o.level == AnalysisLevel::participant, o.level == AnalysisLevel::group);
  }
}

}  // namespace

void add_cohort(CLI::App& app, Context& context) {
  CLI::App* const command =
      add_command<CohortOptions>(app, context, "cohort",
                                 "Many persons: a run for each, then all results side by side. The persons "
                                 "stand in a table, or are those of a BIDS data set.\n"
                                 "Example: myoid cohort persons.csv --out cohort --jobs 2\n"
                                 "Example: myoid cohort data out participant --participant-label 01 02",
                                 {.seed = false}, carry_out);
  command->get_option("--entity")->check(CLI::Validator(refused_entity, ""));
  command->add_option("--n-cpus,--n_cpus", context.threads, "Processor cores, as --threads")
      ->check(between(1, 1024))
      ->group("BIDS App");
}

}  // namespace myoid::program
