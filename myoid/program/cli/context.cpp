#include "myoid/program/cli/context.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <stop_token>
#include <string>
#include <system_error>
#include <thread>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/info.h>
#include <pthread.h>
#include <unistd.h>

#include "myoid/ground/core/json_text.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/files/folder_lock.h"
#include "myoid/ground/files/output_file.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/cli/wrong_line.h"

namespace myoid::program {
namespace {

bool color_wanted() { return isatty(STDERR_FILENO) != 0 && std::getenv("NO_COLOR") == nullptr; }

/// Draws a bar at most ten times a second; where there is no terminal, a line every ten seconds, also while nothing
/// reports. Shared by the threads that report.
class ProgressBar {
 public:
  void draw(double share, std::string_view what) {
    const std::scoped_lock lock(mutex_);
    if (!terminal_) return keep(share, what);
    const auto now = Clock::now();
    if (share < 1.0 && now - last_ < std::chrono::milliseconds(100)) return;
    last_ = now;
    const double elapsed_s = std::chrono::duration<double>(now - begin_).count();
    const std::string left =
        share > 0.02 && share < 1.0 ? fmt::format("{:.0f} s left", elapsed_s * (1.0 - share) / share) : "";
    const int filled = static_cast<int>(share * 24.0);
    std::fputs("\r\033[K", stderr);
    say_error("[{:=<{}}{: <{}}] {:3.0f} %  {}  {}", "", filled, "", 24 - filled, 100.0 * share, left, what);
    std::fflush(stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// Remembers the state for the lines, which a thread of their own writes; without a thread there are none.
  void keep(double share, std::string_view what) {
    share_ = share;
    what_ = what;
    if (lines_.joinable() || refused_) return;
    try {
      lines_ = std::jthread([this](const std::stop_token& stop) { write_lines(stop); });
    } catch (const std::system_error&) {
      refused_ = true;
    }
  }

  void write_lines(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, stop, std::chrono::seconds(10), [&] { return stop.stop_requested(); }))
      if (share_ < 1.0)
        say_error("  {:.0f} %, {}, {:.0f} s so far\n", 100.0 * share_, what_,
                  std::chrono::duration<double>(Clock::now() - begin_).count());
  }

  const bool terminal_ = isatty(STDERR_FILENO) != 0;
  std::mutex mutex_;
  Clock::time_point begin_ = Clock::now(), last_{};
  double share_ = 0.0;
  std::string what_;
  bool refused_ = false;
  std::condition_variable_any wake_;
  std::jthread lines_;  ///< The last member: it stops before the others go.
};

}  // namespace

namespace {

/// Counts the threads, at most `wanted`, that the system grants this process at the same time
/// beside the calling one: the function makes all, lets them wait for each other, and ends them.
/// Limits on processes (`ulimit -u`, a container's pids) and on memory (`ulimit -v`) bind here.
int granted_threads(int wanted) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  // As large as the scheduler's own.
  pthread_attr_setstacksize(&attributes,
                            oneapi::tbb::global_control::active_value(oneapi::tbb::global_control::thread_stack_size));
  std::mutex gate;
  const auto pass = [](void* held) -> void* {
    const std::scoped_lock lock(*static_cast<std::mutex*>(held));
    return nullptr;
  };
  std::vector<pthread_t> threads;
  {
    const std::scoped_lock all_at_once(gate);
    pthread_t thread{};
    while (static_cast<int>(threads.size()) < wanted && pthread_create(&thread, &attributes, pass, &gate) == 0)
      threads.push_back(thread);
  }
  for (const pthread_t thread : threads) pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  return static_cast<int>(threads.size());
}

/// Limits the threads to --threads or the number of cores, and to the number that the system
/// grants: the scheduler ends the program where the system refuses a thread.
void limit_threads(Context& context) {
  const int wanted = context.threads > 0 ? context.threads : oneapi::tbb::info::default_concurrency();
  const int granted = wanted > 1 ? std::max(1, granted_threads(wanted)) : wanted;
  if (granted < wanted) {
    context.warn(
        fmt::format("the system grants fewer threads than the {} that are wanted; going on with {}: more needs higher "
                    "limits on processes and memory (ulimit -u, ulimit -v)",
                    wanted, granted));
  }
  if (context.threads == 0 && granted == wanted) return;
  context.thread_limit = std::make_shared<oneapi::tbb::global_control>(
      oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(granted));
  // A limit that is lifted at the end lets the scheduler ask for a thread once more.
  static const auto* const kept = new std::shared_ptr<oneapi::tbb::global_control>(context.thread_limit);
  (void)kept;
}

}  // namespace

void Context::log(std::string_view line) const {
  std::fflush(stdout);  // keeps the order of the two streams in one file
  if (!quiet) say_error("{}\n", line);
}

void Context::warn(std::string_view line) const {
  if (quiet) return;
  std::fputs(color_wanted() ? "\033[33mwarning:\033[0m " : "warning: ", stderr);
  say_error("{}\n", line);
}

void Context::tell(const Remark& remark) const {
  if (remark.severity == Severity::detail && !verbose) return;
  end_progress();
  remark.severity <= Severity::warning ? warn(sentence(remark)) : log(sentence(remark));
}

void Context::print(const nlohmann::ordered_json& object, const std::string& text) const {
  json ? say_whole(json_text(object) + "\n") : say("{}\n", text);
}

