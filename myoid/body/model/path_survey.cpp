#include "myoid/body/model/path_survey.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/body/model/constraints.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/random.h"

namespace myoid::body {
namespace {

/// Length and arm of one muscle along one coordinate.
class Sweep {
 public:
  Sweep(const BodyModel& model, int muscle, int coordinate)
      : model_(model),
        path_(model.muscles[static_cast<std::size_t>(muscle)].path),
        coordinate_(coordinate),
        q_(model.default_q()),
        state_(make_state(model)) {}

  struct Point {
    double q = 0.0, length_m = 0.0, arm_m = 0.0;
  };
  Point at(double value) {
    move_to(value);
    // Along the line dependent coordinates move too.
    return {value, result_.length_m, model_.couplers.empty() ? result_.moment_arm_m[coordinate_] : bound_arm_m()};
  }

  /// The same with all that the constraints bind to the coordinate, closed loops included, in the moment arm.
  Point bound_at(double value) {
    move_to(value);
    return {value, result_.length_m, bound_arm_m()};
  }

 private:
  void move_to(double value) {
    q_[coordinate_] = value;
    apply_couplers(model_, q_);
    compute_poses(model_, q_, state_);
    compute_path(model_, path_, state_, workspace_, result_);
  }

  [[nodiscard]] double bound_arm_m() const {
    return coupling_matrix(model_, state_).col(coordinate_).dot(result_.moment_arm_m);
  }

  const BodyModel& model_;
  const MusclePath& path_;
  int coordinate_;
  Eigen::VectorXd q_;
  BodyState state_;
  PathWorkspace workspace_;
  PathResult result_;
};

/// Returns the difference of the length from the integral of the arms at both ends.
double excess(const Sweep::Point& a, const Sweep::Point& b) {
  return std::abs(b.length_m - a.length_m + 0.5 * (a.arm_m + b.arm_m) * (b.q - a.q));
}

}  // namespace

bool moves(const BodyModel& model, int coordinate) {
  const Coordinate& c = model.coordinates[at(coordinate)];
  return !c.locked && !c.prescribed &&
         std::ranges::find(model.couplers, coordinate, &CoordinateCoupler::dependent) == model.couplers.end();
}

CoordinateRange usual_range(const Coordinate& c) {
  const double most = c.motion == MotionType::rotational ? 3.0 : 1.0;
  CoordinateRange r{std::max(c.lower, c.default_value - most), std::min(c.upper, c.default_value + most)};
  // A default outside of the range: the range itself counts.
  if (!(r.lower <= r.upper)) r = {c.lower, c.upper};
  return r;
}

Eigen::VectorXd random_posture(const BodyModel& model, std::uint64_t seed, std::uint64_t number) {
  math::Random random(seed, number);
  Eigen::VectorXd q = model.default_q();
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    const double share = random.uniform();
    if (!moves(model, static_cast<int>(c))) continue;
    const CoordinateRange range = usual_range(model.coordinates[c]);
    q[static_cast<Eigen::Index>(c)] = range.lower + share * (range.upper - range.lower);
  }
  apply_couplers(model, q);
  return q;
}

std::vector<PathDifference> compare_with_opensim(const BodyModel& model, int postures, std::uint64_t seed) {
  constexpr double kLeast_m = 1e-6;
  BodyModel exact = model;
  exact.compat = Compat{};
  BodyModel opensim = model;
  opensim.compat = kOpenSim452;
  std::vector<PathDifference> all(model.muscles.size());
  BodyState state = make_state(model);
  PathWorkspace workspace;
  PathResult ours, theirs;
  for (int k = 0; k < postures; ++k) {
    const Eigen::VectorXd q = random_posture(model, seed, static_cast<std::uint64_t>(k));
    compute_poses(model, q, state);
    for (std::size_t m = 0; m < all.size(); ++m) {
      const MusclePath& path = model.muscles[m].path;
      compute_path(exact, path, state, workspace, ours);
      compute_path(opensim, path, state, workspace, theirs);
      const auto finite = [](double x) { return std::isnan(x) ? std::numeric_limits<double>::infinity() : x; };
      const double length = finite(std::abs(ours.length_m - theirs.length_m));
      const double arm = theirs.moment_arm_m.allFinite()
                             ? (ours.moment_arm_m - theirs.moment_arm_m).cwiseAbs().maxCoeff()
                             : std::numeric_limits<double>::infinity();
      PathDifference& d = all[m];
      d.muscle = static_cast<int>(m);
      if (length > d.length_m || d.worst_posture.size() == 0) d.worst_posture = q;
      d.length_m = std::max(d.length_m, length);
      d.moment_arm_m = std::max(d.moment_arm_m, arm);
      d.typical_length_m += length * length / postures;
      d.postures_above_1mm += length > 1e-3 ? 1 : 0;
    }
  }
  std::erase_if(all, [&](const PathDifference& d) { return !(d.length_m > kLeast_m || d.moment_arm_m > kLeast_m); });
  for (PathDifference& d : all) d.typical_length_m = std::sqrt(d.typical_length_m);
  std::ranges::stable_sort(all, std::ranges::greater(), &PathDifference::length_m);
  return all;
}

