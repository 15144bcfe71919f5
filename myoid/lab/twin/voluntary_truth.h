#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/ground/core/units.h"
#include "myoid/lab/twin/synthetic_recording.h"
#include "myoid/muscle/hill_parameters.h"

namespace myoid::lab {

/// A true greatest voluntary torque, its angle, or a power, named as the run's estimate of it.
struct VoluntaryTruth {
  std::string owner;  ///< Muscle, or elbow_flexion.
  std::string parameter;
  Unit unit = Unit::newton_meter;
  double value = 0.0;
};

/// Returns the true greatest voluntary torques of the person over these angles [rad], empty: those that the trials
/// reach. The muscle has the activation that its maximal contraction reached (Truth::effort), fresh, and its tendon is
/// in equilibrium; at L2 the torque is that which the excitation adds. The joint's torque is the sum over its flexors
/// (positive) or extensors (negative).
[[nodiscard]] std::vector<VoluntaryTruth> voluntary_truth(const VirtualRecording& recording,
                                                          const std::optional<muscle::Range>& range_rad = {});

}  // namespace myoid::lab
