#include "myoid/commands/cohort.h"

#include <memory>

#include <fmt/format.h>

#include "myoid/cli/cohort_run.h"
#include "myoid/cli/context.h"

namespace myoid::cli {

void add_cohort(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("cohort",
                                          "Many persons: a run for each, then all results side by side.\n"
                                          "Example: myoid cohort persons.csv --out cohort --jobs 2");
  const auto out = std::make_shared<std::string>();
  const auto group = std::make_shared<bool>(false);
  const auto engine = std::make_shared<std::optional<cohort::Engine>>();
  const auto options = std::make_shared<commands::CohortOptions>();
  command
      .add_option("manifest", options->manifest,
                  "Table with the columns name and study, a row a person; or a BIDS data set")
      ->required();
  command.add_option("--out", *out, "Folder of the results")->required();
  command.add_option("--study", options->study, "BIDS: the study of every person (default: code/study.toml)");
  CLI::Option* const person =
      command.add_option("--person", options->persons, "Only this person, without the group; may be repeated");
  CLI::Option* const group_only =
      command.add_flag("--group", *group, "Only the group: the tables and page of all persons");
  command
      .add_option("--workflow", *engine,
                  "Writes the files for an engine and computes nothing: snakemake, slurm, parallel")
      ->transform(one_of<cohort::Engine>())
      ->excludes(person)
      ->excludes(group_only);
  person->excludes(group_only);
  add_cohort_options(command, *options);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, options, out, group, engine] {
    if (*engine) {
      commands::prepare_cohort_folder(*options, *out, context.overwrite);
      fmt::print("{}\n", commands::write_cohort_workflow(*options, **engine, *out));
      return;
    }
    run_cohort(context, *options, *out, {.persons = !*group, .group = *group || options->persons.empty()});
  });
}

}  // namespace myoid::cli
