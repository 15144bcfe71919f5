// Exact paths of every public model, summarized in docs/data/exact-paths.txt, a row per model:
//
//   exact_paths [--postures N] [--worst N] [MODEL.osim...]
//
// (10 minutes of one processor for all public models; a line a muscle with --worst.)
//
// At N random postures (10 000): minus the derivative of the length along a random direction of all coordinates, by
// differences, against the moment arms; and the lengthening speed of a motion in that direction against the moment arms
// times its rates, so that the power of the muscles' forces is that of their torques. "kinks" are samples where contact
// begins or ends within the difference (the derivative of one side is met), "unsettled" where several wrap objects push
// the path off each other (PathResult::settled), "jumps" where the length itself is another one on both sides; none of
// them is in "worst". Along N / 50 straight lines between random postures: places where the length jumps by more than a
// micrometer, narrowed down to 1e-9 of the line. Without models: all
// of MYOID_DATA/opensim (../shared/data/opensim).
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "myoid/body/model/muscle_path.h"
#include "myoid/body/model/path_survey.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/math/random.h"

#include "tests/support/places.h"

namespace {

using namespace myoid;

struct Row {
  long samples = 0, kinks = 0, unsettled = 0, jumps = 0;
  double worst_m = 0.0, power = 0.0, greatest_jump_m = 0.0;
  long lines = 0, jumps_on_lines = 0;
  std::map<std::string, long> line_jumps_of;
  std::map<std::string, long> unsettled_of, jumps_of;
  std::map<std::string, double> worst_of;
};

/// Lengths along the line q + s d at s = -2h, -h, 0, h, 2h.
struct Line {
  double length_m[5];
  bool settled = true;
  double arm_m = 0.0;  ///< r . d at s = 0.
};

/// The moment arm against the difference quotient of fourth order.
double error_of(const Line& line, double h) {
  const double* l = line.length_m;
  const double narrow = (l[3] - l[1]) / (2.0 * h);
  const double wide = (l[4] - l[0]) / (4.0 * h);
  return std::abs(line.arm_m + (4.0 * narrow - wide) / 3.0);
}

/// `again(h)` is the same line with another step: beside the begin of a contact, where the length
/// is a root of the distance, the quotient's own error shrinks with the step.
void judge(const std::string& muscle, const Line& line, double h, const auto& again, Row& row) {
  ++row.samples;
  if (!line.settled) {
    ++row.unsettled;
    ++row.unsettled_of[muscle];
    return;
  }
  const double* l = line.length_m;
  double error = error_of(line, h);
  if (error > 1e-6) {
    const double ahead = (-3.0 * l[2] + 4.0 * l[3] - l[4]) / (2.0 * h);
    const double behind = (3.0 * l[2] - 4.0 * l[1] + l[0]) / (2.0 * h);
    const double one_sided = std::min(std::abs(line.arm_m + ahead), std::abs(line.arm_m + behind));
    if (one_sided < 1e-5) {
      ++row.kinks;
      return;
    }
    double step = 0.0;
    for (int i = 0; i < 4; ++i) step = std::max(step, std::abs(l[i + 1] - l[i] + h * line.arm_m));
    if (step > 1e-7) {
      ++row.jumps;
      ++row.jumps_of[muscle];
      return;
    }
    for (const double finer : {0.1 * h, 0.03 * h}) error = std::min(error, error_of(again(finer), finer));
  }
  row.worst_m = std::max(row.worst_m, error);
  double& worst = row.worst_of[muscle];
  worst = std::max(worst, error);
}

Row survey(const body::BodyModel& m, int postures) {
  const double h = 1e-6;
  Row row;
  body::BodyState state = body::make_state(m);
  body::PathWorkspace workspace;
  body::PathResult path;
  std::vector<Line> lines(m.muscles.size());
  const auto nq = static_cast<Eigen::Index>(m.coordinates.size());
  for (int k = 0; k < postures; ++k) {
    const Eigen::VectorXd q = body::random_posture(m, 7, static_cast<std::uint64_t>(k));
    math::Random random(8, static_cast<std::uint64_t>(k));
    Eigen::VectorXd d(nq);
    for (double& x : d) x = 2.0 * random.uniform() - 1.0;
    d.normalize();
    for (int s = -2; s <= 2; ++s) {
      body::compute_poses(m, q + s * h * d, state);
      body::compute_velocities(m, d, state);
      for (std::size_t i = 0; i < lines.size(); ++i) {
        body::compute_path(m, m.muscles[i].path, state, workspace, path);
        lines[i].length_m[s + 2] = path.length_m;
        lines[i].settled = path.settled && (s == -2 || lines[i].settled);
        if (s == 0) {
          lines[i].arm_m = path.moment_arm_m.dot(d);
          row.power = std::max(row.power, std::abs(path.speed_mps + lines[i].arm_m));
        }
      }
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto again = [&](double step) {
        Line line{.arm_m = lines[i].arm_m};
        for (int s = -2; s <= 2; ++s) {
          body::compute_poses(m, q + s * step * d, state);
          body::compute_path(m, m.muscles[i].path, state, workspace, path);
          line.length_m[s + 2] = path.length_m;
        }
        return line;
      };
      judge(m.muscles[i].name, lines[i], h, again, row);
    }
  }
  return row;
}

/// A muscle at a place of a line: its length, and the moment arm along it.
struct OnLine {
  double length_m = 0.0, arm_m = 0.0;
  bool settled = true;
};

/// Straight lines between random postures: does any length step where its moment arms do not say
/// so? A suspect step is halved, the worse half followed, until it is 1e-9 of the line.
void follow_lines(const body::BodyModel& m, int count, Row& row) {
  constexpr int kSteps = 100;
  body::BodyState state = body::make_state(m);
  body::PathWorkspace workspace;
  body::PathResult path;
  for (int k = 0; k < count; ++k) {
    const Eigen::VectorXd from = body::random_posture(m, 9, static_cast<std::uint64_t>(k));
    const Eigen::VectorXd along = body::random_posture(m, 10, static_cast<std::uint64_t>(k)) - from;
    const auto at = [&](std::size_t muscle) {
      body::compute_path(m, m.muscles[muscle].path, state, workspace, path);
      return OnLine{path.length_m, path.moment_arm_m.dot(along), path.settled};
    };
    const auto defect = [](const OnLine& a, const OnLine& b, double step) {
      return std::abs(b.length_m - a.length_m + 0.5 * step * (a.arm_m + b.arm_m));
    };
    std::vector<OnLine> before(m.muscles.size());
    for (int i = 0; i <= kSteps; ++i) {
      for (std::size_t muscle = 0; muscle < m.muscles.size(); ++muscle) {
        double low = (i - 1.0) / kSteps, high = static_cast<double>(i) / kSteps;
        body::compute_poses(m, from + high * along, state);
        const OnLine now = at(muscle);
        OnLine a = before[muscle], b = now;
        before[muscle] = now;
        if (i == 0 || defect(a, b, high - low) < 1e-5) continue;
        while (high - low > 1e-9) {
          const double middle = 0.5 * (low + high);
          body::compute_poses(m, from + middle * along, state);
          const OnLine c = at(muscle);
          if (defect(a, c, middle - low) > defect(c, b, high - middle)) {
            b = c;
            high = middle;
          } else {
            a = c;
            low = middle;
          }
        }
        const double jump = defect(a, b, high - low);
        if (jump < 1e-6 || !a.settled || !b.settled) continue;
        ++row.jumps_on_lines;
        ++row.line_jumps_of[m.muscles[muscle].name];
        row.greatest_jump_m = std::max(row.greatest_jump_m, jump);
      }
    }
  }
  row.lines = static_cast<long>(count) * static_cast<long>(m.muscles.size());
}

template <typename Value>
void print_greatest(const char* what, const std::map<std::string, Value>& by_muscle, int count) {
  std::vector<std::pair<Value, std::string>> sorted;
  for (const auto& [muscle, value] : by_muscle) sorted.push_back({value, muscle});
  std::sort(sorted.rbegin(), sorted.rend());
  for (std::size_t i = 0; i < sorted.size() && i < static_cast<std::size_t>(count); ++i)
    fmt::print("| {} {}: {:.4g} | | | | | | | | |\n", what, sorted[i].second, static_cast<double>(sorted[i].first));
}

}  // namespace

