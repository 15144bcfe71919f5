#include "myoid/lab/virtual_person/raw_emg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/units.h"

namespace myoid::lab {
namespace {

constexpr int kOversampling = 16;
constexpr int kSettle_timeconstants = 40;  // e^-40

/// A first-order section y_k = b0 x_k + b1 x_{k-1} + p y_{k-1}.
struct Section {
  double b0 = 1.0;
  double b1 = 0.0;
  double p = 0.0;
  double x = 0.0;
  double y = 0.0;

  double next(double input) {
    y = b0 * input + b1 * x + p * y;
    x = input;
    return y;
  }
};

/// Returns 1 / (1 + s/w) by the bilinear rule, exact at w itself.
Section lag(double cutoff_hz, double rate_hz) {
  const double k = std::tan(kPi * cutoff_hz / rate_hz);
  return {k / (1.0 + k), k / (1.0 + k), (1.0 - k) / (1.0 + k)};
}

/// Returns (s/w) / (1 + s/w) by the bilinear rule.
Section lead(double cutoff_hz, double rate_hz) {
  const double k = std::tan(kPi * cutoff_hz / rate_hz);
  return {1.0 / (1.0 + k), -1.0 / (1.0 + k), (1.0 - k) / (1.0 + k)};
}

/// The recursion y_k + a1 y_{k-1} + a2 y_{k-2} + a3 y_{k-3} = b0 n_k + b1 n_{k-1} + b2 n_{k-2} + b3 n_{k-3}.
struct Recursion {
  std::array<double, 4> a = {1.0, 0.0, 0.0, 0.0};
  std::array<double, 4> b = {1.0, 0.0, 0.0, 0.0};
};

/// Returns the recursion whose output has the autocovariance of the sampled shaped noise.
Recursion sampled_recursion(const EmgSpectrum& spectrum, double rate_hz) {
  // The autocovariance, from the response to an impulse at a finer rate.
  const double fine_hz = kOversampling * rate_hz;
  std::array<Section, 3> chain = {lead(spectrum.low_hz, fine_hz), lag(spectrum.high_hz, fine_hz),
                                  lag(spectrum.high_hz, fine_hz)};
  Recursion result;
  for (const Section& section : chain) {
    // Sampling turns a pole p into p^16; multiplies by (1 - p^16 z^-1).
    const double pole = std::pow(section.p, kOversampling);
    for (std::size_t i = 3; i > 0; --i) result.a[i] -= pole * result.a[i - 1];
  }
  const auto length = static_cast<std::size_t>(kSettle_timeconstants * fine_hz / (2.0 * kPi * spectrum.low_hz));
  std::vector<double> response(length);
  double input = 1.0;
  for (double& h : response) {
    h = input;
    for (Section& section : chain) h = section.next(h);
    input = 0.0;
  }
  std::array<double, 8> r = {};
  for (std::size_t lag_count = 0; lag_count < r.size(); ++lag_count) {
    for (std::size_t i = 0; i + lag_count * kOversampling < length; ++i)
      r[lag_count] += response[i] * response[i + lag_count * kOversampling];
  }
  // Without the poles a moving average of autocovariance c remains.
  std::array<double, 4> c = {};
  for (int k = 0; k < 4; ++k) {
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        c[at(k)] += result.a[at(i)] * result.a[at(j)] * r[at(std::abs(k + i - j))] / r[0];
      }
    }
  }
  // Bauer: the rows of the Cholesky factor of its band matrix converge to the coefficients.
  constexpr int kRows = 5000;
  std::array<std::array<double, 4>, 4> rows = {};  // row n in rows[n % 4]; entry j: column n - j
  const auto entry = [&rows](int n, int column) -> double& { return rows[at(n % 4)][at(n - column)]; };
  for (int n = 0; n < kRows; ++n) {
    rows[at(n % 4)] = {};
    const int first = std::max(0, n - 3);
    for (int j = first; j <= n; ++j) {
      double sum = c[at(n - j)];
      for (int m = first; m < j; ++m) sum -= entry(n, m) * entry(j, m);
      entry(n, j) = j < n ? sum / entry(j, j) : std::sqrt(sum);
    }
  }
  result.b = rows[(kRows - 1) % 4];
  return result;
}

