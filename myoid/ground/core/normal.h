#pragma once

namespace myoid::inline ground {

/// The 97.5 % quantile of the standard normal distribution: a 95 % interval is mean -+ kNormal95 sd.
inline constexpr double kNormal95 = 1.959963984540054;

/// Standard deviation over mean of rectified normal noise, sqrt(pi/2 - 1): the spread of rectified
/// EMG about its envelope.
inline constexpr double kRectifiedSpread = 0.7555;

}  // namespace myoid::inline ground
