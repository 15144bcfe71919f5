#include "myoid/recording/signals/spectrum.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <vector>

#include <fmt/format.h>
#include <unsupported/Eigen/FFT>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"

namespace myoid::recording {
namespace {

/// Returns the next even number at or above n without prime factors above 5, for which the transform is fast.
Eigen::Index quick_length(Eigen::Index n) {
  for (Eigen::Index m = std::max<Eigen::Index>(2, n + n % 2);; m += 2) {
    Eigen::Index rest = m;
    for (const Eigen::Index prime : {2, 3, 5}) {
      while (rest % prime == 0) rest /= prime;
    }
    if (rest == 1) return m;
  }
}

/// Returns the part of bin k (half a bin to both sides) within low..high, 0..1.
double part_within(const PowerSpectrum& s, Eigen::Index k, double low_hz, double high_hz) {
  const double width = s.frequency_hz[1];
  const double begin = std::max(0.0, s.frequency_hz[k] - 0.5 * width);
  const double end = std::min(s.frequency_hz[s.frequency_hz.size() - 1], s.frequency_hz[k] + 0.5 * width);
  return std::max(0.0, std::min(end, high_hz) - std::max(begin, low_hz)) / width;
}

}  // namespace

PowerSpectrum power_spectrum(const Eigen::VectorXd& x, double rate_hz, double segment_s) {
  if (x.size() < 8 || !x.allFinite() || !(rate_hz > 0.0) || !(segment_s > 0.0)) {
    throw InvalidInput(
        "power spectrum of {} samples at {} Hz in segments of {} s: at least 8 finite samples and positive "
        "numbers are needed",
        x.size(), rate_hz, segment_s);
  }
  const Eigen::Index wanted =
      std::max<Eigen::Index>(8, static_cast<Eigen::Index>(std::lround(std::min(segment_s * rate_hz, 1e9))));
  const Eigen::Index n = std::min(x.size(), wanted);
  const Eigen::Index step = std::max<Eigen::Index>(1, n / 2);
  const Eigen::Index padded = quick_length(n);
  Eigen::VectorXd window(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
  }
  const Eigen::Index bins = padded / 2 + 1;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(bins);
  // Keeps the roots of unity for the lengths of this thread.
  thread_local Eigen::FFT<double> fft(Eigen::FFT<double>::impl_type(), Eigen::FFT<double>::HalfSpectrum);
  std::vector<double> segment(static_cast<std::size_t>(padded), 0.0);
  std::vector<std::complex<double>> transform;
  int count = 0;
  for (Eigen::Index first = 0; first + n <= x.size(); first += step, ++count) {
    const double mean = x.segment(first, n).mean();
    for (Eigen::Index i = 0; i < n; ++i) {
      segment[static_cast<std::size_t>(i)] = (x[first + i] - mean) * window[i];
    }
    fft.fwd(transform, segment);
    for (Eigen::Index k = 0; k < bins; ++k) sum[k] += std::norm(transform[static_cast<std::size_t>(k)]);
  }
  // Both sides are added, except at the ends of the spectrum, which have one.
  Eigen::VectorXd density = 2.0 * sum / (count * rate_hz * window.squaredNorm());
  density[0] *= 0.5;
  density[bins - 1] *= 0.5;
  return {.frequency_hz = Eigen::VectorXd::LinSpaced(bins, 0.0, 0.5 * rate_hz), .density = std::move(density)};
}

double band_power(const PowerSpectrum& spectrum, double low_hz, double high_hz) {
  double power = 0.0;
  for (Eigen::Index k = 0; k < spectrum.density.size(); ++k) {
    power += spectrum.density[k] * spectrum.frequency_hz[1] * part_within(spectrum, k, low_hz, high_hz);
  }
  return power;
}

double statistical_bandwidth_hz(const PowerSpectrum& spectrum) {
  if (spectrum.density.size() < 2) return kNan;
  const double sum = spectrum.density.sum();
  const double width_hz = spectrum.frequency_hz[1] - spectrum.frequency_hz[0];
  return sum > 0.0 ? width_hz * sum * sum / spectrum.density.squaredNorm() : kNan;
}

double median_frequency_hz(const PowerSpectrum& spectrum, double low_hz, double high_hz) {
  const double half = 0.5 * band_power(spectrum, low_hz, high_hz);
  if (!(half > 0.0)) return kNan;
  const double width = spectrum.frequency_hz[1];
  double below = 0.0;
  for (Eigen::Index k = 0; k < spectrum.density.size(); ++k) {
    const double here = spectrum.density[k] * width * part_within(spectrum, k, low_hz, high_hz);
    if (below + here >= half) {
      const double begin = std::max({0.0, low_hz, spectrum.frequency_hz[k] - 0.5 * width});
      return begin + (half - below) / spectrum.density[k];
    }
    below += here;
  }
  return high_hz;
}

TimeSeries median_frequency(const TimeSeries& raw, const MedianFrequencyOptions& options) {
  constexpr double kSignalToNoise = 4.0;
  const double rate = raw.mean_rate_hz();
  if (!raw.is_uniform() || rate < 4.0 * options.low_hz) {
    throw InvalidInput("median frequency: {:.4g} Hz; raw EMG on an even clock of at least {:.4g} Hz is needed", rate,
                       4.0 * options.low_hz);
  }
  if (options.resting_rms.size() != 0 && options.resting_rms.size() != raw.channel_count()) {
    throw InvalidInput("median frequency: {} resting levels for {} channels", options.resting_rms.size(),
                       raw.channel_count());
  }
  const double high_hz = std::min(options.high_hz, 0.45 * rate);
  const auto length = static_cast<Eigen::Index>(std::lround(options.window_s * rate));
  const Eigen::Index windows = length >= 8 ? raw.sample_count() / length : 0;
  const Eigen::Index count = raw.channel_count();
  Eigen::MatrixXd median(windows, count);
  Eigen::VectorXd middle(windows);
  for (Eigen::Index w = 0; w < windows; ++w) {
    middle[w] = 0.5 * (raw.time_s()[w * length] + raw.time_s()[(w + 1) * length - 1]);
    for (Eigen::Index c = 0; c < count; ++c) {
      const PowerSpectrum spectrum =
          power_spectrum(raw.values().col(c).segment(w * length, length), rate, kSpectrumSegment_s);
      median(w, c) = median_frequency_hz(spectrum, options.low_hz, high_hz);
      const bool quiet = options.resting_rms.size() > 0 && band_power(spectrum, options.low_hz, high_hz) <
                                                               kSignalToNoise * std::pow(options.resting_rms[c], 2);
      if (quiet) median(w, c) = kNan;
    }
  }
  std::vector<Channel> channels = raw.channels();
  for (Channel& channel : channels) channel.unit = Unit::hertz;
  return {std::move(middle), std::move(channels), std::move(median)};
}

}  // namespace myoid::recording
