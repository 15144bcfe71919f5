// Speed beside OpenSim 4.5.2: every set-up file of the shared data set as a process of its own,
// `myoid run-tool SETUP --threads 1`, against the times that OpenSim took (times.csv there):
//
//   opensim_speed [--program MYOID] [--runs N] [--case NAME] [FOLDER]
//
// Prints docs/data/opensim-speed.txt: seconds of the whole process by the clock, best of N,
// and of the processor; what a frame takes of the latter, (whole - the same set-up cut to one
// frame) / (frames - 1); OpenSim's seconds by the clock, and their ratio to our processor time.
// Then the floor of each model: what poses, velocities and inverse dynamics cost alone.
#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/body/model/path_survey.h"
#include "myoid/body/osim/osim_reader.h"

#include "tests/support/places.h"

extern char** environ;

namespace {

using namespace myoid;
namespace fs = std::filesystem;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

struct Run {
  double seconds = 1e9;    ///< By the clock.
  double processor = 1e9;  ///< User and system.
  int frames = 0;
  std::string failure;
};

/// The best of `runs` processes; its JSON goes to a file beside the set-up.
Run run_process(const fs::path& program, const fs::path& setup, int runs) {
  Run best;
  const std::string out = (setup.parent_path() / "stdout.json").string();
  std::string words[] = {program.string(), "run-tool", setup.string(), "--threads", "1", "--json", "--quiet"};
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  nlohmann::json json;
  for (int i = 0; i < runs; ++i) {
    // Like a first run: nothing is there to be replaced. (Moved, not removed: file systems are slow
    // to give the places of files away again.)
    if (json.contains("files")) {
      for (const auto& file : json["files"]) {
        static int count = 0;
        fs::rename(file.get<std::string>(), setup.parent_path() / "old" / std::to_string(count++));
      }
    }
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_addopen(&actions, 2, "/dev/null", O_WRONLY, 0);
    const auto start = std::chrono::steady_clock::now();
    pid_t child = 0;
    int status = -1;
    rusage usage{};
    if (posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ) == 0)
      wait4(child, &status, 0, &usage);
    const auto seconds_of = [](const timeval& t) {
      return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    best.processor = std::min(best.processor, seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime));
    best.seconds = std::min(best.seconds, seconds_since(start));
    posix_spawn_file_actions_destroy(&actions);
    if (!WIFEXITED(status) || (WEXITSTATUS(status) != 0 && WEXITSTATUS(status) != 4)) {
      best.failure = fmt::format("exit status {}", status);
      return best;
    }
    json = nlohmann::json::parse(text_of(out), nullptr, false);
    best.frames = json.value("frames", 0);
  }
  return best;
}

/// The text between a pair of tags is replaced; false if there is none.
bool replace_between(std::string& text, const std::string& tag, const auto& change) {
  const auto open = text.find("<" + tag + ">");
  const auto close = text.find("</" + tag + ">");
  if (open == std::string::npos || close == std::string::npos) return false;
  const auto first = open + tag.size() + 2;
  text.replace(first, close - first, change(text.substr(first, close - first)));
  return true;
}

/// The set-up with the end of its time range moved to the start: one frame.
std::optional<std::string> one_frame(std::string text) {
  std::string start;
  if (replace_between(text, "time_range", [&](const std::string& range) {
        std::istringstream in(range);
        in >> start;
        return start + " " + start;
      }))
    return start.empty() ? std::nullopt : std::optional(text);
  replace_between(text, "initial_time", [&](const std::string& value) { return start = value; });
  if (start.empty() || !replace_between(text, "final_time", [&](const auto&) { return start; })) return {};
  return text;
}

void copy_files(const fs::path& from, const fs::path& to) {
  fs::create_directories(to);
  if (!fs::exists(from)) return;
  for (const auto& entry : fs::directory_iterator(from))
    if (entry.is_regular_file())
      fs::copy_file(entry.path(), to / entry.path().filename(), fs::copy_options::overwrite_existing);
}

std::map<std::string, double> read_times(const fs::path& file) {
  std::map<std::string, double> times;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    const auto first = line.find(','), second = line.find(',', first + 1);
    const auto last = line.rfind(',');
    if (second == std::string::npos || second >= last) continue;
    times[line.substr(0, second)] = std::strtod(line.c_str() + last + 1, nullptr);
  }
  return times;
}

/// Microseconds a frame of one piece of work over random postures.
double microseconds(const body::BodyModel& m, const auto& work) {
  std::vector<Eigen::VectorXd> postures;
  for (std::uint64_t i = 0; i < 64; ++i) postures.push_back(body::random_posture(m, 5, i));
  double best = 1e9;
  for (int round = 0; round < 5; ++round) {
    const auto start = std::chrono::steady_clock::now();
    for (const Eigen::VectorXd& q : postures) work(q);
    best = std::min(best, seconds_since(start));
  }
  return 1e6 * best / static_cast<double>(postures.size());
}

