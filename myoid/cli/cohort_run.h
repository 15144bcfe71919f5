#pragma once

#include <filesystem>

#include "myoid/cli/context.h"
#include "myoid/commands/cohort.h"

namespace myoid::cli {

/// The steps of a cohort that a command line asks for.
struct CohortSteps {
  bool persons = true, group = true;
};

/// Computes the persons, the group, or both, prints the outcomes and sets the exit code.
void run_cohort(Context& context,
                commands::CohortOptions options,
                const std::filesystem::path& folder,
                const CohortSteps& steps);

/// Adds --estimator and --jobs to a command.
void add_cohort_options(CLI::App& command, commands::CohortOptions& options);

}  // namespace myoid::cli
