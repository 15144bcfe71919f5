// The program: it parses the command line, calls a command and returns an exit code.
#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <malloc.h>
#include <pthread.h>
#include <unistd.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/input_log.h"
#include "myoid/program/cli/command_help.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/help_files.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/cli/wrong_line.h"

namespace {

/// Keeps freed memory for the next matrices. A fit makes matrices of some MB again and again. The system clears the
/// pages of fresh memory each time, which takes half of the time of a leg's fit.
void keep_freed_memory() {
#ifdef __GLIBC__
  constexpr int kFromTheHeap = 32 << 20;  // bytes: the largest threshold that the allocator takes
  mallopt(M_MMAP_THRESHOLD, kFromTheHeap);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
  mallopt(M_TOP_PAD, kFromTheHeap);
#endif
}

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
      _exit(myoid::program::kInterrupted);
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
  myoid::program::say_error(
      "error: the program cannot go on: {}\nIf a thread could not be made, give --threads 1, or raise the "
      "limits on processes and memory (ulimit -u, ulimit -v).\n",
      what);
  _exit(myoid::program::kInternalError);
}

/// Reports a result that standard output did not take.
int stdout_lost(const char* cause) {
  myoid::program::say_error("error: the result could not be written to standard output: {}\n", cause);
  return myoid::program::kBadInput;
}

struct Command {
  const char* name;
  void (*add)(CLI::App&, myoid::program::Context&);
  const char* group;
};

constexpr const char* kStudy = "One study";
constexpr const char* kPersons = "Many persons";
constexpr const char* kSteps = "Single steps, from file to file";
constexpr const char* kOpenSim = "OpenSim and other programs";
constexpr const char* kVirtual = "Virtual persons and movements";

/// In the order of the help.
constexpr Command kCommands[] = {
    {"demo", myoid::program::add_demo, kStudy},
    {"run", myoid::program::add_run, kStudy},
    {"init", myoid::program::add_init, kStudy},
    {"check", myoid::program::add_check, kStudy},
    {"report", myoid::program::add_report, kStudy},
    {"predict", myoid::program::add_predict, kStudy},
    {"compare", myoid::program::add_compare, kStudy},
    {"design", myoid::program::add_design, kStudy},
    {"cohort", myoid::program::add_cohort, kPersons},
    {"info", myoid::program::add_info, kSteps},
    {"convert", myoid::program::add_convert, kSteps},
    {"emg", myoid::program::add_emg, kSteps},
    {"ik", myoid::program::add_ik, kSteps},
    {"id", myoid::program::add_id, kSteps},
    {"paths", myoid::program::add_paths, kSteps},
    {"so", myoid::program::add_so, kSteps},
    {"identify", myoid::program::add_identify, kSteps},
    {"muscle", myoid::program::add_muscle, kSteps},
    {"review", myoid::program::add_review, kOpenSim},
    {"run-tool", myoid::program::add_run_tool, kOpenSim},
    {"twin", myoid::program::add_twin, kVirtual},
    {"twin-study", myoid::program::add_twin_study, kVirtual},
    {"simulate", myoid::program::add_simulate, kVirtual},
};

/// A name that a command has beside its own; no list of commands shows it.
struct OtherName {
  std::string_view name;
  std::string_view command;
  const char* option = nullptr;    ///< The option of the command that the name stands for, if any.
  const char* required = nullptr;  ///< An argument without which the name calls nothing, if any.
};

constexpr OtherName kOtherNames[] = {
    {.name = "bids", .command = "cohort", .required = "analysis_level"},
    {.name = "settings", .command = "check", .option = "--defaults"},
    {.name = "update-file", .command = "convert"},
};

const OtherName* find_other_name(std::string_view name) {
  const auto* const found = std::ranges::find(kOtherNames, name, &OtherName::name);
  return found == std::end(kOtherNames) ? nullptr : found;
}

const Command* find_command(std::string_view name) {
  const OtherName* const other = find_other_name(name);
  for (const Command& command : kCommands)
    if ((other ? other->command : name) == command.name) return &command;
  return nullptr;
}

int unknown_command(std::string_view word) {
  std::vector<std::string> names;
  for (const Command& command : kCommands) names.emplace_back(command.name);
  const auto near = myoid::program::meant(word, names);
  myoid::program::say_error("error: there is no command '{}'{}; there are {}\n", word,
                            near ? fmt::format(" (did you mean '{}'?)", *near) : "", fmt::join(names, ", "));
  return myoid::program::kWrongCommandLine;
}

/// Stands behind a word that ends in ']': CLI11 takes "[a,b]" for a list of two words, and names may look so.
constexpr char kMark = '\x1f';

int wrong_command_line(std::string sentence) {
  std::erase(sentence, kMark);
  myoid::program::say_error("error: {}\n", sentence);
  return myoid::program::kWrongCommandLine;
}

/// Returns the words in the reverse order, as CLI11 takes them.
std::vector<std::string> marked(std::vector<std::string> words) {
  std::ranges::reverse(words);
  for (std::string& word : words)
    if (word.ends_with(']')) word += kMark;
  return words;
}

std::string take_mark(std::string& word) {
  if (word.ends_with(kMark)) word.pop_back();
  return {};
}