void print_floor(const std::string& name, const body::BodyModel& m) {
  body::BodyState state = body::make_state(m);
  body::PathWorkspace workspace;
  body::PathResult path;
  const Eigen::VectorXd u = Eigen::VectorXd::Constant(state.q.size(), 0.1);
  const double poses = microseconds(m, [&](const Eigen::VectorXd& q) {
    body::compute_poses(m, q, state);
    body::compute_velocities(m, u, state);
  });
  const double dynamics =
      microseconds(m, [&](const Eigen::VectorXd& q) { (void)body::inverse_dynamics(m, q, u, u, {}, state); });
  const double paths = microseconds(m, [&](const Eigen::VectorXd& q) {
    body::compute_poses(m, q, state);
    body::compute_velocities(m, u, state);
    for (const body::Muscle& muscle : m.muscles) body::compute_path(m, muscle.path, state, workspace, path);
  });
  fmt::print("| {} | {} | {} | {} | {:.1f} µs | {:.1f} µs | {:.1f} µs |\n", name, m.bodies.size() - 1,
             m.coordinates.size(), m.muscles.size(), poses, dynamics, paths - poses);
}

struct Options {
  fs::path program, folder;
  std::string only;
  int runs = 10;
};

Options read_options(int argc, char** argv) {
  Options o;
  o.folder = myoid::test::data_folder() / "opensim";
  o.program = fs::path(argv[0]).parent_path() / "myoid";
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--program" && i + 1 < argc) {
      o.program = argv[++i];
    } else if (word == "--runs" && i + 1 < argc) {
      o.runs = std::max(1, std::atoi(argv[++i]));
    } else if (word == "--case" && i + 1 < argc) {
      o.only = argv[++i];
    } else {
      o.folder = word;
    }
  }
  return o;
}

void time_case(const Options& o,
               const fs::path& folder,
               const fs::path& scratch_root,
               const std::map<std::string, double>& times) {
  const std::string name = folder.filename().string();
  const fs::path scratch = scratch_root / name;
  fs::create_directories(scratch / "old");
  copy_files(folder, scratch);
  std::vector<fs::path> setups;
  for (const auto& entry : fs::directory_iterator(scratch)) {
    if (times.contains(name + "," + entry.path().filename().string())) setups.push_back(entry.path());
  }
  std::sort(setups.begin(), setups.end());
  for (const fs::path& setup : setups) {
    const double theirs = times.at(name + "," + setup.filename().string());
    copy_files(folder / "opensim", scratch / "out");  // what a stage takes from the one before
    const Run whole = run_process(o.program, setup, o.runs);
    if (!whole.failure.empty()) {
      fmt::print("| {} | {} | failed: {} | | | | | |\n", name, setup.stem().string(), whole.failure);
      continue;
    }
    std::string each;
    if (const auto text = one_frame(text_of(setup)); text && whole.frames > 1) {
      const fs::path cut = scratch / "cut_to_one_frame.xml";
      std::ofstream(cut, std::ios::binary) << *text;
      const Run one = run_process(o.program, cut, o.runs);
      if (one.failure.empty())
        each = fmt::format("{:.0f} µs", 1e6 * std::max(0.0, whole.processor - one.processor) / (whole.frames - 1));
    }
    fmt::print("| {} | {} | {} | {:.1f} ms | {:.1f} ms | {} | {:.0f} ms | {:.1f} |\n", name, setup.stem().string(),
               whole.frames, 1e3 * whole.seconds, 1e3 * whole.processor, each, 1e3 * theirs, theirs / whole.processor);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Options o = read_options(argc, argv);
  const std::map<std::string, double> times = read_times(o.folder / "times.csv");
  if (times.empty()) {
    fmt::print(stderr, "{} has no times.csv; set MYOID_DATA or name the folder\n", o.folder.string());
    return 3;
  }
  std::vector<fs::path> cases;
  for (const auto& entry : fs::directory_iterator(o.folder)) {
    const std::string name = entry.path().filename().string();
    if (entry.is_directory() && (o.only.empty() || name.find(o.only) != std::string::npos))
      cases.push_back(entry.path());
  }
  std::sort(cases.begin(), cases.end());
  fmt::print(
      "| case | set-up | frames | whole process | its processor time | a frame | OpenSim | times "
      "faster |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n");
  const fs::path scratch = fs::temp_directory_path() / "myoid_opensim_speed";
  fs::remove_all(scratch);
  for (const fs::path& folder : cases) time_case(o, folder, scratch, times);
  fs::remove_all(scratch);
  fmt::print(
      "\n| model | bodies | coordinates | muscles | poses and velocities | inverse dynamics | "
      "paths "
      "|\n| --- | --- | --- | --- | --- | --- | --- |\n");
  for (const fs::path& folder : cases) {
    if (!fs::exists(folder / "model.osim")) continue;
    print_floor(folder.filename().string(), body::read_osim(folder / "model.osim", {.compat = body::kOpenSim452}));
  }
  return 0;
}