program::Call Context::call() const {
  return {.seed = seed,
          .start_s = start_s,
          .end_s = end_s,
          .overwrite = overwrite,
          .quiet = quiet,
          .command = command_line,
          .progress = progress(),
          .stage_ended = stage_ended(),
          .listener = [this](const Remark& remark) { tell(remark); }};
}

Progress Context::progress() const {
  Progress progress{.report = {}, .stop = stop.get_token()};
  if (!quiet) {
    const auto bar = std::make_shared<ProgressBar>();
    progress.report = [bar](double share, std::string_view what) { bar->draw(share, what); };
  }
  return progress;
}

std::function<void(std::string_view, double)> Context::stage_ended() const {
  if (quiet || isatty(STDERR_FILENO) != 0) return {};
  return [this](std::string_view work, double seconds) { log(fmt::format("{} ... {:.1f} s", work, seconds)); };
}

void Context::end_progress() const {
  if (!quiet && isatty(STDERR_FILENO) != 0) std::fputs("\r\033[K", stderr);
}

void Context::prepare_file(const std::filesystem::path& path, const std::vector<std::string>& inputs) const {
  check_output(path, inputs, overwrite);
  remember_new_folder(path.parent_path());
}

void Context::remember_new_folder(const std::filesystem::path& folder) const {
  std::error_code ignored;
  if (!folder.empty() && !std::filesystem::exists(folder, ignored) &&
      std::ranges::find(new_folders, folder) == new_folders.end())
    new_folders.push_back(folder);
}

void Context::tell_new_folders() const {
  std::error_code ignored;
  for (const std::filesystem::path& folder : new_folders) {
    if (std::filesystem::exists(folder, ignored))
      log(fmt::format("the folder {} was not there; it was made", folder.string()));
  }
}

void Context::prepare_folder(const std::filesystem::path& folder, std::string_view unless_only) const {
  held_folders.push_back(std::make_unique<ResultFolder>(folder, command_line, overwrite, unless_only));
  if (const std::string& note = held_folders.back()->note(); !note.empty()) log(note);
}

void Context::prepare_run_folder(const std::filesystem::path& folder) const {
  const std::string author = author_of(folder / "run.json");
  held_folders.push_back(std::make_unique<ResultFolder>(folder, command_line, author.empty() ? "run" : author, true));
}

void Context::finish_folders() const {
  for (const auto& held : held_folders) held->finish();
}

void Context::release_folders() const {
  for (const auto& held : held_folders)
    for (const std::string& note : held->take_notes()) log(note);
  held_folders.clear();
}

std::string Context::contents_of_folders() const {
  std::vector<std::string> clauses;
  for (const auto& held : held_folders) {
    const std::string folder = held->path().string();
    clauses.push_back(holds_content(held->path())
                          ? fmt::format("every file in {} is whole, and the same command takes it over", folder)
                          : fmt::format("nothing was written into {}", folder));
  }
  return fmt::format("{}", fmt::join(clauses, "; "));
}

void add_common_options(CLI::App& command, Context& context, const CommonOptions& used) {
  std::vector<CLI::Option*> idle;
  command.get_help_ptr()->group(kCommonGroup);
  command.option_defaults()->group(kCommonGroup);
  const auto unless = [&](bool has_effect, CLI::Option* option) {
    if (has_effect) return;
    option->group(kIdleGroup);
    idle.push_back(option);
  };
  unless(used.threads,
         command.add_option("--threads", context.threads, "Number of threads; the result is the same for every number")
             ->default_str("all cores")
             ->check(between(0, 1024)));
  unless(used.seed, command.add_option("--seed", context.seed, "Seed of everything random")
                        ->default_str("1")
                        ->check(between(0, kInfinity)));
  unless(used.json, command.add_flag("--json", context.json, "Result for machines on stdout"));
  command.add_flag("--quiet", context.quiet, "Nothing on stderr but errors");
  command.add_flag("--verbose", context.verbose, "More: all numbers and gates of a run, repairs, timings");
  unless(used.range, command.add_option("--start", context.start_s, "First time that is used [s]"));
  unless(used.range, command.add_option("--end", context.end_s, "Last time that is used [s]"));
  unless(used.overwrite, command.add_flag("--overwrite", context.overwrite, "Replace existing results"));
  command.option_defaults()->group("Options");
  command.parse_complete_callback([&context, idle, uses_threads = used.threads, name = command.get_name()] {
    if (!context.notice.empty()) context.log(context.notice);
    if (context.start_s && context.end_s && !(*context.start_s < *context.end_s)) {
      throw WrongCommandLine(
          fmt::format("--end: expected a time after --start {}, found {}", *context.start_s, *context.end_s));
    }
    for (const CLI::Option* option : idle) {
      if (option->count() > 0)
        context.warn(fmt::format("--{} has no effect on {}", option->get_lnames().front(), name));
    }
    if (uses_threads) limit_threads(context);
  });
}

void warn_of_idle_options(const CLI::App& command,
                          const Context& context,
                          const std::vector<std::string_view>& used,
                          std::string_view subject) {
  constexpr std::array<std::string_view, 3> kOutput{"--json", "--quiet", "--verbose"};
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    // An option of kIdleGroup has its warning already.
    if (option->count() == 0 || !option->nonpositional() || option->get_group() == kIdleGroup) continue;
    if (std::ranges::find(used, name) == used.end() && std::ranges::find(kOutput, name) == kOutput.end())
      context.warn(fmt::format("{} has no effect on {}", name, subject));
  }
}

}  // namespace myoid::program
