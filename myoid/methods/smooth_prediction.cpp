#include "myoid/methods/smooth_prediction.h"

#include <cmath>
#include <utility>

#include "myoid/core/units.h"
#include "myoid/intervals/score.h"
#include "myoid/math/butterworth.h"

namespace myoid::identification {
namespace {

/// Returns the gain of two passes of second order, -3 dB at the cut-off.
double two_passes(double frequency_hz, double cutoff_hz) {
  const double corrected = cutoff_hz / std::pow(std::sqrt(2.0) - 1.0, 0.25);
  return 1.0 / (1.0 + std::pow(frequency_hz / corrected, 4));
}

/// Returns the noise's power density, relative to the white noise before the filters.
double density(double frequency_hz, const EnvelopeNoise& noise) {
  double power = std::pow(two_passes(frequency_hz, noise.cutoff_hz), 2);
  for (const double tau_s : noise.lag_s) power /= 1.0 + std::pow(2.0 * kPi * frequency_hz * tau_s, 2);
  return power;
}

/// Returns the integral over all frequencies of the density times `gain`.
template <typename Gain>
double power(const EnvelopeNoise& noise, Gain gain) {
  double sum = 0.0;
  const double step = 0.01 * noise.cutoff_hz;
  for (double f = 0.5 * step; f < 4.0 * noise.cutoff_hz; f += step) sum += step * density(f, noise) * gain(f);
  return sum;
}

}  // namespace

double share_behind_lags(const EnvelopeNoise& noise) {
  const auto all = [](double) { return 1.0; };
  return power(noise, all) / power({.cutoff_hz = noise.cutoff_hz}, all);
}

SmoothPrediction smooth_prediction(const Eigen::VectorXd& time_s,
                                   const Eigen::VectorXd& predicted_nm,
                                   const EnvelopeNoise& noise) {
  constexpr double kLowest_hz = 0.7;
  constexpr double kStep = 1.125;
  SmoothPrediction best{predicted_nm, 0.0};
  if (!(noise.variance_nm2 > 0.0) || !(noise.cutoff_hz > 0.0)) return best;
  const double whole = power(noise, [](double) { return 1.0; });
  const double noise_nm2 = noise.variance_nm2 * share_behind_lags(noise);
  double least = noise_nm2;
  for (double cutoff_hz = kLowest_hz; cutoff_hz < noise.cutoff_hz; cutoff_hz *= kStep) {
    Eigen::VectorXd smooth = below(time_s, predicted_nm, cutoff_hz);
    const double kept = power(noise, [&](double f) { return two_passes(f, cutoff_hz); }) / whole;
    const double risk =
        (smooth - predicted_nm).squaredNorm() / static_cast<double>(smooth.size()) + (2.0 * kept - 1.0) * noise_nm2;
    if (smooth == predicted_nm || !(risk < least)) continue;
    least = risk;
    best = {std::move(smooth), cutoff_hz};
  }
  return best;
}

}  // namespace myoid::identification
