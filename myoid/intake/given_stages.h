#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/time_series.h"

namespace myoid {

/// Stages of a trial as its files give them (GivenSpec), each on the clock of its file. Columns are muscles of the
/// model by name; of `torques` the study's coordinates.
struct GivenStages {
  std::optional<TimeSeries> lengths;     ///< [m]; the samples of the trial are at these times.
  std::optional<TimeSeries> velocities;  ///< [m/s]; present with `lengths`.
  std::vector<TimeSeries> moment_arms;   ///< [m], in the order of the study's coordinates; empty: not given.
  std::optional<TimeSeries> torques;     ///< [N m]
  std::optional<TimeSeries> forces;      ///< [N]
};

/// Returns the values of a series at these times: its own values where its clock is the same, else resampled.
[[nodiscard]] Eigen::MatrixXd values_at(const TimeSeries& series, const Eigen::VectorXd& time_s);

}  // namespace myoid