std::vector<PathJump> find_jumps(const BodyModel& model, int steps) {
  constexpr double kLength_m = 1e-5, kArm_m = 1e-3;
  std::vector<PathJump> jumps;
  for (int m = 0; m < static_cast<int>(model.muscles.size()); ++m) {
    for (int c = 0; c < static_cast<int>(model.coordinates.size()); ++c) {
      if (!moves(model, c)) continue;
      const CoordinateRange range = usual_range(model.coordinates[at(c)]);
      if (!(range.upper > range.lower)) continue;
      Sweep sweep(model, m, c);
      const double step = (range.upper - range.lower) / steps;
      Sweep::Point before = sweep.at(range.lower);
      for (int i = 1; i <= steps; ++i) {
        const Sweep::Point here = sweep.at(range.lower + step * i);
        const bool suspicious = excess(before, here) > kLength_m || std::abs(here.arm_m - before.arm_m) > kArm_m;
        if (suspicious) {
          // Halve towards the half that departs more, until nothing smooth is left.
          Sweep::Point a = before;
          Sweep::Point b = here;
          for (int k = 0; k < 40 && b.q - a.q > 1e-10; ++k) {
            const Sweep::Point middle = sweep.at(0.5 * (a.q + b.q));
            const double left = excess(a, middle) + 1e-3 * std::abs(middle.arm_m - a.arm_m);
            const double right = excess(middle, b) + 1e-3 * std::abs(b.arm_m - middle.arm_m);
            (left > right ? b : a) = middle;
          }
          const double length = std::abs(b.length_m - a.length_m);
          const double arm = std::abs(b.arm_m - a.arm_m);
          if (length > kLength_m || arm > kArm_m) {
            jumps.push_back({m, c, 0.5 * (a.q + b.q), length > kLength_m ? length : 0.0, arm > kArm_m ? arm : 0.0});
          }
        }
        before = here;
      }
    }
  }
  return jumps;
}

PathOverRange path_over_range(
    const BodyModel& model, int muscle, int coordinate, const CoordinateRange& range, int steps) {
  Sweep sweep(model, muscle, coordinate);
  PathOverRange path;
  path.values.setLinSpaced(steps + 1, range.lower, range.upper);
  path.lengths_m.resize(steps + 1);
  path.arms_m.resize(steps + 1);
  for (Eigen::Index i = 0; i <= steps; ++i) {
    const Sweep::Point here = sweep.bound_at(path.values[i]);
    path.lengths_m[i] = here.length_m;
    path.arms_m[i] = here.arm_m;
  }
  return path;
}

Eigen::VectorXd arms_over_range_m(const BodyModel& model, int muscle, int coordinate, int steps) {
  return path_over_range(model, muscle, coordinate, usual_range(model.coordinates[at(coordinate)]), steps).arms_m;
}

Eigen::VectorXd lengths_over_range_m(const BodyModel& model, int muscle, int coordinate, int steps) {
  return path_over_range(model, muscle, coordinate, usual_range(model.coordinates[at(coordinate)]), steps).lengths_m;
}

std::string describe(const BodyModel& model, const PathJump& jump) {
  const Coordinate& c = model.coordinates[at(jump.coordinate)];
  const bool is_angle = c.motion == MotionType::rotational;
  std::string text = fmt::format("{} at {} = {:.5g} {}:", model.muscles[at(jump.muscle)].name, c.name,
                                 is_angle ? jump.at / kDegree : jump.at, is_angle ? "deg" : "m");
  if (jump.length_m > 0.0) text += fmt::format(" length jumps by {:.3g} mm", 1e3 * jump.length_m);
  if (jump.moment_arm_m > 0.0) {
    text += fmt::format("{} moment arm jumps by {:.3g} mm", jump.length_m > 0.0 ? "," : "", 1e3 * jump.moment_arm_m);
  }
  return text;
}

}  // namespace myoid::body
