#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/body_model.h"

namespace myoid::body {

struct CoordinateRange {
  double lower = 0.0, upper = 0.0;
};
/// Returns the coordinate's range, at most +-3 rad or +-1 m about its default value.
[[nodiscard]] CoordinateRange usual_range(const Coordinate& coordinate);

/// Returns a posture with every free coordinate drawn uniformly from its range (at most +-3 rad or
/// +-1 m about the default value). Locked coordinates have their default; couplers give the
/// dependent ones. Equal seed and number give an equal posture.
[[nodiscard]] Eigen::VectorXd random_posture(const BodyModel& model, std::uint64_t seed, std::uint64_t number);

/// Differences of one muscle between exact paths and those of OpenSim 4.5.2, over random postures.
struct PathDifference {
  int muscle = -1;
  double length_m = 0.0;          ///< Greatest difference of lengths.
  double moment_arm_m = 0.0;      ///< Greatest difference of moment arms, by any coordinate.
  double typical_length_m = 0.0;  ///< Root mean square of the length's difference.
  int postures_above_1mm = 0;     ///< Number of postures whose lengths differ by more than 1 mm.
  Eigen::VectorXd worst_posture;  ///< Posture of the greatest length difference.
};

/// Returns the muscles that differ by more than 1 um in length or moment arm at some posture, the greatest length
/// difference first. A moment arm of a coordinate in meters counts as well; a NaN of OpenSim counts as infinite.
[[nodiscard]] std::vector<PathDifference> compare_with_opensim(const BodyModel& model,
                                                               int postures,
                                                               std::uint64_t seed = 1);

/// A jump of a muscle's length or moment arm while one coordinate moves through its range.
struct PathJump {
  int muscle = -1;
  int coordinate = -1;
  double at = 0.0;            ///< Value of the coordinate [rad] or [m].
  double length_m = 0.0;      ///< Step of the length there; 0 if only the moment arm jumps.
  double moment_arm_m = 0.0;  ///< Step of the moment arm by this coordinate.
};

/// Sweeps every free coordinate through its range in `steps` steps, the others at their default.
/// Finds the places at which the path changes by more than its moment arms predict: steps of more
/// than 0.01 mm or, of the moment arm, 1 mm, in the mode of `model.compat`.
[[nodiscard]] std::vector<PathJump> find_jumps(const BodyModel& model, int steps = 200);

/// A muscle's path while one coordinate moves.
struct PathOverRange {
  Eigen::VectorXd values;     ///< Of the coordinate [rad] or [m], evenly from end to end.
  Eigen::VectorXd lengths_m;  ///< Musculotendon lengths there.
  Eigen::VectorXd arms_m;     ///< Moment arms by the coordinate there.
};

/// Returns the muscle's path at steps + 1 places of a range. Other coordinates have their default values; those that
/// couplers or constraints bind to it move along, as in OpenSim (coupling_matrix in constraints.h).
[[nodiscard]] PathOverRange path_over_range(
    const BodyModel& model, int muscle, int coordinate, const CoordinateRange& range, int steps);

/// The same over the coordinate's usual range: moment arms.
[[nodiscard]] Eigen::VectorXd arms_over_range_m(const BodyModel& model, int muscle, int coordinate, int steps);

/// Lengths at the places of `arms_over_range_m`.
[[nodiscard]] Eigen::VectorXd lengths_over_range_m(const BodyModel& model, int muscle, int coordinate, int steps);

/// Returns true if the coordinate can be moved: it is neither locked nor prescribed, and no coupler decides on it.
[[nodiscard]] bool moves(const BodyModel& model, int coordinate);

/// Describes the jump in a sentence: muscle, coordinate, place and size.
[[nodiscard]] std::string describe(const BodyModel& model, const PathJump& jump);

}  // namespace myoid::body