/// Declares a command. Before its own checks, each option drops the mark and takes only numbers for a number.
CLI::App* declare(const Command& command, CLI::App& app, myoid::program::Context& context) {
  command.add(app, context);
  CLI::App* const declared = app.get_subcommand(command.name);
  declared->group(command.group);
  for (const OtherName& other : kOtherNames)
    if (other.command == command.name) declared->alias(std::string(other.name));
  for (CLI::Option* option : declared->get_options()) {
    const std::string declared_type = option->get_type_name();
    const std::string type = declared_type.substr(0, declared_type.find(':'));
    option->transform(CLI::Validator(
        [type](std::string& text) { return take_mark(text) + myoid::program::refused_number(text, type); }, "",
        "word"));
  }
  return declared;
}

/// Prints the help of the program, its version or what is wrong, where no command is called.
int without_command(CLI::App& app, const std::vector<std::string>& words, myoid::program::Context& context) {
  using namespace myoid;
  const std::string word = words.empty() ? "--help" : words.front();
  if (words.size() == 2 && word == program::kHelpFilesWord) {
    for (const Command& command : kCommands) declare(command, app, context);
    program::write_help_files(app, words[1]);
    return program::kDone;
  }
  if (word == "--version" || word == "-V") {
    program::say("{}\n", version());
    return program::kDone;
  }
  if (word == "--help" || word == "-h") {
    for (const Command& command : kCommands) declare(command, app, context);
    program::say("{}", program::program_text(app, program::help_width()));
    return program::kDone;
  }
  if (!word.starts_with('-')) return unknown_command(word);
  const auto command = std::ranges::find_if(words, [](const std::string& each) { return find_command(each); });
  if (command != words.end())
    return wrong_command_line(
        fmt::format("{} stands before the command; options stand behind it: myoid {} ... {}", word, *command, word));
  const auto near = program::meant(word, {"--help", "--version"});
  return wrong_command_line(near ? fmt::format("unknown option '{}'; did you mean {}?", word, *near)
                                 : fmt::format("unknown option '{}'; myoid --help lists the commands", word));
}

int run(std::vector<std::string> words, myoid::program::Context& context) {
  using namespace myoid;
  CLI::App app{
      "Myoid identifies a person's own muscle parameters from motion capture and EMG,\n"
      "says how sure it is of each, and names the parameters that the recording leaves open.",
      "myoid"};
  app.set_help_flag("-h,--help", "This help");
  app.set_version_flag("-V,--version", std::string(version()), "The version");
  if (!words.empty() && words.front() == "help") {
    words.erase(words.begin());
    words.resize(std::min<std::size_t>(words.size(), 1));
    words.emplace_back("--help");
  }
  // Declaring the options of all commands takes longer than a small run.
  const Command* const called = find_command(words.empty() ? "" : words.front());
  if (called == nullptr) return without_command(app, words, context);
  CLI::App* const command = declare(*called, app, context);
  if (const OtherName* const other = find_other_name(words.front())) {
    context.notice = fmt::format("note: myoid {}{}{} takes the place of {}", called->name, other->option ? " " : "",
                                 other->option ? other->option : "", other->name);
    if (other->option) words.insert(words.begin() + 1, other->option);
    if (other->required) command->get_option(other->required)->required();
  }
  const std::string missing = program::missing_value(*command, {words.begin() + 1, words.end()});
  if (!missing.empty()) return wrong_command_line(missing);
  try {
    app.parse(marked(words));
  } catch (const CLI::CallForHelp&) {
    if (!context.notice.empty()) context.log(context.notice);
    program::say("{}", program::command_text(*command, program::help_width()));
    return program::kDone;
  } catch (const CLI::ParseError& error) {
    return wrong_command_line(program::wrong_line(*command, error));
  } catch (const program::WrongCommandLine& error) {
    return wrong_command_line(error.what());
  }
  context.tell_new_folders();
  return context.exit_code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace myoid;
  program::Context context;
  for (int i = 0; i < argc; ++i) context.command_line += (i == 0 ? "" : " ") + std::string(i == 0 ? "myoid" : argv[i]);
  keep_freed_memory();
  std::set_terminate(end_with_a_message);
  stop_on_signals(context.stop);
  const InputLog inputs;
  try {
    const int code = ::run({argv + std::min(argc, 1), argv + argc}, context);
    context.finish_folders();
    context.release_folders();
    if (std::fflush(stdout) != 0) return stdout_lost(std::strerror(errno));
    return code;
  } catch (const Interrupted&) {
    context.end_progress();
    const std::string contents = context.contents_of_folders();
    context.release_folders();
    myoid::program::say_error("interrupted; {}\n", contents.empty() ? "no file is half-written" : contents);
    return program::kInterrupted;
  } catch (const InvalidInput& error) {
    context.end_progress();
    context.release_folders();
    myoid::program::say_error("error: {}\n", error.what());
    return program::kBadInput;
  } catch (const std::bad_alloc&) {
    context.end_progress();
    context.release_folders();
    program::say_error(
        "error: these files need more memory than this program may use; close other programs, raise the limit "
        "(ulimit -v), or cut the recordings into parts\n");
    return program::kBadInput;
  } catch (const std::exception& error) {
    context.end_progress();
    context.release_folders();
    if (std::ferror(stdout) != 0) return stdout_lost(error.what());
    myoid::program::say_error(
        "internal error: {}\nPlease report this with the command line and, if you can, the files.\n", error.what());
    return program::kInternalError;
  }
}
