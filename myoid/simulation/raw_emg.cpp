#include "myoid/simulation/raw_emg.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"

namespace myoid::simulation {
namespace {

constexpr int kOversampling = 4;

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

/// 1 / (1 + s/w) by the bilinear rule, exact at w itself.
Section lag(double cutoff_hz, double rate_hz) {
  const double k = std::tan(kPi * cutoff_hz / rate_hz);
  return {k / (1.0 + k), k / (1.0 + k), (1.0 - k) / (1.0 + k)};
}

/// (s/w) / (1 + s/w) likewise.
Section lead(double cutoff_hz, double rate_hz) {
  const double k = std::tan(kPi * cutoff_hz / rate_hz);
  return {1.0 / (1.0 + k), -1.0 / (1.0 + k), (1.0 - k) / (1.0 + k)};
}

/// White noise through the sections, brought to unit variance: that of the output is the sum of the
/// squared impulse response. The first `settle` values, which still remember the start, are
/// dropped.
template <std::size_t N>
Eigen::VectorXd shaped_noise(const std::array<Section, N>& sections,
                             int settle,
                             int keep_every,
                             Eigen::Index count,
                             Random& random) {
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
  for (double& value : result) {
    for (int k = 1; k < keep_every; ++k) static_cast<void>(next(random.normal()));
    value = scale * next(random.normal());
  }
  return result;
}

}  // namespace

double power(const EmgSpectrum& spectrum, double frequency_hz) {
  const double f2 = frequency_hz * frequency_hz;
  const double low2 = spectrum.low_hz * spectrum.low_hz;
  const double high2 = spectrum.high_hz * spectrum.high_hz;
  return f2 * high2 * high2 / ((f2 + low2) * (f2 + high2) * (f2 + high2));
}

Eigen::VectorXd emg_noise(const EmgSpectrum& spectrum,
                          double rate_hz,
                          Eigen::Index count,
                          Random& random) {
  if (!(rate_hz > 4.0 * spectrum.high_hz)) {
    throw InvalidInput(
        fmt::format("raw EMG at {} Hz cannot carry a spectrum that reaches beyond {} Hz; record at "
                    "1000 Hz or more",
                    rate_hz, 2.0 * spectrum.high_hz));
  }
  const double fine_hz = kOversampling * rate_hz;
  const std::array<Section, 3> chain = {lead(spectrum.low_hz, fine_hz),
                                        lag(spectrum.high_hz, fine_hz),
                                        lag(spectrum.high_hz, fine_hz)};
  // Forty time constants of the slowest pole: e^-40.
  const int settle = static_cast<int>(40.0 * fine_hz / (2.0 * kPi * spectrum.low_hz));
  return shaped_noise(chain, settle, kOversampling, count, random);
}

Eigen::VectorXd lowpass_noise(double cutoff_hz,
                              double rate_hz,
                              Eigen::Index count,
                              Random& random) {
  if (!(cutoff_hz > 0.0 && cutoff_hz < 0.5 * rate_hz)) {
    throw InvalidInput(
        fmt::format("noise below {} Hz needs samples at more than twice that rate, found {} Hz",
                    cutoff_hz, rate_hz));
  }
  const std::array<Section, 2> chain = {lag(cutoff_hz, rate_hz), lag(cutoff_hz, rate_hz)};
  const int settle = static_cast<int>(40.0 * rate_hz / (2.0 * kPi * cutoff_hz)) + 40;
  return shaped_noise(chain, settle, 1, count, random);
}

}  // namespace myoid::simulation
