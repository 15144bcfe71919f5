#include "myoid/posterior/drive.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

namespace myoid::identification {
namespace {

constexpr double kRatePerCutoff = 8.0;
constexpr double kBandHalf_hz = 0.25;      // over which the spectrum is averaged
constexpr double kHighestPerCutoff = 1.2;  // of the frequencies at which W is found
constexpr double kMostNoise = 3.3;         // times the expected power: ln kappa two spreads up
constexpr double kFilterPeriods = 6.0;     // of the cut-off, to either side of the filter's middle

/// One-sided power density of evenly sampled values at each frequency, behind a Hann window.
Eigen::VectorXd power_density(const Eigen::VectorXd& values,
                              double rate_hz,
                              const Eigen::VectorXd& frequency_hz) {
  const Eigen::Index n = values.size();
  const Eigen::ArrayXd window =
      0.5 - 0.5 * (2.0 * std::numbers::pi / static_cast<double>(n) *
                   Eigen::ArrayXd::LinSpaced(n, 0.5, static_cast<double>(n) - 0.5))
                      .cos();
  const double mean = (values.array() * window).sum() / window.sum();
  const Eigen::VectorXd x = (values.array() - mean) * window;
  Eigen::VectorXd power(frequency_hz.size());
  for (Eigen::Index k = 0; k < power.size(); ++k) {
    const std::complex<double> turn =
        std::polar(1.0, -2.0 * std::numbers::pi * frequency_hz[k] / rate_hz);
    std::complex<double> phase = 1.0, sum = 0.0;
    for (Eigen::Index i = 0; i < n; ++i, phase *= turn) sum += x[i] * phase;
    power[k] = 2.0 * std::norm(sum) / (rate_hz * window.square().sum());
  }
  return power;
}

Eigen::VectorXd moving_mean(const Eigen::VectorXd& x, Eigen::Index half) {
  Eigen::VectorXd mean(x.size());
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const Eigen::Index first = std::max<Eigen::Index>(0, i - half);
    mean[i] = x.segment(first, std::min(x.size(), i + half + 1) - first).mean();
  }
  return mean;
}

/// The falling sequence nearest to x by weighted least squares: neighbors that rise are pooled.
Eigen::VectorXd falling(const Eigen::VectorXd& x, const Eigen::VectorXd& weight) {
  struct Pool {
    double weight, mean;
    Eigen::Index count;
  };
  std::vector<Pool> pools;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    pools.push_back({weight[i], x[i], 1});
    while (pools.size() > 1 && pools[pools.size() - 2].mean < pools.back().mean) {
      const Pool last = pools.back();
      pools.pop_back();
      Pool& into = pools.back();
      into.mean = (into.weight * into.mean + last.weight * last.mean) / (into.weight + last.weight);
      into.weight += last.weight;
      into.count += last.count;
    }
  }
  Eigen::VectorXd result(x.size());
  Eigen::Index first = 0;
  for (const Pool& pool : pools) {
    result.segment(first, pool.count).setConstant(pool.mean);
    first += pool.count;
  }
  return result;
}

Eigen::VectorXd evenly(const Envelope& envelope, const Eigen::VectorXd& time_s) {
  return time_s.unaryExpr([&](double t) { return envelope.at(t).value; });
}

/// W and the error that is left over N, at the frequencies of `error`.
struct Wiener {
  Eigen::VectorXd gain, left;
};
Wiener wiener_filter(const Eigen::VectorXd& values,
                     double rate_hz,
                     double noise_sd,
                     const EnvelopeError& error,
                     double cutoff_hz) {
  const Eigen::Index count = std::min<Eigen::Index>(
      error.spectrum().size(),
      static_cast<Eigen::Index>(kHighestPerCutoff * cutoff_hz / error.step_hz()));
  const Eigen::VectorXd frequency = error.frequencies_hz().head(count);
  const auto half = static_cast<Eigen::Index>(std::ceil(kBandHalf_hz / error.step_hz()));
  const Eigen::VectorXd power = moving_mean(power_density(values, rate_hz, frequency), half);
  Eigen::VectorXd noise = noise_sd * noise_sd * values.squaredNorm() /
                          static_cast<double>(values.size()) / error.step_hz() *
                          error.spectrum().head(count);
  std::vector<double> ratio;
  for (Eigen::Index i = 0; i < count; ++i) {
    if (frequency[i] > 0.5 * cutoff_hz && frequency[i] < cutoff_hz)
      ratio.push_back(power[i] / noise[i]);
  }
  std::nth_element(ratio.begin(), ratio.begin() + static_cast<std::ptrdiff_t>(ratio.size() / 2),
                   ratio.end());
  const double level = std::min(kMostNoise, ratio[ratio.size() / 2]);
  noise *= level;
  const Eigen::VectorXd drive = (power - noise).cwiseMax(0.0);
  Wiener wiener{Eigen::VectorXd::Zero(error.spectrum().size()),
                Eigen::VectorXd::Zero(error.spectrum().size())};
  wiener.gain.head(count) = falling(drive.cwiseQuotient(power.cwiseMax(1e-300)), noise);
  wiener.gain.tail(wiener.gain.size() - count).setConstant(wiener.gain[count - 1]);
  const Eigen::ArrayXd passed = wiener.gain.head(count).array();
  // Both parts over the whole noise at that frequency.
  wiener.left = wiener.gain.cwiseAbs2() * level;
  wiener.left.head(count).array() +=
      (1.0 - passed).square() * drive.array() * level / noise.array();
  return wiener;
}

}  // namespace

Drive drive_behind(const Envelope& recorded,
                   double noise_sd,
                   const EnvelopeError& error,
                   double cutoff_hz) {
  const double span_s = recorded.last_s() - recorded.first_s();
  const double rate_hz = kRatePerCutoff * cutoff_hz;
  const auto n = static_cast<Eigen::Index>(span_s * rate_hz) + 1;
  const auto reach = static_cast<Eigen::Index>(kFilterPeriods * kRatePerCutoff);
  if (!(noise_sd > 0.0) || n < 2 * reach)
    return {recorded, Eigen::VectorXd::Ones(error.spectrum().size())};
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(
      n, recorded.first_s(), recorded.first_s() + static_cast<double>(n - 1) / rate_hz);
  const Eigen::VectorXd values = evenly(recorded, time);
  Wiener wiener = wiener_filter(values, rate_hz, noise_sd, error, cutoff_hz);
  const Eigen::VectorXd frequency = error.frequencies_hz();
  Eigen::VectorXd filter(reach + 1);  // from its middle
  for (Eigen::Index j = 0; j <= reach; ++j) {
    const double at = 2.0 * std::numbers::pi * static_cast<double>(j) / rate_hz;
    double sum = 0.0;
    for (Eigen::Index i = 0; i < frequency.size() && frequency[i] < 0.5 * rate_hz; ++i)
      sum += wiener.gain[i] * std::cos(at * frequency[i]);
    const double taper = 0.5 + 0.5 * std::cos(std::numbers::pi * static_cast<double>(j) /
                                              static_cast<double>(reach + 1));
    filter[j] = sum * taper;
  }
  Eigen::VectorXd smooth(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    double sum = 0.0, all = 0.0;
    for (Eigen::Index j = std::max(-reach, -i); j <= std::min(reach, n - 1 - i); ++j) {
      sum += filter[std::abs(j)] * values[i + j];
      all += filter[std::abs(j)];
    }
    smooth[i] = std::max(0.0, sum / all);
  }
  return {Envelope(time, smooth), std::move(wiener.left)};
}

}  // namespace myoid::identification
