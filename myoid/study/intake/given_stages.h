#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/time_series.h"

namespace myoid::study {

/// Stages of a trial as its files give them (GivenSpec), each on the clock of its file, but for the lengths and their
/// rates with all samples. Columns are muscles of the model by name; of `torques` the study's coordinates.
struct GivenStages {
  std::optional<TimeSeries> lengths;     ///< [m]; the samples of the trial are at these times.
  std::optional<TimeSeries> velocities;  ///< [m/s]; present with `lengths`.
  std::vector<TimeSeries> moment_arms;   ///< [m], in the order of the study's coordinates; empty: not given.
  std::optional<TimeSeries> torques;     ///< [N m]
  /// Columns of the file of torques: those of `torques` first, then the others.
  std::vector<std::string> torque_columns;
  std::optional<TimeSeries> forces;  ///< [N]
};

/// Returns the values of a series at these times: its own values where its clock has them one after the other, else
/// resampled.
[[nodiscard]] Eigen::MatrixXd values_at(const TimeSeries& series, const Eigen::VectorXd& time_s);

}  // namespace myoid::study
