// Runs every set-up file of the shared data set by run_tool and compares the files it leaves with
// those of OpenSim 4.5.2; prints docs/data/opensim-tools.txt, one row per file:
//
//   opensim_tools [--case NAME] [--columns] [FOLDER]
//
// Each case is copied to a scratch folder. A stage gets OpenSim's own results of the stages before,
// so that each row stands for itself. Inverse kinematics is compared with the tight run where there
// is one, also by its objective; static optimization also by cost and constraint residual of every
// frame. --columns adds the worst column of each file, and what the tools said.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/body/osim/osim_writer.h"
#include "myoid/ground/core/index.h"
#include "myoid/opensim/opensim_files.h"
#include "myoid/opensim/run_tool.h"
#include "myoid/opensim/tool_stages.h"
#include "myoid/recording/recording.h"
#include "myoid/recording/tables/storage_reader.h"

#include "scaled_model.h"
#include "shared_frames.h"
#include "table_rows.h"
#include "tests/support/places.h"

namespace {

using namespace myoid;
using namespace myoid::opensim_table;
namespace fs = std::filesystem;

/// J of inverse kinematics at the postures of a motion, frame by frame.
Eigen::VectorXd objective(const fs::path& setup_file, const fs::path& motion) {
  const opensim::OpensimSetup setup(setup_file);
  std::vector<Remark> remarks;
  const body::BodyModel model = opensim::setup_model(setup, body::kOpenSim452, {}, remarks);
  const MarkerSeries markers = recording::read_markers(setup.required_file(setup.tool(), "marker_file")).markers;
  const TimeSeries q = opensim::read_coordinates(model, motion, opensim::MissingCoordinate::default_value, remarks);
  const body::IkOptions ik = opensim::read_ik_tasks(setup, setup.tool(), model, markers, remarks);
  body::BodyState state = body::make_state(model);
  Eigen::VectorXd result(q.sample_count());
  for (Eigen::Index i = 0; i < q.sample_count(); ++i) {
    body::compute_poses(model, q.values().row(i).transpose(), state);
    Eigen::Index frame = 0;
    (markers.time_s.array() - q.time_s()[i]).abs().minCoeff(&frame);
    double sum = 0.0, weights = 0.0;
    for (const body::Marker& marker : model.markers) {
      const auto it = std::find(markers.names.begin(), markers.names.end(), marker.name);
      const auto weight = ik.marker_weights.find(marker.name);
      if (it == markers.names.end() || (weight == ik.marker_weights.end() && ik.only_named_markers)) continue;
      const Eigen::Index m = it - markers.names.begin();
      if (markers.missing(frame, m)) continue;
      const double w = weight == ik.marker_weights.end() ? 1.0 : weight->second;
      const Vec3 p = state.X_GB[at(marker.body)] * marker.p_BM;
      sum += w * (p - markers.position(frame, m)).squaredNorm();
      weights += w;
    }
    result[i] = weights > 0.0 ? 0.5 * sum / weights : 0.0;
    for (const body::CoordinateTask& task : ik.tasks) {
      const double off = q.column(task.coordinate)[i] - (task.values.size() > 0 ? task.values[frame] : task.value);
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

struct Options {
  fs::path folder;
  std::string only;
  bool columns = false;
};

void compare_ik(const fs::path& setup_file, const fs::path& ours_file, const fs::path& reference, const Rows& rows) {
  fs::path tight = reference / (ours_file.stem().string() + "_tight.mot");
  if (!fs::exists(tight)) tight = reference / ours_file.filename();
  if (!fs::exists(tight)) return;
  const TimeSeries ours = recording::read_storage(ours_file).data;
  const TimeSeries theirs = recording::read_storage(tight).data;
  rows.add(code(tight), compare(ours, theirs, 0, same), "deg, m");
  const Eigen::VectorXd j = objective(setup_file, ours_file), k = objective(setup_file, tight);
  if (j.size() != k.size()) return;
  Eigen::ArrayXd excess = (j - k).array() / (k.array() + 1e-12);
  const double worst = excess.maxCoeff();
  std::sort(excess.data(), excess.data() + excess.size());
  rows.add("objective, ours above theirs", fmt::format("{:.1e}", worst),
           fmt::format("median {:.1e}", excess[excess.size() / 2]));
}

void compare_moment_arms(const std::vector<fs::path>& files, const fs::path& reference, const Rows& rows) {
  if (!fs::exists(reference)) return;
  const TimeSeries theirs = recording::read_storage(reference).data;
  Worst all;
  for (const fs::path& file : files) {
    const std::string name = file.stem().string();
    const auto start = name.find("_MomentArm_");
    if (start == std::string::npos) continue;
    const std::string coordinate = name.substr(start + 11);
    const Worst worst = compare(recording::read_storage(file).data, theirs, 0,
                                [&](const std::string& muscle) { return muscle + "|" + coordinate; });
    all.any = all.any || worst.any;
    all.relative = std::max(all.relative, worst.relative);
    if (worst.error > all.error) {
      all.error = worst.error;
      all.column = worst.column + "|" + coordinate;
      all.time = worst.time;
    }
  }
  rows.add(code(reference), all, "m");
}

/// The columns of a table of outputs whose names end so.
TimeSeries ending(const TimeSeries& table, const std::string& end) {
  std::vector<std::string> names;
  for (const Channel& channel : table.channels())
    if (channel.name.ends_with(end)) names.push_back(channel.name);
  return table.select(names);
}

void compare_file(const fs::path& file, const fs::path& theirs, bool dynamics, const Rows& rows) {
  const TimeSeries ours = recording::read_storage(file).data;
  const TimeSeries reference = recording::read_storage(theirs).data;
  const std::string name = file.filename().string();
  if (name.ends_with("_Outputs.sto")) {
    rows.add(code(theirs) + " lengths", compare(ending(ours, "|length"), reference, 0, in_force_set), "m");
    rows.add(code(theirs) + " speeds", compare(ending(ours, "|lengthening_speed"), reference, 0, in_force_set), "m/s");
  } else if (name.ends_with("_OutputsVec3.sto")) {
    rows.add(code(theirs) + " places", compare(ours, reference, 0, in_force_set), "m");
  } else {
    const Eigen::Index skip = dynamics ? std::min<Eigen::Index>(10, ours.sample_count() / 4) : 0;
    rows.add(code(theirs), compare(ours, reference, skip, same), dynamics ? "N m, N" : "");
  }
}

/// A model that Scale has written beside the one that OpenSim's left, and the static pose.
void compare_scaled(const fs::path& ours, const fs::path& theirs, const Rows& rows) {
  if (!fs::exists(theirs)) return;
  if (ours.extension() == ".osim") {
    const body::OsimOptions as{.compat = body::kOpenSim452};
    for (const ModelDifference& d : compare_models(body::read_osim(ours, as), body::read_osim(theirs, as))) {
      rows.add(code(theirs) + " " + d.property, fmt::format("{:.1e} ({})", d.error, d.where),
               fmt::format("{:.1e}", d.relative));
    }
  } else if (ours.extension() == ".mot" || ours.extension() == ".sto") {
    TimeSeries pose = recording::read_storage(ours).data;
    std::vector<std::string> coordinates;
    for (const Channel& c : pose.channels())
      if (c.name.ends_with("/value")) coordinates.push_back(c.name);
    Worst worst = compare(pose.select(coordinates), recording::read_storage(theirs).data, 0, same);
    rows.add(code(theirs) + " static pose", worst, "rad, m");
  }
}

void run_setup(const fs::path& setup, const fs::path& reference, const Options& options) {
  const Rows rows{setup.stem().string(), options.columns};
  opensim::ToolResult result;
  SharedFrames shared;
  try {
    result = opensim::run_tool(setup, {.inspect = shared.keep()});
  } catch (const std::exception& error) {
    rows.add(fmt::format("FAILED: {}", error.what()), "", "");
    return;
  }
  if (result.frames_failed > 0)
    rows.add("frames that failed", fmt::format("{} of {}", result.frames_failed, result.frames), "");
  if (options.columns)
    for (const std::string& note : sentences(result.remarks)) rows.add("note: " + note, "", "");
  for (const fs::path& file : result.files) {
    const fs::path theirs = reference / file.filename();
    if (result.tool == "ScaleTool") {
      compare_scaled(file, reference.parent_path() / file.filename(), rows);
    } else if (result.tool == "InverseKinematicsTool") {
      if (file.extension() == ".mot") compare_ik(setup, file, reference, rows);
    } else if (file.extension() == ".sto" && fs::exists(theirs)) {
      compare_file(file, theirs, result.tool == "InverseDynamicsTool", rows);
      if (file.filename().string().ends_with("_activation.sto")) compare_sharing(shared, theirs, rows);
    }
  }
  if (result.tool == "AnalyzeTool" && !result.files.empty()) {
    const std::string name = result.files.front().filename().string();
    compare_moment_arms(result.files, reference / (name.substr(0, name.find('_')) + "_moment_arms.sto"), rows);
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

/// A model read, every muscle's numbers written back, and read again.
void compare_rewritten(const fs::path& file) {
  const Rows rows{file.filename().string()};
  std::ifstream in(file, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(in)), {});
  try {
    std::vector<body::OsimChange> changes;
    for (const body::Muscle& muscle : body::parse_osim(text, file).muscles) {
      const body::MuscleProperties& p = muscle.properties;
      changes.push_back({"ForceSet", muscle.name, "max_isometric_force", {p.max_isometric_force_n}});
      changes.push_back({"ForceSet", muscle.name, "optimal_fiber_length", {p.optimal_fiber_length_m}});
      changes.push_back({"ForceSet", muscle.name, "tendon_slack_length", {p.tendon_slack_length_m}});
    }
    const std::string written = body::changed_osim(text, file, changes);
    const body::BodyModel again = body::parse_osim(written, file);
    rows.add("read, written, read again", written == text ? "0 bytes differ" : "BYTES DIFFER",
             again.unsupported.empty() ? "" : fmt::format("{}", fmt::join(again.unsupported, "; ")));
  } catch (const std::exception& error) {
    rows.add(fmt::format("not read: {}", error.what()), "", "");
  }
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  options.folder = myoid::test::data_folder() / "opensim";
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
  fmt::print("| case, set-up | result | worst error | of the peak |\n| --- | --- | --- | --- |\n");
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
    fmt::print("| **{}** | | | |\n", name);
    for (const auto& entry : fs::directory_iterator(folder_of_case))
      if (entry.path().extension() == ".osim") compare_rewritten(entry.path());
    for (const fs::path& setup : setups) run_setup(setup, folder_of_case / "opensim", options);
    fs::remove_all(scratch);
  }
  return 0;
}
