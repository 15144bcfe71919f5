#pragma once

#include <memory>
#include <vector>

namespace myoid::lab {

/// A quantity and its first two time derivatives.
struct Moment {
  double value = 0.0;
  double first = 0.0;
  double second = 0.0;
};

[[nodiscard]] Moment operator+(const Moment& a, const Moment& b);
[[nodiscard]] Moment operator-(const Moment& a, const Moment& b);
[[nodiscard]] Moment operator*(const Moment& a, const Moment& b);
[[nodiscard]] Moment operator*(double a, const Moment& b);
[[nodiscard]] Moment cosine(const Moment& x);

/// Returns a step from 0 to 1 that starts at `start_s` and takes `duration_s`: x^6 (462 - 1980 x + 3465 x^2 - 3080 x^3
/// + 1386 x^4 - 252 x^5), whose first five derivatives vanish at both ends. 0 before, 1 after.
[[nodiscard]] Moment smooth_step(double time_s, double start_s, double duration_s);

/// Returns the integral of the step over time [s].
[[nodiscard]] Moment smooth_ramp(double time_s, double start_s, double duration_s);

/// A move from one angle to another.
struct Move {
  double start_s = 0.0;
  double duration_s = 1.0;
  double by_rad = 0.0;
};

/// A turn at a constant speed, with a smooth start and stop of `pace_s` each.
struct Sweep {
  double start_s = 0.0;
  double by_rad = 0.0;       ///< Signed.
  double speed_radps = 1.0;  ///< Positive.
  double pace_s = 0.1;       ///< At most |by| / speed.

  [[nodiscard]] double end_s() const;
};

/// An angle over time that is at rest before its beginning and after its end, with five continuous
/// derivatives, so that splines through its samples are accurate at the ends:
///
///   q(t) = start + sum_k by_k step((t - start_k) / duration_k) + sweeps + A (1 - cos phi(t))
///
/// where phi rises from 0 to 2 pi `cycles` with a smooth change of pace at both ends.
struct SmoothMotion {
  double start_rad = 0.0;
  std::vector<Move> moves;
  std::vector<Sweep> sweeps;

  double amplitude_rad = 0.0;  ///< Amplitude of the oscillation, from `start_rad` to start + 2 A.
  double oscillation_start_s = 0.0;
  double frequency_hz = 1.0;  ///< Frequency at full pace.
  double pace_s = 0.5;        ///< Time to reach full pace, and to come to rest.
  int cycles = 0;
  double amplitude_variation = 0.0;  ///< Relative change of A from cycle to cycle.
  double variation_hz = 0.0;         ///< Frequency of this change.
  double variation_phase_rad = 0.0;
  double wander_rad = 0.0;  ///< Amplitude of the phase's lead and lag at full pace.
  double wander_hz = 0.0;
  double wander_phase_rad = 0.0;

  [[nodiscard]] Moment operator()(double time_s) const;
  /// Returns the time at which the motion ends in rest [s].
  [[nodiscard]] double end_s() const;
};

}  // namespace myoid::lab
