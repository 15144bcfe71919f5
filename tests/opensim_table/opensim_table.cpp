// Compares body kinematics and muscle paths with what OpenSim 4.5.2 computed, for every case of the
// shared data set that has such results, and prints the worst error of each quantity:
//
//   opensim_table [--worst N] [FOLDER]
//
// FOLDER holds one folder per case (model.osim, opensim/*_Kinematics_q.sto, *_Outputs.sto,
// *_OutputsVec3.sto, *_moment_arms.sto). --worst lists the N worst columns of each table.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "myoid/kinematics/joint_motion.h"
#include "myoid/model/constraints.h"
#include "myoid/model/muscle_path.h"
#include "myoid/model/osim_reader.h"
#include "myoid/recording/storage_reader.h"

namespace {

using namespace myoid;

/// Errors of one kind: the greatest, and by column.
struct Errors {
  double worst = 0.0;
  long count = 0;
  long above = 0;  ///< Samples above the tolerance.
  double tolerance = 0.0;
  std::map<std::string, std::pair<double, double>> by_column;  ///< Error and time.

  void add(const std::string& column, double time, double ours, double theirs) {
    if (std::isnan(theirs) && std::isnan(ours)) return;
    double error = std::abs(ours - theirs);
    if (std::isnan(error)) error = INFINITY;
    ++count;
    if (error > tolerance) ++above;
    worst = std::max(worst, error);
    auto& entry = by_column[column];
    if (error >= entry.first) entry = {error, time};
  }
  [[nodiscard]] std::string text() const {
    if (count == 0) return "-";
    return above == 0 ? fmt::format("{:.1e}", worst)
                      : fmt::format("{:.1e} ({} of {})", worst, above, count);
  }
};

void print_worst(const char* title, const Errors& errors, int count) {
  std::vector<std::pair<double, std::string>> sorted;
  for (const auto& [column, entry] : errors.by_column)
    sorted.push_back({entry.first, fmt::format("{} at {}", column, entry.second)});
  std::sort(sorted.rbegin(), sorted.rend());
  for (int i = 0; i < count && i < static_cast<int>(sorted.size()); ++i) {
    if (sorted[static_cast<std::size_t>(i)].first > errors.tolerance)
      fmt::print("      {} {}: {:.3g}\n", title, sorted[static_cast<std::size_t>(i)].second,
                 sorted[static_cast<std::size_t>(i)].first);
  }
}

/// `muscle|coordinate`, `/forceset/muscle/path|length` and the like, at the last bar.
std::pair<std::string, std::string> split_at_bar(const std::string& name) {
  const std::size_t bar = name.find_last_of('|');
  std::string owner = name.substr(0, bar);
  if (owner.starts_with("/forceset/")) owner = owner.substr(10, owner.find('/', 10) - 10);
  return {owner, bar == std::string::npos ? "" : name.substr(bar + 1)};
}

/// Columns that are zero throughout are left out of the tables of moment arms.
struct Column {
  Eigen::Index index = 0;
  int muscle = -1;
  int coordinate = -1;
  bool speed = false;
  std::string name;
};

int run_case(const std::filesystem::path& folder,
             const std::string& motion,
             int worst,
             bool& good) {
  const auto file = [&](const char* suffix) { return folder / "opensim" / (motion + suffix); };
  if (!std::filesystem::exists(file("_Kinematics_q.sto"))) return 0;
  const model::BodyModel m =
      model::read_osim(folder / "model.osim", {.compat = model::kOpenSim452});
  const TimeSeries q = recording::to_si(
      recording::read_storage(file("_Kinematics_q.sto")), [&](const std::string& name) {
        const auto c = m.find_coordinate(name);
        return c &&
               m.coordinates[static_cast<std::size_t>(*c)].motion == model::MotionType::rotational;
      });
  const kinematics::JointMotion motion_q = kinematics::joint_motion(m, q).motion;
  const bool assembled = !m.couplers.empty() || !m.constraints.empty();
  Errors markers{.tolerance = assembled ? 1e-6 : 1e-8};
  Errors lengths{.tolerance = assembled ? 1e-6 : 1e-8};
  Errors speeds{.tolerance = 1e-7};
  Errors arms{.tolerance = 1e-7};

  std::optional<recording::Storage> vectors, outputs, moments;
  if (std::filesystem::exists(file("_OutputsVec3.sto")))
    vectors = recording::read_storage(file("_OutputsVec3.sto"));
  if (std::filesystem::exists(file("_Outputs.sto")))
    outputs = recording::read_storage(file("_Outputs.sto"));
  if (std::filesystem::exists(file("_moment_arms.sto")))
    moments = recording::read_storage(file("_moment_arms.sto"));
  std::vector<Column> output_columns, moment_columns;
  const auto collect = [&](const std::optional<recording::Storage>& table, bool of_moments,
                           std::vector<Column>& columns) {
    if (!table) return;
    for (Eigen::Index c = 0; c < table->data.channel_count(); ++c) {
      Column column;
      column.index = c;
      column.name = table->data.channels()[static_cast<std::size_t>(c)].name;
      const auto [owner, what] = split_at_bar(column.name);
      const auto muscle = m.find_muscle(owner);
      if (!muscle) continue;
      column.muscle = *muscle;
      column.speed = what == "lengthening_speed";
      if (of_moments) {
        const auto coordinate = m.find_coordinate(what);
        if (!coordinate) continue;
        column.coordinate = *coordinate;
      }
      columns.push_back(column);
    }
  };
  collect(outputs, false, output_columns);
  collect(moments, true, moment_columns);

  model::BodyState state = model::make_state(m);
  model::PathWorkspace workspace;
  std::vector<model::PathResult> paths(m.muscles.size());
  for (Eigen::Index row = 0; row < q.sample_count(); ++row) {
    const double time = q.time_s()[row];
    model::compute_poses(m, motion_q.q.values().row(row).transpose(), state);
    model::compute_velocities(m, motion_q.qdot.values().row(row).transpose(), state);
    if (vectors) {
      for (const model::Marker& marker : m.markers) {
        const Vec3 p = state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM;
        for (int k = 0; k < 3; ++k) {
          const std::string name = fmt::format("/markerset/{}|location_{}", marker.name, k + 1);
          if (const auto column = vectors->data.find(name))
            markers.add(name, time, p[k], vectors->data.values()(row, *column));
        }
      }
    }
    if (output_columns.empty() && moment_columns.empty()) continue;
    const Eigen::MatrixXd C = model::coupling_matrix(m, state);
    for (std::size_t i = 0; i < m.muscles.size(); ++i)
      model::compute_path(m, m.muscles[i].path, state, workspace, paths[i]);
    for (const Column& column : output_columns) {
      const model::PathResult& path = paths[static_cast<std::size_t>(column.muscle)];
      // At random postures the rates mean nothing.
      if (column.speed && motion == "random") continue;
      (column.speed ? speeds : lengths)
          .add(column.name, time, column.speed ? path.speed_mps : path.length_m,
               outputs->data.values()(row, column.index));
    }
    for (const Column& column : moment_columns) {
      const model::PathResult& path = paths[static_cast<std::size_t>(column.muscle)];
      arms.add(column.name, time, C.col(column.coordinate).dot(path.moment_arm_m),
               moments->data.values()(row, column.index));
    }
  }
  fmt::print("{:<18} {:<7} {:>5}  {:>18}  {:>18}  {:>18}  {:>18}\n", folder.filename().string(),
             motion, q.sample_count(), markers.text(), lengths.text(), speeds.text(), arms.text());
  for (const std::string& text : m.unsupported) fmt::print("      not supported: {}\n", text);
  print_worst("marker", markers, worst);
  print_worst("length", lengths, worst);
  print_worst("speed", speeds, worst);
  print_worst("moment arm", arms, worst);
  good = good && markers.above + lengths.above + speeds.above + arms.above == 0;
  return 1;
}

}  // namespace

