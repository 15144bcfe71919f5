#include "myoid/recording/signals/clock_sync.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/recording/signals/resample.h"

namespace myoid::recording {
namespace {

constexpr double kMostDrift_ppm = 5e4;
constexpr double kMostSigmas = 5.0;

/// A line through the differences of paired instants, and its residuals.
struct Line {
  ClockMap clock;
  double rms_s = 0.0;
};

Line fit_line(const std::vector<double>& file_s, const std::vector<double>& study_s, double sd_s, bool with_prior) {
  const auto n = static_cast<double>(file_s.size());
  double mean_t = 0.0, mean_d = 0.0;
  for (std::size_t i = 0; i < file_s.size(); ++i) {
    mean_t += file_s[i] / n;
    mean_d += (study_s[i] - file_s[i]) / n;
  }
  double spread = 0.0, product = 0.0;
  for (std::size_t i = 0; i < file_s.size(); ++i) {
    spread += (file_s[i] - mean_t) * (file_s[i] - mean_t);
    product += (file_s[i] - mean_t) * (study_s[i] - file_s[i] - mean_d);
  }
  // Least squares with a prior of the slope: the precisions add.
  const double prior = with_prior ? std::pow(sd_s / (1e-6 * kClockPrior_ppm), 2) : 0.0;
  Line line;
  line.clock.pivot_s = mean_t;
  line.clock.offset_s = mean_d;
  line.clock.offset_sd_s = sd_s / std::sqrt(n);
  if (spread + prior > 0.0) {
    const double slope = product / (spread + prior);
    line.clock.drift_ppm = 1e6 * slope;
    line.clock.drift_sd_ppm = 1e6 * sd_s / std::sqrt(spread + prior);
  }
  double squares = 0.0;
  for (std::size_t i = 0; i < file_s.size(); ++i)
    squares += std::pow(study_s[i] - line.clock.study_time_s(file_s[i]), 2);
  line.rms_s = std::sqrt(squares / n);
  return line;
}

std::vector<double> part(const std::vector<double>& values, std::size_t first, std::size_t count) {
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + static_cast<std::ptrdiff_t>(count)};
}

/// Removes the mean and scales to length 1; empty if all values are equal.
Eigen::VectorXd normalised(Eigen::VectorXd x) {
  x.array() -= x.mean();
  const double size = x.norm();
  if (!(size > 1e-12)) return {};
  return x / size;
}

/// Returns the correlation of x, from `first` on, with as many samples of y from `at` on.
double correlation(const Eigen::VectorXd& x, const Eigen::VectorXd& y, Eigen::Index at) {
  const Eigen::VectorXd other = normalised(y.segment(at, x.size()));
  return other.size() == 0 ? 0.0 : x.dot(other);
}

struct Shift {
  double lag = 0.0;  ///< In samples; a parabola interpolates between samples.
  double correlation = -1.0;
  bool inside = false;
  double second = -1.0;  ///< Correlation of the second-best maximum.
};

/// Returns the lag in [low, high] at which y(i + lag) is most similar to x(i).
Shift best_shift(
    const Eigen::VectorXd& x_raw, const Eigen::VectorXd& y, Eigen::Index first, Eigen::Index low, Eigen::Index high) {
  Shift best;
  const Eigen::VectorXd x = normalised(x_raw);
  if (x.size() == 0) return best;
  low = std::max(low, -first);
  high = std::min(high, y.size() - x.size() - first);
  std::vector<double> values;
  for (Eigen::Index lag = low; lag <= high; ++lag) values.push_back(correlation(x, y, first + lag));
  if (values.size() < 3) return best;
  const auto at = std::max_element(values.begin(), values.end()) - values.begin();
  const auto k = static_cast<std::size_t>(at);
  best.correlation = values[k];
  best.lag = static_cast<double>(low) + static_cast<double>(at);
  best.inside = k > 0 && k + 1 < values.size();
  if (best.inside) {
    const double curvature = values[k - 1] - 2.0 * values[k] + values[k + 1];
    if (curvature < 0.0) best.lag += 0.5 * (values[k - 1] - values[k + 1]) / curvature;
  }
  for (std::size_t i = 1; i + 1 < values.size(); ++i) {
    if (i + 1 >= k && i <= k + 1) continue;
    if (values[i] >= values[i - 1] && values[i] > values[i + 1]) best.second = std::max(best.second, values[i]);
  }
  return best;
}

}  // namespace

