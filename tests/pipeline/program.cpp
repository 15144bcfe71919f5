#include "program.h"

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace myoid::test {

Running::Running(const std::vector<std::string>& arguments,
                 const std::string& stdout_to,
                 const std::vector<std::string>& environment,
                 const Limits& limits)
    : stdout_to_(stdout_to) {
  const std::string out = stdout_to.empty() ? std::string(folder_ / "out") : stdout_to;
  const std::string err = folder_ / "err";
  std::vector<std::string> words{MYOID_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::vector<std::string> settings = environment;
  child_ = fork();
  if (child_ < 0) throw std::runtime_error("fork failed");
  if (child_ > 0) return;
  const auto to = [](const char* path, int flags, int target) { dup2(open(path, flags, 0600), target); };
  to("/dev/null", O_RDONLY, STDIN_FILENO);
  to(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDOUT_FILENO);
  to(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, STDERR_FILENO);
  for (std::string& setting : settings) putenv(setting.data());
  if (limits.memory_bytes > 0) {
    const rlimit memory{limits.memory_bytes, limits.memory_bytes};
    setrlimit(RLIMIT_DATA, &memory);
  }
  if (limits.file_bytes > 0) {
    const rlimit length{limits.file_bytes, limits.file_bytes};
    setrlimit(RLIMIT_FSIZE, &length);
    ::signal(SIGXFSZ, SIG_IGN);  // The write fails instead, with a cause.
  }
  alarm(limits.time_s);  // Outlives execv; 0 is none.
  execv(argv[0], argv.data());
  _exit(127);
}

Running::~Running() {
  if (ended()) return;
  send(SIGKILL);
  waitpid(child_, &status_, 0);
}

void Running::send(int signal) const { kill(child_, signal); }

bool Running::ended() {
  if (ended_) return true;
  rusage used{};
  ended_ = wait4(child_, &status_, WNOHANG, &used) == child_;
  if (ended_) most_memory_bytes_ = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
  return ended_;
}

Finished Running::wait() {
  if (!ended_) {
    rusage used{};
    wait4(child_, &status_, 0, &used);
    most_memory_bytes_ = static_cast<std::uint64_t>(used.ru_maxrss) * 1024;
    ended_ = true;
  }
  return {.exit_code = WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_),
          .out = stdout_to_.empty() ? read_text(folder_ / "out") : "",
          .err = read_text(folder_ / "err"),
          .most_memory_bytes = most_memory_bytes_};
}

Finished myoid(const std::vector<std::string>& arguments,
               double interrupt_after_s,
               const std::string& stdout_to,
               const Limits& limits) {
  Running running(arguments, stdout_to, {}, limits);
  if (interrupt_after_s > 0.0) {
    std::this_thread::sleep_for(std::chrono::duration<double>(interrupt_after_s));
    running.send(SIGINT);
  }
  return running.wait();
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw std::runtime_error("cannot read " + file.string());
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) throw std::runtime_error("cannot write " + file.string());
}

void replace_in(const std::filesystem::path& file, const std::string& from, const std::string& to) {
  std::string text = read_text(file);
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::runtime_error(file.string() + " holds no '" + from + "'");
  write_text(file, text.replace(at, from.size(), to));
}

std::vector<Row> read_rows(const std::filesystem::path& file) {
  std::istringstream stream(read_text(file));
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells(1);
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const char c = line[i];
      if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
        cells.back() += line[++i];  // a doubled quote is one
      } else if (c == '"') {
        quoted = !quoted;
      } else if (c == ',' && !quoted) {
        cells.emplace_back();
      } else if (c != '\r') {
        cells.back() += c;
      }
    }
    return cells;
  };
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> header = cells_of(line);
  std::vector<Row> rows;
  while (std::getline(stream, line)) {
    if (line.empty()) continue;
    const std::vector<std::string> cells = cells_of(line);
    Row row;
    for (std::size_t i = 0; i < header.size() && i < cells.size(); ++i) row[header[i]] = cells[i];
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace myoid::test
