#include "myoid/identification/noise_level.h"

#include <algorithm>
#include <cmath>

#include "myoid/beliefs/beliefs.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// Squared residuals and EMG power, averaged over samples of similar power.
struct NoiseBins {
  std::vector<double> squared, power, count;
};

NoiseBins bins_of(const Eigen::ArrayXd& squared, const Eigen::ArrayXd& power) {
  constexpr Eigen::Index kBins = 48;
  const std::vector<Eigen::Index> order = math::rising_order(power.matrix());
  NoiseBins bins;
  const Eigen::Index n = squared.size();
  const Eigen::Index count = std::min(n, kBins);
  for (Eigen::Index b = 0; b < count; ++b) {
    double y = 0.0, p = 0.0;
    const Eigen::Index begin = n * b / count, end = n * (b + 1) / count;
    for (Eigen::Index i = begin; i < end; ++i) {
      y += squared[order[static_cast<std::size_t>(i)]];
      p += power[order[static_cast<std::size_t>(i)]];
    }
    const auto size = static_cast<double>(end - begin);
    bins.squared.push_back(y / size);
    bins.power.push_back(p / size);
    bins.count.push_back(size);
  }
  return bins;
}

/// Returns the minimum of a function with one minimum, to 1e-3.
template <typename Function>
double golden(double low, double high, const Function& f) {
  const double ratio = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - ratio * (high - low), b = low + ratio * (high - low);
  double fa = f(a), fb = f(b);
  while (high - low > 1e-3) {
    if (fa < fb) {
      high = b;
      b = a;
      fb = fa;
      a = high - ratio * (high - low);
      fa = f(a);
    } else {
      low = a;
      a = b;
      fa = fb;
      b = low + ratio * (high - low);
      fb = f(b);
    }
  }
  return 0.5 * (low + high);
}

/// Largest relative noise of an EMG envelope.
constexpr double kLargestNoise = 0.5;

}  // namespace

NoiseLevel fit_known_noise(const Eigen::ArrayXd& squared, const Eigen::ArrayXd& power, double share) {
  constexpr double kLogSd = beliefs::kEmgNoise.sd;
  const NoiseBins bins = bins_of(squared, power);
  const double mean = squared.mean();
  if (!(mean > 0.0)) return {.torque_sd_nm = 0.0, .emg_cv = 1.0, .emg_factor = 1.0};
  const auto cost = [&](double log_a, double log_b) {
    const double a = std::exp(log_a), b = std::exp(log_b);
    double sum = 0.0;
    for (std::size_t i = 0; i < bins.count.size(); ++i) {
      const double v = a + b * bins.power[i];
      sum += bins.count[i] * (std::log(v) + bins.squared[i] / v);
    }
    return 0.5 * share * sum + 0.5 * std::pow(0.5 * log_b / kLogSd, 2);
  };
  const auto best_a = [&](double log_b) {
    return golden(std::log(0.05 * mean), std::log(2.0 * mean), [&](double log_a) { return cost(log_a, log_b); });
  };
  // b varies by a factor of 16, the noise by a factor of 4, either way.
  const double reach = std::log(16.0);
  const double log_b = golden(-reach, reach, [&](double x) { return cost(best_a(x), x); });
  const double factor = std::exp(0.5 * log_b);
  const double h = 0.2;
  const auto profile = [&](double x) { return cost(best_a(x), x); };
  const double curvature = (profile(log_b + h) - 2.0 * profile(log_b) + profile(log_b - h)) / (h * h);
  const double least = 1.0 / std::pow(2.0 * kLogSd, 2);  // curvature of a prior twice as wide
  NoiseLevel level{.torque_sd_nm = std::exp(0.5 * best_a(log_b)),
                   .emg_cv = factor,
                   .emg_factor = factor,
                   .log_variance_sd = 1.0 / std::sqrt(std::max(curvature, least))};
  if (log_b > 0.0) {
    // The EMG may cause the excess over the expected level, too, within the level's uncertainty.
    level.emg_share = std::exp(-log_b);
    level.log_variance_sd = std::min(std::hypot(level.log_variance_sd, log_b), 2.0 * kLogSd);
  }
  return level;
}

NoiseLevel fit_unknown_noise(const Eigen::ArrayXd& squared, const Eigen::ArrayXd& power) {
  double a = squared.mean();
  double b = 0.0;
  const double floor = 1e-6 * a + 1e-300;
  for (int pass = 0; pass < 20; ++pass) {
    const Eigen::ArrayXd weight = (a + b * power).max(floor).square().inverse();
    const double s0 = weight.sum();
    const double s1 = (weight * power).sum();
    const double s2 = (weight * power.square()).sum();
    const double y0 = (weight * squared).sum();
    const double y1 = (weight * power * squared).sum();
    const double determinant = s0 * s2 - s1 * s1;
    const bool regular = determinant > 1e-12 * s0 * s2;
    double next_a = regular ? (s2 * y0 - s1 * y1) / determinant : y0 / s0;
    double next_b = regular ? (s0 * y1 - s1 * y0) / determinant : 0.0;
    if (next_b < 0.0) {
      next_b = 0.0;
      next_a = y0 / s0;
    } else if (next_a < 0.05 * squared.mean()) {
      // Torque is never without noise: a is at least this share of the mean square.
      next_a = 0.05 * squared.mean();
      next_b = std::max(0.0, (y1 - next_a * s1) / std::max(s2, 1e-300));
    }
    a = next_a;
    b = next_b;
  }
  const double factor = std::min(std::sqrt(b), kLargestNoise);
  return {.torque_sd_nm = std::sqrt(std::max(a, 0.0)), .emg_cv = factor, .emg_factor = factor};
}

Eigen::VectorXd averaged_twice(Eigen::VectorXd power,
                               const std::vector<Eigen::Index>& piece_lengths,
                               Eigen::Index half) {
  Eigen::Index first = 0;
  for (const Eigen::Index count : piece_lengths) {
    auto segment = power.segment(first, count);
    for (int pass = 0; pass < 2; ++pass) {
      Eigen::VectorXd sum(count + 1);
      sum[0] = 0.0;
      for (Eigen::Index i = 0; i < count; ++i) sum[i + 1] = sum[i] + segment[i];
      for (Eigen::Index i = 0; i < count; ++i) {
        const Eigen::Index reach = std::min({half, i, count - 1 - i});
        segment[i] = (sum[i + reach + 1] - sum[i - reach]) / static_cast<double>(2 * reach + 1);
      }
    }
    first += count;
  }
  return power;
}

}  // namespace myoid::identification
