#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

namespace myoid::recording {

/// Lines of the mains in one channel.
struct Hum {
  double mains_hz = 50.0;        ///< 50 or 60.
  std::vector<double> lines_hz;  ///< The mains frequency and its harmonics, as far as they stand out.
  double share = 0.0;            ///< Share of the power between 20 Hz and 0.45 of the rate.
};

/// Looks for 50 or 60 Hz and its harmonics, whichever holds more power. A line stands out where the spectrum (Welch, 2
/// s) within 0.5 Hz of it is more than eight times the median of its neighbors 2 to 6 Hz away; the excess is its power.
/// Muscles make no such line. Empty if there is none, or if the signal is shorter than 2 s.
[[nodiscard]] std::optional<Hum> find_hum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz);

/// Removes the lines by second-order notches of 4 Hz (-3 dB of one pass), forwards and backwards, without delay. Beyond
/// the ends the lines continue as sines and the rest is mirrored. Throws as `math::zero_phase`.
[[nodiscard]] Eigen::VectorXd without_hum(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz, const Hum& hum);

}  // namespace myoid::recording
