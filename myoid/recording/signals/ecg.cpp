#include "myoid/recording/signals/ecg.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/math/statistics.h"
#include "myoid/recording/signals/filter.h"
#include "myoid/recording/signals/quality_limits.h"

namespace myoid::recording {
namespace {

constexpr double kLowestHeart_hz = 8.0, kHighestHeart_hz = 40.0;
constexpr double kShortestBeat_s = 0.33, kLongestBeat_s = 1.6;
constexpr double kHalfWave_s = 0.06;
constexpr double kBefore_s = 0.2, kBehind_s = 0.4;
constexpr std::size_t kFewestBeats = 6;
/// Between beats the heart is silent: the median of the signal over the height of a beat. Noise has 0.25, hum 0.7.
constexpr double kBetweenBeats = 0.2;
constexpr std::ptrdiff_t kBeatsAround = 15;

Eigen::Index beat_samples(double seconds, double rate_hz) {
  return std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::lround(seconds * rate_hz)));
}

Eigen::VectorXd band_of_the_heart(const Eigen::VectorXd& x, double rate_hz) {
  const auto n = x.size();
  const TimeSeries one(Eigen::VectorXd::LinSpaced(n, 0.0, static_cast<double>(n - 1) / rate_hz), {{"x", Unit::volt}},
                       Eigen::MatrixXd(x));
  const FilterOptions options{.order = 2, .ends = math::Ends::even};
  const TimeSeries high = zero_phase_filter(one, math::FilterBand::high_pass, kLowestHeart_hz, options);
  return zero_phase_filter(high, math::FilterBand::low_pass, kHighestHeart_hz, options).values().col(0);
}

/// Returns the greatest samples of |y|, none nearer to a greater one than the shortest beat, of at least half the
/// median of the greatest of every 1.6 s: each stretch that long holds a beat.
std::vector<Eigen::Index> beat_peaks(const Eigen::VectorXd& y, double rate_hz) {
  const Eigen::Index stretch = beat_samples(kLongestBeat_s, rate_hz), apart = beat_samples(kShortestBeat_s, rate_hz);
  std::vector<double> greatest;
  for (Eigen::Index i = 0; i + stretch <= y.size(); i += stretch)
    greatest.push_back(y.segment(i, stretch).cwiseAbs().maxCoeff());
  std::vector<Eigen::Index> peaks;
  if (greatest.empty()) return peaks;
  const double least = 0.5 * math::median(std::move(greatest));
  for (Eigen::Index i = 0; i < y.size(); ++i) {
    if (std::abs(y[i]) < least) continue;
    const Eigen::Index first = std::max<Eigen::Index>(0, i - apart), last = std::min(y.size() - 1, i + apart);
    Eigen::Index top = 0;
    y.segment(first, last - first + 1).cwiseAbs().maxCoeff(&top);
    if (first + top == i) peaks.push_back(i);
  }
  return peaks;
}

/// Returns the correlation of every peak's wave with the mean of the others'.
std::vector<double> likeness(const Eigen::VectorXd& y, const std::vector<Eigen::Index>& peaks, Eigen::Index half) {
  std::vector<Eigen::VectorXd> waves;
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(2 * half + 1);
  for (const Eigen::Index at : peaks) {
    if (at < half || at + half >= y.size()) continue;
    waves.emplace_back(y.segment(at - half, 2 * half + 1));
    sum += waves.back();
  }
  std::vector<double> alike;
  for (const Eigen::VectorXd& wave : waves) {
    const Eigen::VectorXd others = sum - wave;
    const double size = wave.norm() * others.norm();
    alike.push_back(size > 0.0 ? wave.dot(others) / size : 0.0);
  }
  return alike;
}

}  // namespace

std::optional<EcgBeats> find_ecg(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz) {
  if (!(rate_hz >= 200.0) || static_cast<double>(x.size()) < rate_hz * kLongestBeat_s * kFewestBeats)
    return std::nullopt;
  const Eigen::VectorXd y = band_of_the_heart(x, rate_hz);
  EcgBeats beats{.at = beat_peaks(y, rate_hz)};
  if (beats.at.size() < kFewestBeats) return std::nullopt;
  std::vector<double> steps;
  for (std::size_t i = 1; i < beats.at.size(); ++i)
    steps.push_back(static_cast<double>(beats.at[i] - beats.at[i - 1]) / rate_hz);
  const double usual_s = math::median(steps);
  // Intervals as short as two peaks can be are those of a signal that goes on and on.
  if (usual_s > kLongestBeat_s || usual_s < 1.1 * kShortestBeat_s) return std::nullopt;
  std::vector<double> off;
  for (const double step : steps) off.push_back(std::abs(step - usual_s));
  if (math::median(std::move(off)) > kLimits.emg.ecg_irregular * usual_s) return std::nullopt;
  std::vector<double> alike = likeness(y, beats.at, beat_samples(kHalfWave_s, rate_hz));
  if (alike.size() < kFewestBeats) return std::nullopt;
  beats.alike = math::median(std::move(alike));
  if (beats.alike < kLimits.emg.ecg_alike) return std::nullopt;
  beats.rate_hz = 1.0 / usual_s;
  for (const Eigen::Index at : beats.at) beats.amplitude += std::abs(y[at]) / static_cast<double>(beats.at.size());
  const Eigen::VectorXd size = y.cwiseAbs();
  if (math::median({size.begin(), size.end()}) > kBetweenBeats * beats.amplitude) return std::nullopt;
  return beats;
}

Eigen::VectorXd without_ecg(const Eigen::Ref<const Eigen::VectorXd>& x, double rate_hz, const EcgBeats& beats) {
  const Eigen::Index before = beat_samples(kBefore_s, rate_hz), length = before + beat_samples(kBehind_s, rate_hz);
  Eigen::VectorXd fade = Eigen::VectorXd::Ones(length);
  const Eigen::Index ramp = length / 6;
  for (Eigen::Index i = 0; i < ramp; ++i) {
    const double share = (static_cast<double>(i) + 0.5) / static_cast<double>(ramp);
    fade[i] *= share;
    fade[length - 1 - i] *= share;
  }
  Eigen::VectorXd clean = x;
  const auto count = static_cast<std::ptrdiff_t>(beats.at.size());
  for (std::ptrdiff_t b = 0; b < count; ++b) {
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(length);
    double used = 0.0;
    for (std::ptrdiff_t o = std::max<std::ptrdiff_t>(0, b - kBeatsAround); o < std::min(count, b + kBeatsAround + 1);
         ++o) {
      const Eigen::Index first = beats.at[static_cast<std::size_t>(o)] - before;
      if (o == b || first < 0 || first + length > x.size()) continue;
      mean += x.segment(first, length);
      used += 1.0;
    }
    if (used < 3.0) continue;
    mean /= used;
    mean.array() -= mean.mean();
    const Eigen::Index first = beats.at[static_cast<std::size_t>(b)] - before;
    const Eigen::Index from = std::max<Eigen::Index>(0, first), to = std::min(x.size(), first + length);
    const Eigen::VectorXd here = x.segment(from, to - from), shape = mean.segment(from - first, to - from);
    const double scale = std::clamp(here.dot(shape) / std::max(shape.squaredNorm(), 1e-300), 0.5, 1.5);
    clean.segment(from, to - from) -= scale * shape.cwiseProduct(fade.segment(from - first, to - from));
  }
  return clean;
}

}  // namespace myoid::recording
