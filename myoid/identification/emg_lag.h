#pragma once

#include <string_view>

namespace myoid::identification {

/// The law by which a muscle follows its EMG.
enum class EmgLag {
  /// A pure delay d: a(t) = env(t - d).
  delay,
  /// The same d, most of it the two lags of equation (1) (excitation, activation), which weaken
  /// what changes fast: for d = 80 ms by a twentieth at 1 Hz, by a third at 3 Hz. In the
  /// proportions of `LagShares`.
  shared,
  /// A pure delay d, and beside it the two lags with time constants of their own.
  equation_1,
};

/// "delay", "shared", "equation_1"
[[nodiscard]] constexpr std::string_view name(EmgLag lag) {
  return lag == EmgLag::delay ? "delay" : lag == EmgLag::shared ? "shared" : "equation_1";
}

/// The parts of a shared delay: a pure delay of 10 ms and the time constants of excitation, 40 ms,
/// activation, 15 ms, and deactivation, 50 ms (Winters 1990; Thelen 2003), divided by their sum of
/// 82.5 ms, in which the last two count as their mean, since activity rises as often as it falls:
/// the mean lag is d.
struct LagShares {
  double pure = 10.0 / 82.5;
  double excitation = 40.0 / 82.5;
  double activation = 15.0 / 82.5;
  double deactivation = 50.0 / 82.5;
};

}  // namespace myoid::identification
