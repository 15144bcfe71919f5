#include "myoid/lab/virtual_person/smooth_motion.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/core/units.h"

namespace myoid::lab {

Moment operator+(const Moment& a, const Moment& b) {
  return {a.value + b.value, a.first + b.first, a.second + b.second};
}

Moment operator-(const Moment& a, const Moment& b) { return a + (-1.0) * b; }

Moment operator*(const Moment& a, const Moment& b) {
  return {a.value * b.value, a.first * b.value + a.value * b.first,
          a.second * b.value + 2.0 * a.first * b.first + a.value * b.second};
}

Moment operator*(double a, const Moment& b) { return {a * b.value, a * b.first, a * b.second}; }

Moment cosine(const Moment& x) {
  const double c = std::cos(x.value);
  const double s = std::sin(x.value);
  return {c, -s * x.first, -c * x.first * x.first - s * x.second};
}

Moment smooth_step(double time_s, double start_s, double duration_s) {
  const double x = (time_s - start_s) / duration_s;
  if (x <= 0.0) return {};
  if (x >= 1.0) return {1.0, 0.0, 0.0};
  const double x4 = x * x * x * x;
  const double value = x4 * x * x * (462.0 + x * (-1980.0 + x * (3465.0 + x * (-3080.0 + x * (1386.0 - 252.0 * x)))));
  // S' = 2772 x^5 (1 - x)^5.
  const double y = x * (1.0 - x);
  const double y4 = y * y * y * y;
  return {value, 2772.0 * y4 * y / duration_s, 13860.0 * y4 * (1.0 - 2.0 * x) / (duration_s * duration_s)};
}

Moment smooth_ramp(double time_s, double start_s, double duration_s) {
  const double x = (time_s - start_s) / duration_s;
  if (x <= 0.0) return {};
  if (x >= 1.0) return {time_s - start_s - 0.5 * duration_s, 1.0, 0.0};
  const double x4 = x * x * x * x;
  const double integral = x4 * x * x * x * (66.0 + x * (-247.5 + x * (385.0 + x * (-308.0 + x * (126.0 - 21.0 * x)))));
  const Moment step = smooth_step(time_s, start_s, duration_s);
  return {integral * duration_s, step.value, step.first};
}

double Sweep::end_s() const { return start_s + std::abs(by_rad) / speed_radps + pace_s; }

Moment SmoothMotion::operator()(double time_s) const {
  Moment q{start_rad, 0.0, 0.0};
  for (const Move& move : moves) {
    q = q + move.by_rad * smooth_step(time_s, move.start_s, move.duration_s);
  }
  for (const Sweep& sweep : sweeps) {
    const double travel_s = std::abs(sweep.by_rad) / sweep.speed_radps;
    q = q +
        std::copysign(sweep.speed_radps, sweep.by_rad) * (smooth_ramp(time_s, sweep.start_s, sweep.pace_s) -
                                                          smooth_ramp(time_s, sweep.start_s + travel_s, sweep.pace_s));
  }
  if (cycles == 0) return q;

  // The pace, 0..1, is a step up and a step down; the phase is its integral.
  const double stop_s = end_s() - pace_s;
  Moment phase = (2.0 * kPi * frequency_hz) *
                 (smooth_ramp(time_s, oscillation_start_s, pace_s) - smooth_ramp(time_s, stop_s, pace_s));
  if (wander_rad > 0.0) {
    const double rate_radps = 2.0 * kPi * wander_hz;
    const Moment pace = smooth_step(time_s, oscillation_start_s, pace_s) - smooth_step(time_s, stop_s, pace_s);
    phase = phase + wander_rad * (pace * cosine({rate_radps * time_s + wander_phase_rad, rate_radps, 0.0}));
  }
  const double w_radps = 2.0 * kPi * variation_hz;
  const Moment variation = cosine({w_radps * time_s + variation_phase_rad, w_radps, 0.0});
  const Moment amplitude = amplitude_rad * (Moment{1.0, 0.0, 0.0} + amplitude_variation * variation);
  return q + amplitude * (Moment{1.0, 0.0, 0.0} - cosine(phase));
}

double SmoothMotion::end_s() const {
  double end = 0.0;
  for (const Move& move : moves) end = std::max(end, move.start_s + move.duration_s);
  // The changes of pace at both ends together take the time of one at full pace.
  if (cycles > 0) end = std::max(end, oscillation_start_s + pace_s + cycles / frequency_hz);
  return end;
}

}  // namespace myoid::lab
