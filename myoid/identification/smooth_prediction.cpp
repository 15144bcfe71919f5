#include "myoid/identification/smooth_prediction.h"

#include <cmath>
#include <utility>

#include "myoid/identification/score.h"
#include "myoid/math/butterworth.h"

namespace myoid::identification {
namespace {

/// Gain of two passes of second order, -3 dB at the cut-off.
double two_passes(double frequency_hz, double cutoff_hz) {
  const double corrected = cutoff_hz / std::pow(std::sqrt(2.0) - 1.0, 0.25);
  return 1.0 / (1.0 + std::pow(frequency_hz / corrected, 4));
}

/// Of noise that the envelope's low-pass leaves of white noise, what a further low-pass keeps of
/// the product of the noise with itself.
double kept(double cutoff_hz, double envelope_cutoff_hz) {
  double all = 0.0, below = 0.0;
  const double step = 0.01 * envelope_cutoff_hz;
  for (double f = 0.5 * step; f < 4.0 * envelope_cutoff_hz; f += step) {
    const double density = std::pow(two_passes(f, envelope_cutoff_hz), 2);
    all += density;
    below += density * two_passes(f, cutoff_hz);
  }
  return below / all;
}

}  // namespace

SmoothPrediction smooth_prediction(const Eigen::VectorXd& time_s,
                                   const Eigen::VectorXd& predicted_nm,
                                   double noise_nm2,
                                   double envelope_cutoff_hz) {
  constexpr double kLowest_hz = 0.7;
  constexpr double kStep = 1.125;
  SmoothPrediction best{predicted_nm, 0.0};
  if (!(noise_nm2 > 0.0) || !(envelope_cutoff_hz > 0.0)) return best;
  double least = noise_nm2;
  for (double cutoff_hz = kLowest_hz; cutoff_hz < envelope_cutoff_hz; cutoff_hz *= kStep) {
    Eigen::VectorXd smooth = below(time_s, predicted_nm, cutoff_hz);
    const double risk = (smooth - predicted_nm).squaredNorm() / static_cast<double>(smooth.size()) +
                        (2.0 * kept(cutoff_hz, envelope_cutoff_hz) - 1.0) * noise_nm2;
    if (smooth == predicted_nm || !(risk < least)) continue;
    least = risk;
    best = {std::move(smooth), cutoff_hz};
  }
  return best;
}

}  // namespace myoid::identification