Instants trigger_edges(const TimeSeries& series, const std::string& channel, bool falling) {
  Instants edges;
  const Eigen::VectorXd x = (falling ? -1.0 : 1.0) * series.column(channel);
  require_finite(series.select({channel}), "trigger");
  edges.sd_s = series.mean_interval_s() / std::sqrt(12.0);
  const double lowest = x.minCoeff();
  const double height = x.maxCoeff() - lowest;
  if (!(height > 0.0)) return edges;
  const double middle = lowest + 0.5 * height;
  bool armed = x[0] < lowest + 0.25 * height;
  for (Eigen::Index i = 1; i < x.size(); ++i) {
    if (armed && x[i] >= middle) {
      // A ramp over several samples crosses where the straight line does; a step crosses in the middle.
      const double share = x[i] > x[i - 1] ? (middle - x[i - 1]) / (x[i] - x[i - 1]) : 1.0;
      const double t = series.time_s()[i - 1];
      edges.time_s.push_back(t + std::clamp(share, 0.0, 1.0) * (series.time_s()[i] - t));
      armed = false;
    } else if (x[i] < lowest + 0.25 * height) {
      armed = true;
    }
  }
  return edges;
}

ClockMap match_instants(const Instants& file, const Instants& study) {
  if (file.time_s.empty() || study.time_s.empty())
    throw InvalidInput("there is no instant to match in one of the recordings");
  const double sd_s = std::hypot(file.sd_s, study.sd_s);
  const bool file_longer = file.time_s.size() > study.time_s.size();
  const std::size_t count = std::min(file.time_s.size(), study.time_s.size());
  const std::size_t ways = std::max(file.time_s.size(), study.time_s.size()) - count + 1;
  if (ways > 1 && count < 3) {
    throw InvalidInput(
        "{} instants in the one recording and {} in the other: too few to tell which belong together; "
        "expected as many in both, or three or more in each",
        file.time_s.size(), study.time_s.size());
  }
  std::optional<Line> best;
  int fits = 0;
  double least_rms_s = kInfinity;
  for (std::size_t way = 0; way < ways; ++way) {
    const std::vector<double> file_s = part(file.time_s, file_longer ? way : 0, count);
    const std::vector<double> study_s = part(study.time_s, file_longer ? 0 : way, count);
    const Line line = fit_line(file_s, study_s, sd_s, false);
    if (std::abs(line.clock.drift_ppm) > kMostDrift_ppm) continue;
    if (line.rms_s < least_rms_s) {
      least_rms_s = line.rms_s;
      best = fit_line(file_s, study_s, sd_s, true);
    }
    if (line.rms_s <= kMostSigmas * sd_s) ++fits;
  }
  if (!best || (fits == 0 && count > 2)) {
    throw InvalidInput(
        "the {} instants of the one recording and the {} of the other do not have the same intervals{}; "
        "are they the same signal?",
        file.time_s.size(), study.time_s.size(), best ? fmt::format(" (off by {:.3g} ms rms)", 1e3 * least_rms_s) : "");
  }
  if (fits > 1)
    throw InvalidInput("{} and {} instants can be paired in {} ways; cut the recordings so that both hold the same",
                       file.time_s.size(), study.time_s.size(), fits);
  return best->clock;
}

