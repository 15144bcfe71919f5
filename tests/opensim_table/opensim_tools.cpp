// Runs every set-up file of the shared data set by run_tool and compares the files it leaves with
// those of OpenSim 4.5.2, one row per set-up:
//
//   opensim_tools [--case NAME] [--columns] [FOLDER]
//
// Each case is copied to a scratch folder. A stage gets OpenSim's own results of the stages before,
// so that each row stands for itself. Inverse kinematics is compared with the tight run where there
// is one, also by its objective. --columns adds the worst column of each file.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "myoid/model/kinematic_tree.h"
#include "myoid/model/osim_reader.h"
#include "myoid/pipeline/opensim_files.h"
#include "myoid/pipeline/run_tool.h"
#include "myoid/pipeline/tool_stages.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/storage_reader.h"

namespace {

using namespace myoid;
namespace fs = std::filesystem;

struct Worst {
  double error = 0.0, relative = 0.0;
  std::string column;
  double time = 0.0;
  bool any = false;
};

std::size_t at(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// Worst difference of the columns that both have; `skip` rows at both ends are left out.
Worst compare(const TimeSeries& ours,
              const TimeSeries& theirs,
              Eigen::Index skip,
              const auto& their_name) {
  Worst worst;
  for (const Channel& channel : ours.channels()) {
    const auto column = theirs.find(their_name(channel.name));
    if (!column) continue;
    const auto mine = ours.column(channel.name);
    const double peak = theirs.values().col(*column).cwiseAbs().maxCoeff();
    for (Eigen::Index i = skip; i < theirs.sample_count() - skip; ++i) {
      Eigen::Index row = 0;
      (ours.time_s().array() - theirs.time_s()[i]).abs().minCoeff(&row);
      if (std::abs(ours.time_s()[row] - theirs.time_s()[i]) > 1e-5) continue;
      const double error = std::abs(mine[row] - theirs.values()(i, *column));
      worst.any = true;
      if (!(error <= worst.error)) {
        worst.error = error;
        worst.column = channel.name;
        worst.time = theirs.time_s()[i];
      }
      worst.relative = std::max(worst.relative, error / std::max(peak, 1e-12));
    }
  }
  return worst;
}

std::string same(const std::string& name) { return name; }

std::string last_part(std::string name) {
  if (name.starts_with("/forceset/")) {
    const auto bar = name.rfind('|');
    std::string owner = name.substr(10, name.find('/', 10) - 10);
    return owner + name.substr(bar);
  }
  return name;
}

/// J of inverse kinematics at the postures of a motion, frame by frame.
Eigen::VectorXd objective(const fs::path& setup_file, const fs::path& motion) {
  const pipeline::OpensimSetup setup(setup_file);
  std::vector<std::string> notes;
  const model::BodyModel model = pipeline::setup_model(setup, model::kOpenSim452, {}, notes);
  const recording::MarkerSeries markers =
      recording::read_markers(setup.required_file(setup.tool(), "marker_file")).markers;
  const TimeSeries q =
      pipeline::read_coordinates(model, motion, pipeline::MissingCoordinate::default_value, notes);
  const kinematics::IkOptions ik =
      pipeline::read_ik_tasks(setup, setup.tool(), model, markers, notes);
  model::BodyState state = model::make_state(model);
  Eigen::VectorXd result(q.sample_count());
  for (Eigen::Index i = 0; i < q.sample_count(); ++i) {
    model::compute_poses(model, q.values().row(i).transpose(), state);
    Eigen::Index frame = 0;
    (markers.time_s.array() - q.time_s()[i]).abs().minCoeff(&frame);
    double sum = 0.0, weights = 0.0;
    for (const model::Marker& marker : model.markers) {
      const auto it = std::find(markers.names.begin(), markers.names.end(), marker.name);
      const auto weight = ik.marker_weights.find(marker.name);
      if (it == markers.names.end() || (weight == ik.marker_weights.end() && ik.only_named_markers))
        continue;
      const Eigen::Index m = it - markers.names.begin();
      if (markers.missing(frame, m)) continue;
      const double w = weight == ik.marker_weights.end() ? 1.0 : weight->second;
      const Vec3 p = state.X_GB[at(marker.body)] * marker.p_BM;
      sum += w * (p - markers.position(frame, m)).squaredNorm();
      weights += w;
    }
    result[i] = weights > 0.0 ? 0.5 * sum / weights : 0.0;
    for (const kinematics::CoordinateTask& task : ik.tasks) {
      const double off =
          q.column(task.coordinate)[i] - (task.values.size() > 0 ? task.values[frame] : task.value);
      result[i] += 0.5 * task.weight * off * off;
    }
  }
  return result;
}

void copy_case(const fs::path& from, const fs::path& to) {
  fs::remove_all(to);
  fs::create_directories(to / "out");
  for (const auto& entry : fs::directory_iterator(from)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream in(entry.path(), std::ios::binary);
    std::ofstream(to / entry.path().filename(), std::ios::binary) << in.rdbuf();
  }
}

void report(const fs::path& file, const Worst& worst, const char* unit, bool columns) {
  if (!worst.any) return;
  fmt::print("|  | `{}` | {:.1e} {} | {:.1e} |{}\n", file.filename().string(), worst.error, unit,
             worst.relative,
             columns ? fmt::format(" {} at {} s", worst.column, worst.time) : std::string());
}

struct Options {
  fs::path folder;
  std::string only;
  bool columns = false;
};

void compare_ik(const fs::path& setup_file,
                const fs::path& ours_file,
                const fs::path& reference,
                bool columns) {
  fs::path tight = reference / (ours_file.stem().string() + "_tight.mot");
  if (!fs::exists(tight)) tight = reference / ours_file.filename();
  if (!fs::exists(tight)) return;
  const TimeSeries ours = recording::read_storage(ours_file).data;
  const TimeSeries theirs = recording::read_storage(tight).data;
  report(tight, compare(ours, theirs, 0, same), "deg, m", columns);
  const Eigen::VectorXd j = objective(setup_file, ours_file), k = objective(setup_file, tight);
  if (j.size() == k.size()) {
    const Eigen::ArrayXd excess = (j - k).array() / (k.array() + 1e-12);
    fmt::print("|  | objective, ours above theirs | {:.1e} | median {:.1e} |\n", excess.maxCoeff(),
               [&] {
                 Eigen::ArrayXd sorted = excess;
                 std::sort(sorted.data(), sorted.data() + sorted.size());
                 return sorted[sorted.size() / 2];
               }());
  }
}

void compare_moment_arms(const std::vector<fs::path>& files,
                         const fs::path& reference,
                         bool columns) {
  if (!fs::exists(reference)) return;
  const TimeSeries theirs = recording::read_storage(reference).data;
  Worst all;
  for (const fs::path& file : files) {
    const std::string name = file.stem().string();
    const auto start = name.find("_MomentArm_");
    if (start == std::string::npos) continue;
    const std::string coordinate = name.substr(start + 11);
    const Worst worst =
        compare(recording::read_storage(file).data, theirs, 0,
                [&](const std::string& muscle) { return muscle + "|" + coordinate; });
    all.any = all.any || worst.any;
    all.relative = std::max(all.relative, worst.relative);
    if (worst.error > all.error) {
      all.error = worst.error;
      all.column = worst.column + "|" + coordinate;
      all.time = worst.time;
    }
  }
  report(reference, all, "m", columns);
}

void run_setup(const fs::path& setup, const fs::path& reference, const Options& options) {
  const auto start = std::chrono::steady_clock::now();
  pipeline::ToolResult result;
  try {
    result = pipeline::run_tool(setup);
  } catch (const std::exception& error) {
    fmt::print("| {} | FAILED: {} |  |  |\n", setup.filename().string(), error.what());
    return;
  }
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  fmt::print("| {} | {} {} ({:.3f} s, {} of {} frames failed) |  |  |\n", setup.filename().string(),
             result.tool, result.summary, seconds, result.frames_failed, result.frames);
  if (options.columns)
    for (const std::string& note : result.notes) fmt::print("| | note: {} | | |\n", note);
  for (const fs::path& file : result.files) {
    const fs::path theirs = reference / file.filename();
    const std::string name = file.filename().string();
    if (result.tool == "InverseKinematicsTool" && file.extension() == ".mot") {
      compare_ik(setup, file, reference, options.columns);
    } else if (file.extension() == ".sto" && fs::exists(theirs) &&
               result.tool != "InverseKinematicsTool") {
      const bool dynamics = result.tool == "InverseDynamicsTool";
      const TimeSeries ours = recording::read_storage(file).data;
      const TimeSeries reference_data = recording::read_storage(theirs).data;
      const bool outputs = name.find("Outputs") != std::string::npos;
      const Worst worst =
          outputs
              ? compare(ours, reference_data, 0, last_part)
              : compare(ours, reference_data,
                        dynamics ? std::min<Eigen::Index>(10, ours.sample_count() / 4) : 0, same);
      report(theirs, worst, dynamics ? "N m, N" : "", options.columns);
    }
  }
  if (result.tool == "AnalyzeTool" && !result.files.empty()) {
    const std::string name = result.files.front().filename().string();
    compare_moment_arms(result.files,
                        reference / (name.substr(0, name.find('_')) + "_moment_arms.sto"),
                        options.columns);
  }
  // The next stage reads what OpenSim left.
  for (const fs::path& file : result.files) {
    const fs::path theirs = reference / file.filename();
    if (fs::exists(theirs)) {
      std::ifstream in(theirs, std::ios::binary);
      std::ofstream(file, std::ios::binary) << in.rdbuf();
    }
    // Scaling writes what lies beside the set-ups as an input of the next stages.
    const fs::path given = reference.parent_path() / file.filename();
    if (fs::exists(given) && file.parent_path() == setup.parent_path()) {
      std::ifstream in(given, std::ios::binary);
      std::ofstream(file, std::ios::binary) << in.rdbuf();
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  const char* folder = std::getenv("MYOID_DATA");
  options.folder =
      fs::path(folder != nullptr ? folder : MYOID_SOURCE_DIR "/../shared/data") / "opensim";
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--case" && i + 1 < argc) {
      options.only = argv[++i];
    } else if (argument == "--columns") {
      options.columns = true;
    } else {
      options.folder = argument;
    }
  }
  std::vector<fs::path> cases;
  for (const auto& entry : fs::directory_iterator(options.folder))
    if (entry.is_directory()) cases.push_back(entry.path());
  std::sort(cases.begin(), cases.end());
  for (const fs::path& folder_of_case : cases) {
    const std::string name = folder_of_case.filename().string();
    if (!options.only.empty() && name.find(options.only) == std::string::npos) continue;
    const fs::path scratch = fs::temp_directory_path() / ("myoid_opensim_tools_" + name);
    copy_case(folder_of_case, scratch);
    std::vector<fs::path> setups;
    for (const auto& entry : fs::directory_iterator(scratch)) {
      const std::string file = entry.path().filename().string();
      if (file.size() > 4 && file[0] == 's' && std::isdigit(static_cast<unsigned char>(file[1])) &&
          file.ends_with(".xml"))
        setups.push_back(entry.path());
    }
    if (setups.empty()) continue;
    std::sort(setups.begin(), setups.end());
    fmt::print(
        "\n## {}\n\n| set-up | file | worst error | of the column's peak |\n| --- | --- | --- | "
        "--- |\n",
        name);
    for (const fs::path& setup : setups) run_setup(setup, folder_of_case / "opensim", options);
    fs::remove_all(scratch);
  }
  return 0;
}
