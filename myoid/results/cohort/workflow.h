#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "myoid/ground/core/choice.h"
#include "myoid/results/cohort/manifest.h"

namespace myoid::results {

/// A program that distributes jobs over processors and computers.
enum class Engine { snakemake, slurm, parallel };
inline constexpr std::string_view kEngineNames[] = {"snakemake", "slurm", "parallel"};
constexpr ChoiceNames choice_names(Engine) { return kEngineNames; }

struct WorkflowFile {
  std::string name;
  std::string text;
};

struct Workflow {
  std::vector<WorkflowFile> files;  ///< For the folder `workflow` in the folder of the cohort.
  std::string start;                ///< The command that starts the engine.
};

/// Returns the files by which an engine computes each person as one job and the group after them. All paths in them are
/// absolute. `options`: further words of `myoid cohort`, as a shell reads them. Every engine calls person.sh ID,
/// which writes logs/ID.log and returns 0 once the person's outcome is recorded, failed or not, so a person's bad
/// data do not stop the others. A killed job is started again up to two times. Snakemake starts a person again whose
/// recordings are newer than the results, and one who failed. Throws InvalidInput for Snakemake
/// where the path of the cohort has braces.
[[nodiscard]] Workflow workflow(Engine engine,
                                const Manifest& manifest,
                                const std::filesystem::path& cohort,
                                const std::string& options);

}  // namespace myoid::results
