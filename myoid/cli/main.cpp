// The program: it parses the command line, calls a command and returns an exit code.
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pthread.h>
#include <unistd.h>

#include "myoid/cli/context.h"
#include "myoid/cli/help_files.h"
#include "myoid/core/error.h"
#include "myoid/core/provenance.h"
#include "myoid/files/toml_table.h"

namespace {

/// Waits for SIGINT (Ctrl-C) or SIGTERM: the first asks the work to stop, the second ends the
/// program at once. Where the system refuses the thread that waits, the first ends the program.
void stop_on_signals(std::stop_source stop) {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
  std::signal(SIGXFSZ, SIG_IGN);  // a file over the limit of sizes is an error of its write
  try {
    std::thread([signals, stop]() mutable {
      int received = 0;
      sigwait(&signals, &received);
      stop.request_stop();
      sigwait(&signals, &received);
      _exit(myoid::cli::kInterrupted);
    }).detach();
  } catch (const std::system_error&) {
    pthread_sigmask(SIG_UNBLOCK, &signals, nullptr);
  }
}

/// Ends the program at an error that no caller can catch: the scheduler throws where the system refuses a thread.
[[noreturn]] void end_with_a_message() {
  std::string what = "unknown";
  if (const std::exception_ptr error = std::current_exception()) {
    try {
      std::rethrow_exception(error);
    } catch (const std::exception& known) {
      what = known.what();
    } catch (...) {
    }
  }
  fmt::print(stderr,
             "error: the program cannot go on: {}\nIf a thread could not be made, give --threads 1, or raise the "
             "limits on processes and memory (ulimit -u, ulimit -v).\n",
             what);
  _exit(myoid::cli::kInternalError);
}

/// Reports a result that standard output did not take.
int stdout_lost(const char* cause) {
  fmt::print(stderr, "error: the result could not be written to standard output: {}\n", cause);
  return myoid::cli::kBadInput;
}

struct Command {
  const char* name;
  void (*add)(CLI::App&, myoid::cli::Context&);
};

/// In the order of the help.
constexpr Command kCommands[] = {
    {"run", myoid::cli::add_run},
    {"init", myoid::cli::add_init},
    {"check", myoid::cli::add_check},
    {"compare", myoid::cli::add_compare},
    {"cohort", myoid::cli::add_cohort},
    {"bids", myoid::cli::add_bids},
    {"settings", myoid::cli::add_settings},
    {"info", myoid::cli::add_info},
    {"convert", myoid::cli::add_convert},
    {"emg", myoid::cli::add_emg},
    {"ik", myoid::cli::add_ik},
    {"id", myoid::cli::add_id},
    {"paths", myoid::cli::add_paths},
    {"so", myoid::cli::add_so},
    {"identify", myoid::cli::add_identify},
    {"muscle", myoid::cli::add_muscle},
    {"simulate", myoid::cli::add_simulate},
    {"twin", myoid::cli::add_twin},
    {"twin-study", myoid::cli::add_twin_study},
    {"design", myoid::cli::add_design},
    {"predict", myoid::cli::add_predict},
    {"report", myoid::cli::add_report},
    {"run-tool", myoid::cli::add_run_tool},
    {"update-file", myoid::cli::add_update_file},
};

const Command* find_command(std::string_view name) {
  for (const Command& command : kCommands)
    if (name == command.name) return &command;
  return nullptr;
}

int unknown_command(std::string_view word) {
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.emplace_back(command.name);
  const auto near = myoid::recording::nearest_word(word, names);
  fmt::print(stderr, "error: there is no command '{}'{}; there are {}\n", word,
             near ? fmt::format(" (did you mean '{}'?)", *near) : "", fmt::join(names, ", "));
  return myoid::cli::kWrongCommandLine;
}

/// Writes arguments without dashes in capitals, as in the guide: "run [OPTIONS] STUDY".
class CapitalPositionals : public CLI::Formatter {
 public:
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    return is_positional ? myoid::cli::in_capitals(CLI::Formatter::make_option_name(option, true))
                         : CLI::Formatter::make_option_name(option, false);
  }
  std::string make_group(std::string group,
                         bool is_positional,
                         std::vector<const CLI::Option*> options) const override {
    if (group == myoid::cli::kIdleGroup) return "";
    return CLI::Formatter::make_group(std::move(group), is_positional, std::move(options));
  }
  std::string make_option_usage(const CLI::Option* option) const override {
    return myoid::cli::in_capitals(CLI::Formatter::make_option_usage(option));
  }
};

