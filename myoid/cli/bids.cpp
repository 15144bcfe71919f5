#include <memory>

#include "myoid/cli/cohort_run.h"
#include "myoid/cli/context.h"
#include "myoid/commands/cohort.h"

namespace myoid::cli {

void add_bids(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("bids",
                          "A BIDS data set, in the form of a BIDS App: first every participant, then the group.\n"
                          "Example: myoid bids data out participant --participant-label 01 02");
  const auto out = std::make_shared<std::string>();
  const auto level = std::make_shared<std::string>();
  const auto options = std::make_shared<commands::CohortOptions>();
  command.add_option("bids_dir", options->manifest, "Folder of the data set")
      ->required()
      ->check(CLI::ExistingDirectory);
  command.add_option("output_dir", *out, "Folder of the results, a BIDS derivative")->required();
  command.add_option("analysis_level", *level, "participant or group")
      ->required()
      ->check(CLI::IsMember({"participant", "group"}));
  command.add_option("--participant-label,--participant_label", options->persons,
                     "Labels without sub-, several (default: everybody)");
  command.add_option("--study", options->study, "The study of every person (default: code/study.toml of the data set)");
  add_cohort_options(command, *options);
  add_common_options(command, context, {.seed = false});
  command.callback([&context, options, out, level] {
    const bool group = *level == "group";
    run_cohort(context, *options, *out, {.persons = !group, .group = group});
  });
}

}  // namespace myoid::cli
