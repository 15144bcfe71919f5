#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/remark.h"

namespace myoid::recording {

/// A few samples of raw EMG that no muscle makes: a knock on the plug, a lost packet.
struct EmgSpike {
  Eigen::Index begin = 0;   ///< First sample.
  Eigen::Index length = 1;  ///< Number of samples.
  Eigen::Index peak = 0;    ///< The farthest sample,
  double height = 0.0;      ///< and its distance from the median around it, in the unit of the signal.
};

/// Finds isolated spikes in order of time. A spike is narrower than `spike_s` at half its height, and `spike_over_emg`
/// times as high as the 98th percentile of the quarter second that it lies in and of the two beside it (distances from
/// the median of its own quarter second). The potential of a motor unit is wider, because skin and amplifier hold back
/// what is above 500 Hz; also a single one fills more than 2 % of a quarter second. What rises beyond half of that
/// limit within `spike_s` beside the spike belongs to it.
[[nodiscard]] std::vector<EmgSpike> find_spikes(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz);

/// Returns the warning of a channel's spikes (at least one) in volts: the highest one, its time, their number.
[[nodiscard]] Remark spike_remark(const std::string& channel,
                                  const Eigen::VectorXd& time_s,
                                  const std::vector<EmgSpike>& spikes);

/// Returns the signal with straight lines in the place of the spikes.
[[nodiscard]] Eigen::VectorXd without_spikes(const Eigen::Ref<const Eigen::VectorXd>& x,
                                             const std::vector<EmgSpike>& spikes);

}  // namespace myoid::recording
