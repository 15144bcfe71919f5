#pragma once

#include <string_view>

namespace myoid::identification {

/// The law by which a muscle's activation follows its EMG.
enum class EmgLag {
  /// A pure delay d: a(t) = env(t - d).
  delay,
  /// A delay d of which the two lags of equation (1) (excitation, activation) are the larger part, in the proportions
  /// of `LagShares`. The lags weaken fast changes: for d = 80 ms by a twentieth at 1 Hz, by a third at 3 Hz.
  shared,
  /// A pure delay d, and in addition the two lags with their own time constants.
  equation_1,
};

/// Returns the name: "delay", "shared", "equation_1".
[[nodiscard]] constexpr std::string_view name(EmgLag lag) {
  return lag == EmgLag::delay ? "delay" : lag == EmgLag::shared ? "shared" : "equation_1";
}

/// The parts of a shared delay d: a pure delay of 10 ms and the time constants of excitation, 40
/// ms, activation, 15 ms, and deactivation, 50 ms (Winters 1990; Thelen 2003), over their sum of
/// 82.5 ms. The last two count as their mean, because activity rises as often as it falls; so the mean lag is d.
struct LagShares {
  double pure = 10.0 / 82.5;
  double excitation = 40.0 / 82.5;
  double activation = 15.0 / 82.5;
  double deactivation = 50.0 / 82.5;
};

}  // namespace myoid::identification
