#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/model/body_model.h"

namespace myoid::model {

struct CoordinateRange {
  double lower = 0.0, upper = 0.0;
};
/// The coordinate's range, at most +-3 rad or +-1 m about its default value.
[[nodiscard]] CoordinateRange usual_range(const Coordinate& coordinate);

/// A posture with every coordinate that is free drawn evenly from its range (at most +-3 rad or
/// +-1 m about the default value); locked ones at their default, dependent ones as their couplers
/// say. The same for the same seed and number.
[[nodiscard]] Eigen::VectorXd random_posture(const BodyModel& model,
                                             std::uint64_t seed,
                                             std::uint64_t number);

/// One muscle computed exactly and as OpenSim 4.5.2 computes it, over random postures.
struct PathDifference {
  int muscle = -1;
  double length_m = 0.0;          ///< Greatest difference of lengths.
  double moment_arm_m = 0.0;      ///< Greatest difference of moment arms, by any coordinate.
  double typical_length_m = 0.0;  ///< Root mean square of the length's difference.
  int postures_above_1mm = 0;     ///< Where the length differs by more than 1 mm.
  Eigen::VectorXd worst_posture;  ///< Of the greatest length difference.
};

/// Muscles that differ by more than `least_m` in length or moment arm anywhere, the greatest length
/// difference first. A result of OpenSim that is not a number, or an arm of a coordinate in meters,
/// counts like any other (infinite where it is not a number).
[[nodiscard]] std::vector<PathDifference> compare_with_opensim(const BodyModel& model,
                                                               int postures,
                                                               std::uint64_t seed = 1,
                                                               double least_m = 1e-6);

/// Where a muscle's length or moment arm jumps while one coordinate moves through its range.
struct PathJump {
  int muscle = -1;
  int coordinate = -1;
  double at = 0.0;            ///< Value of the coordinate [rad] or [m].
  double length_m = 0.0;      ///< Step of the length there; 0 if only the moment arm jumps.
  double moment_arm_m = 0.0;  ///< Step of the moment arm by this coordinate.
};

/// Sweeps every free coordinate through its range in `steps` steps, the others at their default,
/// and narrows down where the path changes by more than its moment arms say: steps of more than
/// `length_tolerance_m` or `arm_tolerance_m`, in the mode of `model.compat`.
[[nodiscard]] std::vector<PathJump> find_jumps(const BodyModel& model,
                                               int steps = 200,
                                               double length_tolerance_m = 1e-5,
                                               double arm_tolerance_m = 1e-3);

/// The jump as a sentence for a person: muscle, coordinate and where, by how much.
[[nodiscard]] std::string describe(const BodyModel& model, const PathJump& jump);

}  // namespace myoid::model