int main(int argc, char** argv) {
  std::filesystem::path folder = std::filesystem::path(MYOID_SOURCE_DIR) / ".." / "shared" / "data";
  if (const char* data = std::getenv("MYOID_DATA")) folder = data;
  folder /= "opensim";
  int worst = 0;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--worst" && i + 1 < argc) {
      worst = std::atoi(argv[++i]);
    } else {
      folder = argument;
    }
  }
  if (!std::filesystem::exists(folder)) {
    fmt::print(stderr, "there is no folder {}; set MYOID_DATA\n", folder.string());
    return 3;
  }
  std::vector<std::filesystem::path> cases;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (std::filesystem::exists(entry.path() / "model.osim")) cases.push_back(entry.path());
  }
  std::sort(cases.begin(), cases.end());
  fmt::print("Worst differences from OpenSim 4.5.2 (in brackets: samples above the tolerance)\n");
  fmt::print("{:<18} {:<7} {:>5}  {:>18}  {:>18}  {:>18}  {:>18}\n", "case", "motion", "rows",
             "markers [m]", "lengths [m]", "speeds [m/s]", "moment arms [m]");
  bool good = true;
  int count = 0;
  for (const auto& path : cases) {
    for (const char* motion : {"smooth", "random"}) {
      try {
        count += run_case(path, motion, worst, good);
      } catch (const std::exception& error) {
        fmt::print("{:<18} {:<7} failed: {}\n", path.filename().string(), motion, error.what());
        good = false;
      }
    }
  }
  fmt::print("{} tables, {}\n", count, good ? "all within tolerance" : "some above tolerance");
  return good && count > 0 ? 0 : 1;
}
