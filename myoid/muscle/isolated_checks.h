#pragma once

#include <string>
#include <vector>

#include "myoid/muscle/fit_isolated.h"

namespace myoid::muscle {

/// Returns the mean absolute difference [N] between the model's force and the recording's.
[[nodiscard]] double mean_force_error(const IsolatedModel& model,
                                      const IsolatedRecording& recording,
                                      double relative_tolerance);

/// Finds forces that this muscle cannot produce: the starting F_max is correct within a factor of a
/// few, and a lengthening muscle produces less than twice F_max. Throws InvalidInput above 50
/// F_max; returns a sentence for each recording whose largest force is above 5 or below 1/50 F_max.
[[nodiscard]] std::vector<std::string> check_force_size(const std::vector<IsolatedRecording>& recordings,
                                                        double max_isometric_force_n);

/// Returns a sentence for each two recordings that were probably exchanged: with the starting
/// muscle, the errors of both together fall below half when their forces are exchanged. Two
/// recordings are compared if the lengths of each cover the times of the other's forces.
[[nodiscard]] std::vector<std::string> check_recording_order(const IsolatedModel& start,
                                                             const std::vector<IsolatedRecording>& recordings,
                                                             double relative_tolerance);

}  // namespace myoid::muscle