int main(int argc, char** argv) {
  int postures = 10000;
  int worst = 0;
  std::vector<std::filesystem::path> files;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument == "--postures" && i + 1 < argc) {
      postures = std::atoi(argv[++i]);
    } else if (argument == "--worst" && i + 1 < argc) {
      worst = std::atoi(argv[++i]);
    } else {
      files.emplace_back(argument);
    }
  }
  if (files.empty()) {
    const std::filesystem::path folder = myoid::test::data_folder() / "opensim";
    if (std::filesystem::exists(folder)) {
      for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".osim") files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
  }
  if (files.empty()) {
    fmt::print(stderr, "exact_paths [--postures N] [--worst N] [MODEL.osim...]\n");
    return 2;
  }
  fmt::print(
      "| model | samples | worst [m] | power | kinks | unsettled | jumps | lines | jumps on them "
      "|\n| --- | --- | --- | --- | --- | --- | --- | --- | --- |\n");
  for (const auto& file : files) {
    const std::string name = (file.parent_path().filename() / file.filename()).string();
    try {
      const body::BodyModel m = body::read_osim(file);
      Row row = survey(m, postures);
      follow_lines(m, postures / 50, row);
      fmt::print(
          "| {} | {} | {:.1e} | {:.0e} | {} | {} | {} | {} | {} |\n", name, row.samples, row.worst_m, row.power,
          row.kinks, row.unsettled, row.jumps, row.lines,
          row.jumps_on_lines == 0 ? "0" : fmt::format("{}, up to {:.1e} m", row.jumps_on_lines, row.greatest_jump_m));
      print_greatest("unsettled", row.unsettled_of, worst);
      print_greatest("jumps", row.jumps_of, worst);
      print_greatest("jumps on lines", row.line_jumps_of, worst);
      if (row.worst_m > 1e-6) print_greatest("worst", row.worst_of, worst);
      std::fflush(stdout);
    } catch (const std::exception& error) {
      fmt::print("| {} | not read: {} | | | | | | | |\n", name, error.what());
    }
  }
  return 0;
}
