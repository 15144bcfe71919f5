#include "myoid/program/commands/cohort.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"

namespace myoid::program {
namespace {

/// Memory that a person under way needs at most, with markers and EMG of some minutes.
constexpr std::size_t kPersonMemory_mb = 500;

using results::OutcomeKind;
using results::PersonOutcome;

std::string word_of(const PersonOutcome& each) {
  return each.outcome ? std::string(choice_name(each.outcome->kind)) : "not computed";
}

void print_outcomes(const std::vector<PersonOutcome>& outcomes) {
  std::size_t width = 6;
  for (const PersonOutcome& each : outcomes) width = std::max(width, in_column(each.person).size());
  for (const PersonOutcome& each : outcomes) {
    say("{:<{}}  {:<13}  {}{}\n", in_column(each.person), width, word_of(each),
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

/// The steps of a cohort that a command line asks for.
struct CohortSteps {
  bool persons = true, group = true;
};

/// Computes the persons, the group, or both, prints the outcomes and sets the exit code.
void run_cohort(Context& context,
                program::CohortOptions options,
                const std::filesystem::path& folder,
                const CohortSteps& steps) {
  options.call = context.call();
  options.heard = [&context](const PersonOutcome& each) {
    if (!each.outcome || each.outcome->kind != OutcomeKind::failed) return;
    context.end_progress();
    context.warn(fmt::format("{} failed: {}", each.person, each.outcome->message));
  };
  options.overwrite = context.overwrite;
  program::prepare_cohort_folder(options, folder);
  std::vector<PersonOutcome> outcomes;
  if (steps.persons) outcomes = program::write_cohort_persons(options, folder);
  context.end_progress();
  if (steps.group) {
    const results::Group group = program::write_cohort_group(options, folder);
    for (const PersonOutcome& each : group.outcomes) {
      if (!each.outcome) context.warn(fmt::format("{} is not computed yet", each.person));
    }
    if (!steps.persons) outcomes = group.outcomes;
    if (options.persons.empty()) context.exit_code = code_of(group.outcomes);
  }
  if (context.exit_code == kDone) context.exit_code = code_of(outcomes);
  context.json ? print_json(outcomes) : print_outcomes(outcomes);
  if (steps.group && !context.json) say("\nreport: {}/report.html\n", folder.string());
}

/// The options of the files of each person, and of the persons under way.
void add_file_options(CLI::App& command, program::CohortOptions& o) {
  command
      .add_option("--keep", o.kept,
                  "Files of each person: tables; page (default), also a report without the moving model; all, as run "
                  "writes them")
      ->transform(one_of<page::Kept>());
  command.add_option("-w,--work-dir,--work_dir", o.work,
                     "Folder for the stages of persons under way (default: in the folder of each person)");
  command
      .add_option("--jobs", o.jobs,
                  "Persons at a time (default: as many as threads; the files are the same for every number)")
      ->check(between(1, 1024));
}

/// Adds NAME=VALUE to the filter.
void add_entities(const std::vector<std::string>& pairs, results::BidsFilter& filter) {
  for (const std::string& pair : pairs) {
    const std::size_t equals = pair.find('=');
    if (equals == 0 || equals == std::string::npos)
      throw CLI::ValidationError("--entity", pair + ": expected NAME=VALUE, as run=1");
    filter[pair.substr(0, equals)].push_back(pair.substr(equals + 1));
  }
}

/// The options of BIDS Apps that choose trials and limit the computer.
void add_bids_options(CLI::App& command, Context& context, program::CohortOptions& o) {
  const auto add_values = [&o](const char* entity) {
    return [&o, entity](const std::vector<std::string>& values) {
      for (std::string value : values) {
        const std::string begin = std::string(entity) + "-";
        o.filter[entity].push_back(value.starts_with(begin) ? value.substr(begin.size()) : value);
      }
    };
  };
  command.option_defaults()->group("BIDS App");
  command.add_option_function<std::vector<std::string>>("--session-label,--session_label", add_values("ses"),
                                                        "Only trials of these sessions, by the names of their files");
  command.add_option_function<std::vector<std::string>>("--task-label,--task_label,--task-id", add_values("task"),
                                                        "Only trials of these tasks");
  command.add_option_function<std::vector<std::string>>(
      "--entity", [&o](const std::vector<std::string>& pairs) { add_entities(pairs, o.filter); },
      "Only trials with this entity in the names of their files, NAME=VALUE; several");
  command.add_option_function<std::string>(
      "--bids-filter-file,--bids_filter_file",
      [&o](const std::string& file) { results::add_bids_filter(file, o.filter); },
      "The same as a file: {\"motion\": {\"session\": \"01\", \"task\": [\"lift\"]}}");
  command.add_option("--n-cpus,--n_cpus", context.threads, "Processor cores, as --threads")->check(between(1, 1024));
  command
      .add_option_function<std::size_t>(
          "--mem-mb,--mem_mb",
          [&o](std::size_t memory_mb) { o.most_jobs = std::max<std::size_t>(1, memory_mb / kPersonMemory_mb); },
          "Memory [MB]: a person at a time for every 500")
      ->check(between(1, 100000000));
  command.option_defaults()->group("Options");
}

}  // namespace

void add_cohort(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("cohort",
                                          "Many persons: a run for each, then all results side by side. The persons "
                                          "stand in a table, or are those of a BIDS data set.\n"
                                          "Example: myoid cohort persons.csv --out cohort --jobs 2\n"
                                          "Example: myoid cohort data out participant --participant-label 01 02");
  const auto out = std::make_shared<std::string>();
  const auto level = std::make_shared<std::string>();
  const auto group = std::make_shared<bool>(false);
  const auto engine = std::make_shared<std::optional<results::Engine>>();
  const auto options = std::make_shared<program::CohortOptions>();
  command
      .add_option("manifest", options->manifest,
                  "Table with the columns name and study, a row a person; or the folder of a BIDS data set")
      ->required();
  command.add_option("--out,output_dir", *out, "Folder of the results")->required();
  CLI::Option* const steps =
      command
          .add_option("analysis_level", *level,
                      "As a BIDS App takes it: participant computes the persons, group puts their results side by side "
                      "(default: first the one, then the other)")
          ->check(one_of({"participant", "group"}));
  command.add_option("--study", options->study, "BIDS: the study of every person (default: code/study.toml)");
  CLI::Option* const person =
      command.add_option("--person,--participant-label,--participant_label", options->persons,
                         "Only these persons, by name, id or label without sub-, and without the group; several");
  CLI::Option* const group_only =
      command.add_flag("--group", *group, "Only the group: the tables and page of all persons")
          ->excludes(person)
          ->excludes(steps);
  command
      .add_option("--workflow", *engine,
                  "Writes the files for an engine and computes nothing: snakemake, slurm, parallel")
      ->transform(one_of<results::Engine>())
      ->excludes(person)
      ->excludes(group_only)
      ->excludes(steps);
  add_file_options(command, *options);
  add_bids_options(command, context, *options);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, options, out, level, group, engine] {
    if (*engine) {
      options->call = context.call();
      options->overwrite = context.overwrite;
      program::prepare_cohort_folder(*options, *out);
      say("{}\n", program::write_cohort_workflow(*options, **engine, *out));
    } else if (level->empty()) {
      run_cohort(context, *options, *out, {.persons = !*group, .group = *group || options->persons.empty()});
    } else {
      run_cohort(context, *options, *out, {.persons = *level == "participant", .group = *level == "group"});
    }
  });
}

}  // namespace myoid::program