/// Returns a sentence on an option that takes one value and has several; empty: there is none.
std::string repeated_option(CLI::App& app) {
  for (const CLI::App* command : app.get_subcommands()) {
    for (const CLI::Option* option : command->get_options()) {
      const bool takes_one =
          option->get_items_expected_max() == 1 && option->get_multi_option_policy() == CLI::MultiOptionPolicy::Throw;
      if (takes_one && option->results().size() > 1)
        return fmt::format("{} is given {} times ({}); it takes one value", option->get_name(),
                           option->results().size(), fmt::join(option->results(), ", "));
    }
  }
  return "";
}

int run(int argc, char** argv, myoid::cli::Context& context) {
  CLI::App app{
      "Myoid identifies a person's own muscle parameters from motion capture and EMG,\n"
      "says how sure it is of each, and names the parameters that the recording leaves open.",
      "myoid"};
  app.set_version_flag("--version,-V", std::string(myoid::version()));
  app.require_subcommand(0, 1);
  // Declaring the options of all commands takes longer than a small run.
  const std::string_view word = argc > 1 ? argv[1] : "";
  const Command* const called = find_command(word);
  if (called == nullptr && argc == 3 && word == myoid::cli::kHelpFilesWord) {
    for (const Command& command : kCommands) command.add(app, context);
    myoid::cli::write_help_files(app, argv[2]);
    return myoid::cli::kDone;
  }
  if (called == nullptr) {
    app.footer(
        "myoid COMMAND --help shows a command's purpose, an example and its options.\n"
        "First steps: myoid twin --protocol examples/demo/protocol.toml --out rec\n"
        "             myoid run rec/study.toml --out results");
    if (!word.empty() && word[0] != '-') return unknown_command(word);
  }
  app.formatter(std::make_shared<CapitalPositionals>());
  for (const Command& command : kCommands) {
    if (called == nullptr || called == &command) command.add(app, context);
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (const std::string repeated = repeated_option(app); !repeated.empty()) {
      fmt::print(stderr, "error: {}\n", repeated);
      return myoid::cli::kWrongCommandLine;
    }
    const int code = app.exit(error);
    return code == 0 ? myoid::cli::kDone : myoid::cli::kWrongCommandLine;
  }
  context.tell_new_folders();
  if (app.get_subcommands().empty()) fmt::print("{}", app.help());
  return context.exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace myoid;
  cli::Context context;
  for (int i = 0; i < argc; ++i) context.command_line += (i == 0 ? "" : " ") + std::string(i == 0 ? "myoid" : argv[i]);
  std::set_terminate(end_with_a_message);
  stop_on_signals(context.stop);
  try {
    const int code = run(argc, argv, context);
    context.finish_folders();
    if (std::fflush(stdout) != 0) return stdout_lost(std::strerror(errno));
    return code;
  } catch (const Interrupted&) {
    context.end_progress();
    const std::string contents = context.contents_of_folders();
    context.held_folders.clear();
    fmt::print(stderr, "interrupted; {}\n", contents.empty() ? "no file is half-written" : contents);
    return cli::kInterrupted;
  } catch (const InvalidInput& error) {
    context.end_progress();
    context.held_folders.clear();
    fmt::print(stderr, "error: {}\n", error.what());
    return cli::kBadInput;
  } catch (const std::bad_alloc&) {
    context.end_progress();
    context.held_folders.clear();
    fmt::print(stderr,
               "error: these files need more memory than this program may use; close other programs, raise the limit "
               "(ulimit -v), or cut the recordings into parts\n");
    return cli::kBadInput;
  } catch (const std::exception& error) {
    context.end_progress();
    context.held_folders.clear();
    if (std::ferror(stdout) != 0) return stdout_lost(error.what());
    fmt::print(stderr, "internal error: {}\nPlease report this with the command line and, if you can, the files.\n",
               error.what());
    return cli::kInternalError;
  }
}
