#include "myoid/recording/signals/emg_kind.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/math/statistics.h"
#include "myoid/recording/signals/quality_limits.h"
#include "myoid/recording/signals/spectrum.h"

namespace myoid::recording {

bool is_envelope(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz) {
  constexpr double kRinging = 0.05;  // share of the maximum by which a filter may swing below zero
  const Eigen::Index n = x.size();
  if (n < 3 || x.minCoeff() < -kRinging * x.maxCoeff() || !(x.maxCoeff() > x.minCoeff())) return false;
  const double median = math::upper_median({x.begin(), x.end()});
  // With few different values the median may be the highest or the lowest of all.
  Eigen::Index above = 0;
  Eigen::Index not_below = 0;
  for (Eigen::Index i = 1; i < n; ++i) {
    above += (x[i] > median) != (x[i - 1] > median) ? 1 : 0;
    not_below += (x[i] >= median) != (x[i - 1] >= median) ? 1 : 0;
  }
  return static_cast<double>(std::max(above, not_below)) * rate_hz <= kLimits.emg.raw_hz * static_cast<double>(n);
}

bool is_rectified(const Eigen::Ref<const Eigen::VectorXd>& x) {
  if (x.size() < 3 || !(x.minCoeff() >= 0.0) || !(x.maxCoeff() > x.minCoeff())) return false;
  const double median = math::upper_median({x.begin(), x.end()});
  const auto near = (x.array() < 0.1 * median).count();
  return static_cast<double>(near) >= kLimits.emg.rectified_share * static_cast<double>(x.size());
}

double flatness_of(const Eigen::VectorXd& x, double rate_hz, double highpass_hz) {
  constexpr double kMost_hz = 450.0;  // amplifiers and converters hold back what is above
  const double from_hz = 1.25 * highpass_hz;
  const double to_hz = std::min(kMost_hz, 0.45 * rate_hz);
  PowerSpectrum spectrum = power_spectrum(x, rate_hz, kSpectrumSegment_s);
  Eigen::Index count = 0;
  for (Eigen::Index i = 0; i < spectrum.density.size(); ++i) {
    const bool inside = spectrum.frequency_hz[i] >= from_hz && spectrum.frequency_hz[i] <= to_hz;
    count += inside ? 1 : 0;
    if (!inside) spectrum.density[i] = 0.0;
  }
  if (count < 10) return 0.0;
  const double white_hz = static_cast<double>(count) * (spectrum.frequency_hz[1] - spectrum.frequency_hz[0]);
  const double bandwidth_hz = statistical_bandwidth_hz(spectrum);
  return std::isfinite(bandwidth_hz) ? bandwidth_hz / white_hz : 0.0;
}

bool is_noise(const Eigen::VectorXd& x, double rate_hz, double highpass_hz) {
  const auto width = static_cast<Eigen::Index>(std::lround(0.5 * rate_hz));
  if (width < 1 || x.size() < width) return false;
  const Eigen::VectorXd levels = math::moving_mean(x.cwiseAbs(), width);
  return levels.maxCoeff() < kLimits.noise.rms_v && levels.maxCoeff() <= kLimits.noise.rises * levels.minCoeff() &&
         flatness_of(x, rate_hz, highpass_hz) > kLimits.noise.flatness;
}

}  // namespace myoid::recording