ClockMap match_shape(const TimeSeries& file, const TimeSeries& study, double search_s) {
  constexpr double kCoarse_hz = 100.0;
  constexpr double kFine_hz = 1000.0;
  constexpr double kLeastCommon_s = 4.0;
  constexpr double kLeastCorrelation = 0.8;
  /// Share of the best correlation from which another shift counts as equally good.
  constexpr double kUnique = 0.97;
  const double begin_s = std::max(file.time_s()[0] - search_s, study.time_s()[0]);
  const double end_s =
      std::min(file.time_s()[file.sample_count() - 1] + search_s, study.time_s()[study.sample_count() - 1]);
  if (!(end_s - begin_s >= kLeastCommon_s))
    throw InvalidInput("the recordings have less than {} s in common", kLeastCommon_s);
  const auto sampled = [](const TimeSeries& s, double from_s, double to_s, double rate_hz) {
    const auto n = static_cast<Eigen::Index>(std::floor((to_s - from_s) * rate_hz)) + 1;
    const Eigen::VectorXd clock = Eigen::VectorXd::LinSpaced(n, from_s, from_s + static_cast<double>(n - 1) / rate_hz);
    return Eigen::VectorXd(resample(s, clock).values().col(0));
  };
  // Every shift keeps this part of the file inside the study's recording.
  const auto keep = [&](double rate_hz, double lag_s, double reach_s) {
    const double from_s = std::max(file.time_s()[0], study.time_s()[0] - lag_s + reach_s);
    const double to_s =
        std::min(file.time_s()[file.sample_count() - 1], study.time_s()[study.sample_count() - 1] - lag_s - reach_s);
    return std::pair(std::ceil(from_s * rate_hz) / rate_hz, to_s);
  };
  const auto search = [&](double rate_hz, double from_s, double to_s, double lag_s, double reach_s) {
    if (!(to_s - from_s > 0.5)) return Shift{};
    const Eigen::VectorXd x = sampled(file, from_s, to_s, rate_hz);
    const Eigen::VectorXd y = sampled(study, from_s + lag_s - reach_s, to_s + lag_s + reach_s, rate_hz);
    const auto reach = static_cast<Eigen::Index>(std::floor(reach_s * rate_hz));
    Shift shift = best_shift(x, y, reach, -reach, reach);
    // y begins at the study's from + lag - reach.
    shift.lag = lag_s + (shift.lag + static_cast<double>(reach)) / rate_hz - reach_s;
    return shift;
  };
  const double coarse_hz = std::min({kCoarse_hz, file.mean_rate_hz(), study.mean_rate_hz()});
  const auto [from_s, to_s] = keep(coarse_hz, 0.0, search_s);
  const Shift coarse = search(coarse_hz, from_s, to_s, 0.0, search_s);
  if (!coarse.inside || coarse.correlation < kLeastCorrelation) {
    throw InvalidInput("the two signals are not alike within {} s: their correlation is {:.2f}, expected {} or more",
                       search_s, std::max(coarse.correlation, 0.0), kLeastCorrelation);
  }
  if (coarse.second > kUnique * coarse.correlation) {
    throw InvalidInput(
        "the two signals repeat themselves: another shift correlates as well ({:.3f} and {:.3f}); search less far",
        coarse.correlation, coarse.second);
  }
  const double fine_hz = std::min({kFine_hz, file.mean_rate_hz(), study.mean_rate_hz()});
  constexpr double kReach_s = 0.05;
  const auto [first_s, last_s] = keep(fine_hz, coarse.lag, kReach_s);
  const int parts = std::clamp(static_cast<int>((last_s - first_s) / 2.0), 4, 16);
  std::vector<double> file_s, study_s;
  for (int k = 0; k < parts; ++k) {
    const double a = first_s + (last_s - first_s) * k / parts;
    const double b = first_s + (last_s - first_s) * (k + 1) / parts;
    const Shift fine = search(fine_hz, a, b, coarse.lag, kReach_s);
    if (!fine.inside || fine.correlation < kLeastCorrelation) continue;
    file_s.push_back(0.5 * (a + b));
    study_s.push_back(0.5 * (a + b) + fine.lag);
  }
  if (file_s.size() < 3) throw InvalidInput("the two signals are alike as a whole, but not in their parts");
  const Line free = fit_line(file_s, study_s, 1.0, false);
  const auto n = static_cast<double>(file_s.size());
  // The residuals have n - 2 degrees of freedom; a tenth of a sample is the least.
  const double sd_s = std::max(free.rms_s * std::sqrt(n / (n - 2.0)), 0.1 / fine_hz);
  return fit_line(file_s, study_s, sd_s, true).clock;
}

}  // namespace myoid::recording
