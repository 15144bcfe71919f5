#pragma once

#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/progress.h"

namespace myoid::body {

/// A desired value of a coordinate. The task adds W (q - q*)^2 / 2 to the objective.
struct CoordinateTask {
  std::string coordinate;
  double value = 0.0;        ///< q* [rad or m]
  double weight = 1.0;       ///< W
  Eigen::VectorXd values{};  ///< q* frame by frame; empty: `value` in all.
};

struct IkOptions {
  std::map<std::string, double> marker_weights{};  ///< By name; other markers have weight 1.
  std::vector<CoordinateTask> tasks{};
  /// True: markers without an entry in `marker_weights` do not count, as with OpenSim's marker tasks.
  bool only_named_markers = false;
  /// Above 0: a barrier of this weight, added to J (range_barrier.h) [m^2], keeps clamped coordinates inside their
  /// ranges. A coordinate that no marker determines goes to the middle of its range.
  double range_barrier = 0.0;
  int max_iterations = 200;
  Progress progress{};
};

}  // namespace myoid::body
