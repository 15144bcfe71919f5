#include <cstdlib>
#include <filesystem>
#include <string>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/files/output_file.h"
#include "myoid/ground/files/result_folder.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/run.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/commands/check.h"
#include "myoid/program/commands/twin.h"

namespace myoid::program {
namespace {

namespace fs = std::filesystem;

/// Opens the page in the desktop's browser. Returns false where there is no desktop, or where nothing opens pages.
bool open_page(const fs::path& page) {
  if (std::getenv("DISPLAY") == nullptr && std::getenv("WAYLAND_DISPLAY") == nullptr) return false;
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&quiet, stream, "/dev/null", O_WRONLY, 0);
  std::string opener = "xdg-open", file = page.string();
  char* const words[] = {opener.data(), file.data(), nullptr};
  pid_t process = 0;
  const bool begun = posix_spawnp(&process, words[0], &quiet, nullptr, words, environ) == 0;
  posix_spawn_file_actions_destroy(&quiet);
  int status = 0;
  return begun && waitpid(process, &status, 0) == process && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void make_recording(Context& context, const std::string& folder) {
  context.prepare_folder(folder);
  const program::TwinOptions options{.call = context.call(), .protocol = std::string(lab::kDemoProtocol)};
  protect_files(folder, program::kTwinFiles, {});
  const program::TwinResult result = program::twin(options);
  program::write_twin(result, folder);
  context.log(fmt::format("a virtual person, {} with markers and raw EMG: {}",
                          counted(result.recording.trials.size(), "trial"), folder));
}

void check_recording(Context& context, const std::string& study) {
  const program::CheckResult checked = program::check({.call = context.call(), .input = study});
  context.log(fmt::format("its study, checked: {}, {}, {}", counted(checked.trials, "trial"),
                          counted(checked.muscles, "muscle"), counted(checked.errors, "error")));
}

}  // namespace

void add_demo(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "demo",
      "A first look without files: records a virtual person, whose muscles are known, checks the recording, identifies "
      "the muscles, and opens the report.\n"
      "Example: myoid demo");
  const auto out = std::make_shared<std::string>("myoid-demo");
  const auto closed = std::make_shared<bool>(false);
  command.add_option("--out", *out, "Folder for the recording and the results")->capture_default_str();
  command.add_flag("--no-open", *closed, "Leaves the report closed");
  add_common_options(command, context, {.range = false});
  command.callback([&context, out, closed] {
    require_results_place(*out);
    const std::string recording = (fs::path(*out) / "recording").string();
    const std::string results = (fs::path(*out) / "result").string();
    make_recording(context, recording);
    const std::string study = (fs::path(recording) / "study.toml").string();
    check_recording(context, study);
    program::Call call = context.call();
    call.seed = program::Call{}.seed;  // --seed chose the person; a run draws nothing by it
    const program::RunResult result = compute_run(context, {.call = std::move(call), .study = study, .out = results});
    say_run(context, result, results);
    if (!*closed && !context.json && !open_page(fs::absolute(fs::path(results) / "report.html")))
      context.log("open the report in a browser: it works offline");
  });
}

}  // namespace myoid::program