/// Returns white noise through the sections, scaled to unit variance: the output's variance is the
/// sum of the squared impulse response. Drops the first `settle` values, which depend on the start.
template <std::size_t N>
Eigen::VectorXd shaped_noise(const std::array<Section, N>& sections,
                             int settle,
                             Eigen::Index count,
                             math::Random& random) {
  std::array<Section, N> chain = sections;
  const auto next = [&chain](double value) {
    for (Section& section : chain) value = section.next(value);
    return value;
  };
  double variance = 0.0;
  for (int k = 0; k < settle; ++k) {
    const double response = next(k == 0 ? 1.0 : 0.0);
    variance += response * response;
  }
  const double scale = 1.0 / std::sqrt(variance);

  chain = sections;
  for (int k = 0; k < settle; ++k) static_cast<void>(next(random.normal()));
  Eigen::VectorXd result(count);
  for (double& value : result) value = scale * next(random.normal());
  return result;
}

}  // namespace

Eigen::Index emg_lead(const EmgSpectrum& spectrum, double rate_hz) {
  return static_cast<Eigen::Index>(kSettle_timeconstants * rate_hz / (2.0 * kPi * spectrum.low_hz)) + 1;
}

Eigen::VectorXd emg_from(const EmgSpectrum& spectrum,
                         double rate_hz,
                         const Eigen::VectorXd& innovations,
                         Eigen::Index lead) {
  if (!(rate_hz > 4.0 * spectrum.high_hz)) {
    throw InvalidInput(
        fmt::format("raw EMG at {} Hz cannot carry a spectrum that reaches beyond {} Hz; record at 1000 Hz or more",
                    rate_hz, 2.0 * spectrum.high_hz));
  }
  const Recursion filter = sampled_recursion(spectrum, rate_hz);
  double n1 = 0.0, n2 = 0.0, n3 = 0.0;
  double y1 = 0.0, y2 = 0.0, y3 = 0.0;
  Eigen::VectorXd result(innovations.size() - lead);
  for (Eigen::Index k = 0; k < innovations.size(); ++k) {
    const double n = innovations(k);
    const double y = filter.b[0] * n + filter.b[1] * n1 + filter.b[2] * n2 + filter.b[3] * n3 - filter.a[1] * y1 -
                     filter.a[2] * y2 - filter.a[3] * y3;
    n3 = n2, n2 = n1, n1 = n;
    y3 = y2, y2 = y1, y1 = y;
    if (k >= lead) result(k - lead) = y;
  }
  return result;
}

double discharges_hz(double motor_units, double excitation) {
  constexpr double kRecruited = 0.6;    // excitation at which all units are active
  constexpr double kThresholds = 30.0;  // highest over lowest
  constexpr double kSlowest_hz = 8.0;
  constexpr double kFastest_hz = 30.0;
  constexpr double kLeast = 2.0;  // least number of active units at any excitation
  const double u = std::clamp(excitation, 0.0, 1.0);
  const double share = std::log1p((kThresholds - 1.0) * std::min(1.0, u / kRecruited)) / std::log(kThresholds);
  return std::max(motor_units * share, kLeast) * std::lerp(kSlowest_hz, kFastest_hz, u);
}

Eigen::VectorXd discharge_noise(const Eigen::VectorXd& per_second, double rate_hz, math::Random& random) {
  Eigen::VectorXd noise(per_second.size());
  for (Eigen::Index k = 0; k < per_second.size(); ++k) {
    const double mean = per_second(k) / rate_hz;
    // Draws the Poisson number by inversion of its distribution.
    const double u = random.uniform();
    double probability = std::exp(-mean);
    double below = probability;
    double number = 0.0;
    while (u >= below && number < 200.0) {
      number += 1.0;
      probability *= mean / number;
      below += probability;
    }
    noise(k) = number > 0.0 ? std::sqrt(number / mean) * random.normal() : 0.0;
  }
  return noise;
}

Eigen::VectorXd lowpass_noise(double cutoff_hz, double rate_hz, Eigen::Index count, math::Random& random) {
  if (!(cutoff_hz > 0.0 && cutoff_hz < 0.5 * rate_hz)) {
    throw InvalidInput(
        fmt::format("noise below {} Hz needs samples at more than twice that rate, found {} Hz", cutoff_hz, rate_hz));
  }
  const std::array<Section, 2> chain = {lag(cutoff_hz, rate_hz), lag(cutoff_hz, rate_hz)};
  const int settle = static_cast<int>(40.0 * rate_hz / (2.0 * kPi * cutoff_hz)) + 40;
  return shaped_noise(chain, settle, count, random);
}

}  // namespace myoid::lab
