#include "myoid/signals/emg_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

namespace myoid::signals {
namespace {

/// Extreme means of an envelope: smallest and largest over a pause, and largest over 0.5 s.
struct Levels {
  double least = std::numeric_limits<double>::infinity();
  double peak = 0.0;
  double greatest = 0.0;
  double greatest_s = 0.0;
};

constexpr double kEffort_s = 0.5;

Levels levels(const TimeSeries& envelope, Eigen::Index c) {
  Levels result;
  const Eigen::VectorXd x = envelope.values().col(c);
  Eigen::VectorXd sum(x.size() + 1);
  sum[0] = 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) sum[i + 1] = sum[i] + x[i];
  const auto width = [&](double seconds) {
    return std::clamp<Eigen::Index>(
        static_cast<Eigen::Index>(std::lround(seconds * envelope.mean_rate_hz())), 1, x.size());
  };
  const Eigen::Index narrow = width(kPause_s);
  for (Eigen::Index i = 0; i + narrow <= x.size(); ++i) {
    const double mean = (sum[i + narrow] - sum[i]) / static_cast<double>(narrow);
    result.least = std::min(result.least, mean);
    result.peak = std::max(result.peak, mean);
  }
  const Eigen::Index wide = width(kEffort_s);
  for (Eigen::Index i = 0; i + wide <= x.size(); ++i) {
    const double mean = (sum[i + wide] - sum[i]) / static_cast<double>(wide);
    if (mean <= result.greatest) continue;
    result.greatest = mean;
    result.greatest_s = envelope.time_s()[i + wide / 2];
  }
  return result;
}

}  // namespace

double time_above_s(const Eigen::Ref<const Eigen::VectorXd>& samples,
                    double rate_hz,
                    double level) {
  const auto count = (samples.array() > level).count();
  return rate_hz > 0.0 ? static_cast<double>(count) / rate_hz : 0.0;
}

std::vector<Remark> check_emg_levels(std::span<const TrialEnvelope> trials,
                                     const QualityLimits& limits) {
  std::vector<Remark> faults;
  std::vector<std::string> names;
  for (const TrialEnvelope& trial : trials) {
    for (const Channel& channel : trial.envelope->channels()) {
      if (std::find(names.begin(), names.end(), channel.name) == names.end())
        names.push_back(channel.name);
    }
  }
  for (const std::string& channel : names) {
    double rest = std::numeric_limits<double>::infinity();
    double peak = 0.0;
    Levels mvc;
    Levels movement;
    std::string mvc_trial;
    std::string movement_trial;
    for (const TrialEnvelope& trial : trials) {
      const auto column = trial.envelope->find(channel);
      if (!column) continue;
      const Levels here = levels(*trial.envelope, *column);
      rest = std::min(rest, here.least);
      peak = std::max(peak, here.peak);
      Levels& most_here = trial.is_mvc ? mvc : movement;
      if (here.greatest <= most_here.greatest) continue;
      most_here = here;
      (trial.is_mvc ? mvc_trial : movement_trial) = trial.trial;
    }
    const Levels& most = movement.greatest >= mvc.greatest ? movement : mvc;
    if (peak < limits.signal_to_rest * rest) {
      faults.push_back(
          {.code = RemarkCode::emg_low_signal,
           .severity = Severity::warning,
           .about = channel,
           .when = Stretch{most.greatest_s - 0.5 * kEffort_s, most.greatest_s + 0.5 * kEffort_s},
           .value = peak / rest,
           .says = fmt::format("channel '{}' rises to only {:.2g} times its lowest level, in all "
                               "trials together",
                               channel, peak / rest),
           .remedy =
               "noise, or a muscle that neither rests nor works here: record a second of rest "
               "and a strong effort, and check the electrode"});
    }
    if (!mvc_trial.empty() && movement.greatest > limits.over_reference * mvc.greatest) {
      faults.push_back(
          {.code = RemarkCode::emg_over_reference,
           .severity = Severity::warning,
           .about = channel,
           .when = Stretch{movement.greatest_s, movement.greatest_s},
           .value = movement.greatest / mvc.greatest,
           .says = fmt::format("channel '{}' reaches {:.2f} times its maximal contraction ({}) in "
                               "{} at {:.6g} s",
                               channel, movement.greatest / mvc.greatest, mvc_trial, movement_trial,
                               movement.greatest_s),
           .remedy = "the contraction was not maximal: the larger effort counts as 1, and F_max "
                     "means the force there"});
    }
  }
  return faults;
}

}  // namespace myoid::signals
