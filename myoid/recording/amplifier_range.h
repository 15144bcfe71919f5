#pragma once

#include <Eigen/Core>

namespace myoid::recording {

inline constexpr double kMostVolts = 10.0;    ///< Converters take +-10 V.
inline constexpr double kShareBeyond = 0.01;  ///< Share of samples that is no artifact.

/// Returns true if more than 1 % of the finite samples [V] lie beyond 10 V: no amplifier gives that, whatever its gain,
/// and the numbers are in another unit.
[[nodiscard]] inline bool is_beyond_amplifiers(const Eigen::Ref<const Eigen::VectorXd>& x_v) {
  const Eigen::Index finite = x_v.array().isFinite().count();
  const Eigen::Index beyond = (x_v.array().isFinite() && x_v.array().abs() > kMostVolts).count();
  return static_cast<double>(beyond) > kShareBeyond * static_cast<double>(finite);
}

}  // namespace myoid::recording
