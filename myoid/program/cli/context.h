#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json_fwd.hpp>
#include <oneapi/tbb/global_control.h>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/files/result_folder.h"
#include "myoid/program/steps/call.h"

namespace myoid::program {

/// Exit codes, which scripts rely on.
enum ExitCode : int {
  kDone = 0,
  kInternalError = 1,
  kWrongCommandLine = 2,
  kBadInput = 3,
  kQualityGateFailed = 4,
  kSomeTrialsFailed = 5,
  kInterrupted = 130,
};

/// The common options of all commands, progress and log on stderr, and the way to stop.
struct Context {
  int threads = 0;  ///< 0: all cores.
  std::uint64_t seed = 1;
  bool json = false;
  bool quiet = false;
  bool verbose = false;
  bool overwrite = false;
  bool strict = false;
  std::optional<double> start_s, end_s;
  std::string command_line;
  std::string notice;  ///< A line on the command's name, which the command writes on stderr first.
  std::stop_source stop;
  int exit_code = kDone;
  mutable std::vector<std::filesystem::path> new_folders;  ///< Folders that prepare_file will make.
  /// Folders of results that this process holds; bad input leaves none of them that is empty and was made here.
  mutable std::vector<std::unique_ptr<ResultFolder>> held_folders;
  std::shared_ptr<oneapi::tbb::global_control> thread_limit;  ///< While it lives, --threads holds.

  /// Writes one line on stderr, unless --quiet.
  void log(std::string_view line) const;
  /// Writes a warning on stderr, unless --quiet.
  void warn(std::string_view line) const;
  /// Writes a remark of a command on stderr; details with --verbose only.
  void tell(const Remark& remark) const;
  /// Returns the common options for the functions of `commands`, with a listener that writes remarks.
  [[nodiscard]] program::Call call() const;
  /// Prints a result: the object with --json, else the text.
  void print(const nlohmann::ordered_json& object, const std::string& text) const;

  /// Progress bar with time left on a terminal, nothing elsewhere.
  [[nodiscard]] Progress progress() const;
  /// A line for each stage where there is no terminal.
  [[nodiscard]] std::function<void(std::string_view work, double seconds)> stage_ended() const;
  /// Ends the line of the progress bar.
  void end_progress() const;
  /// Checks the output with --overwrite. Remembers a folder that does not exist yet.
  void prepare_file(const std::filesystem::path& path, const std::vector<std::string>& inputs) const;
  /// Remembers a folder that will be made for a single file, for `tell_new_folders`.
  void remember_new_folder(const std::filesystem::path& folder) const;
  /// Names on stderr the folders that were made for single files, so that a slip in --out is seen.
  void tell_new_folders() const;
  /// Takes the folder for results until the program ends (`ResultFolder`).
  void prepare_folder(const std::filesystem::path& folder, std::string_view unless_only = "") const;
  /// Takes the folder of finished results of a run, whose report is made anew.
  void prepare_run_folder(const std::filesystem::path& folder) const;

  /// Marks the results in all held folders as whole. Without this call a folder that was empty
  /// belongs to the unfinished command, which takes the folder over when the user repeats it.
  void finish_folders() const;
  /// Gives the folders back, and names files in them that were kept or moved aside.
  void release_folders() const;

  /// Returns a clause on the held folders: "every file in out is whole, and ..." for a folder with
  /// results, else "nothing was written into out"; empty if no folder is held.
  [[nodiscard]] std::string contents_of_folders() const;
};

/// Group of the options that are accepted and do nothing: no help shows it.
inline constexpr const char* kIdleGroup = "without effect";
/// Group of the options that all commands have.
inline constexpr const char* kCommonGroup = "Common options";

/// The common options that a command uses. Every command accepts all of them. The help leaves out
/// an option without effect, and the program warns where it is given.
struct CommonOptions {
  bool threads = true, seed = true, json = true, range = true, overwrite = true;
};

/// Adds --threads, --seed, --json, --quiet, --verbose, --start, --end, --overwrite to a command.
void add_common_options(CLI::App& command, Context& context, const CommonOptions& used = {});

/// Warns of each option that the user gave and that is neither `used` nor one of output; `subject` is "a recording".
void warn_of_idle_options(const CLI::App& command,
                          const Context& context,
                          const std::vector<std::string_view>& used,
                          std::string_view subject);

/// Adds a command to the program.
using AddCommand = void(CLI::App& app, Context& context);
AddCommand add_check, add_cohort, add_compare, add_convert, add_demo, add_design, add_emg, add_id, add_identify, add_ik,
    add_info, add_init, add_muscle, add_paths, add_predict, add_report, add_review, add_run, add_simulate, add_run_tool,
    add_so, add_twin, add_twin_study;

}  // namespace myoid::program
