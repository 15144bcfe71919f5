#include "myoid/run/mistaken_emg.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/measurement/unseen_activations.h"
#include "myoid/fit/methods/cross_validation.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/posterior/exploration.h"
#include "myoid/ground/core/progress_part.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::run {
namespace {

using fit::Density;
using fit::EstimatorOptions;
using fit::FittedUnknowns;
using fit::IdentificationResult;
using fit::kNoiseFieldCount;
using fit::MuscleSetup;
using fit::StudyData;
using fit::TrialData;

constexpr double kFarNumber = 2.0;       // standard deviations of a muscle's number
constexpr double kExplained = 0.9;       // R2 from which a fit leaves too little for other names to explain
constexpr std::size_t kMostPairs = 4;    // that are tried
constexpr double kLargerErrors = 0.7;    // of ln b, above the median of the other trials: twice
constexpr double kMuchOfTorque = 0.1;    // b sigma_T over the trial's torque, root mean squares
constexpr std::size_t kMostDoubted = 2;  // that are tried

/// Sizes of a mistake that are tried, to either side of none.
struct Sizes {
  double step = 0.0;
  int steps = 0;
  int least = 0;  ///< Steps that a mistake has.
};
constexpr Sizes kLogGains{.step = 0.35, .steps = 7, .least = 2};  // 2 to 12 times: a muscle's levels differ by less
constexpr Sizes kLags_s{.step = 0.1, .steps = 15, .least = 2};    // delays differ by less from trial to trial

/// Returns pairs of channels behind the sums of their muscles' distances from what is known of people, greatest first.
std::vector<std::tuple<double, std::string, std::string>> doubtful_pairs(const StudyData& data,
                                                                         const IdentificationResult& fit) {
  std::map<std::string, double> farthest;
  for (const MuscleSetup& setup : data.muscles) {
    if (setup.unseen) continue;
    double& distance = farthest[setup.emg_channel];
    const auto known = std::ranges::find(fit.prior_distances, setup.name, &fit::PriorDistance::muscle);
    if (known != fit.prior_distances.end()) distance = std::max(distance, known->farthest_distance);
  }
  std::vector<std::tuple<double, std::string, std::string>> pairs;
  for (auto a = farthest.begin(); a != farthest.end(); ++a) {
    for (auto b = std::next(a); b != farthest.end(); ++b)
      if (std::max(a->second, b->second) >= kFarNumber || fit.r2 < kExplained)
        pairs.emplace_back(a->second + b->second, a->first, b->first);
  }
  std::ranges::sort(pairs, std::ranges::greater());
  pairs.resize(std::min(pairs.size(), kMostPairs));
  return pairs;
}

/// Returns the study with two channels exchanged in every trial.
StudyData with_exchanged_names(StudyData data, const std::string& one, const std::string& two) {
  for (MuscleSetup& setup : data.muscles) {
    const bool first = setup.emg_channel == one;
    if (first || setup.emg_channel == two) setup.emg_channel = first ? two : one;
  }
  return data;
}

/// Returns the trial's EMG without the mistake. An exchanged channel counts by the level of its own muscle.
TimeSeries undone(const StudyData& data,
                  const fit::ActivationSource& source,
                  const TimeSeries& emg,
                  const MistakenEmg& mistake) {
  Eigen::MatrixXd values = emg.values();
  if (mistake.is_exchange()) {
    const double first_v = source.of(mistake.first).full_v, second_v = source.of(mistake.second).full_v;
    const double ratio = first_v > 0.0 && second_v > 0.0 ? first_v / second_v : 1.0;
    const Eigen::Index first = emg.index(mistake.first), second = emg.index(mistake.second);
    values.col(first).swap(values.col(second));
    values.col(first) /= ratio;
    values.col(second) *= ratio;
  } else if (!mistake.is_clock()) {
    for (const std::string& channel : fit::measured_channels(data)) values.col(emg.index(channel)) /= mistake.gain;
  }
  return {emg.time_s().array() - mistake.late_s, emg.channels(), std::move(values)};
}

/// Returns the exchanges that one trial may have.
std::vector<MistakenEmg> exchanges_in(const StudyData& data, const std::string& trial) {
  std::vector<MistakenEmg> found;
  const std::vector<std::string> channels = fit::measured_channels(data);
  for (auto a = channels.begin(); a != channels.end(); ++a)
    for (auto b = std::next(a); b != channels.end(); ++b) found.push_back({.trial = trial, .first = *a, .second = *b});
  return found;
}

/// Returns the root mean square of the trial's torque, all joints together.
double torque_size_nm(const TrialData& trial) {
  double squares = 0.0, count = 0.0;
  for (std::size_t j = 0; j < fit::joint_count(trial); ++j) {
    squares += fit::joint_at(trial, j).torque_nm.squaredNorm();
    count += static_cast<double>(trial.time_s.size());
  }
  return std::sqrt(squares / std::max(count, 1.0));
}

/// Returns the fitted trials whose errors are far larger than the other trials', and not small beside their torque, the
/// largest first.
std::vector<std::size_t> doubtful_trials(const StudyData& data, const IdentificationResult& fit) {
  std::vector<std::size_t> fitted;
  for (std::size_t i = 0; i < data.trials.size(); ++i)
    if (data.trials[i].calibration) fitted.push_back(i);
  const auto shares = fit.noise.size() - kNoiseFieldCount;
  if (fitted.size() < 2 || shares < static_cast<Eigen::Index>(fitted.size())) return {};
  std::vector<std::pair<double, std::size_t>> larger;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    std::vector<double> others;
    for (std::size_t j = 0; j < fitted.size(); ++j)
      if (j != i) others.push_back(fit.noise[kNoiseFieldCount + static_cast<Eigen::Index>(j)]);
    const double log_share = fit.noise[kNoiseFieldCount + static_cast<Eigen::Index>(i)];
    const double above = log_share - math::median(std::move(others));
    const double error_nm = std::exp(log_share + fit.noise[fit::kTorqueSd]);
    if (above > kLargerErrors && error_nm > kMuchOfTorque * torque_size_nm(data.trials[fitted[i]]))
      larger.emplace_back(above, fitted[i]);
  }
  std::ranges::sort(larger, std::ranges::greater());
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < std::min(larger.size(), kMostDoubted); ++i) found.push_back(larger[i].second);
  return found;
}

/// The fits of a study with and without a mistake.
class Mistakes {
 public:
  Mistakes(const StudyData& data, const EstimatorOptions& options, const IdentificationResult& fit)
      : data_(data), fit_(fit), plain_(fit::remembering_drives(fit::of_a_fold(options))), progress_(options.progress) {
    plain_.law = fit.lag;
    plain_.choose_lag = false;
    if (std::ranges::any_of(data.muscles, [](const MuscleSetup& setup) { return setup.unseen.has_value(); }))
      least_odds_ = kSureOdds;
  }

  void consider_all_trials() {
    for (const auto& [distance, one, two] : doubtful_pairs(data_, fit_))
      consider({.first = one, .second = two}, with_exchanged_names(data_, one, two), plain_);
  }

  void consider_trial(std::size_t trial) {
    const std::optional<ByOthers> others = without(trial);
    if (!others) return;
    const TimeSeries& emg = data_.trials[trial].activation;
    const double as_it_is = of_one_trial(trial, emg, *others);
    const auto gained = [&](const MistakenEmg& mistake) {
      return of_one_trial(trial, undone(data_, plain_, emg, mistake), *others) - as_it_is;
    };
    MistakenEmg likeliest{.trial = data_.trials[trial].name, .log_odds = kMistakenOdds};
    for (MistakenEmg& exchange : exchanges_in(data_, likeliest.trial)) {
      exchange.log_odds = gained(exchange);
      if (exchange.log_odds > likeliest.log_odds) likeliest = exchange;
    }
    const auto sizes = [&](const Sizes& tried, const auto& of_size) {
      std::map<int, double> odds;
      for (int i = -tried.steps - 1; i <= tried.steps + 1; ++i) odds[i] = gained(of_size(tried.step * i));
      for (int i = -tried.steps; i <= tried.steps; ++i) {
        if (std::abs(i) < tried.least || odds[i] <= likeliest.log_odds) continue;
        // The vertex of the parabola through three sizes.
        const double bend = 2.0 * odds[i] - odds[i - 1] - odds[i + 1];
        const double off = bend > 0.0 ? std::clamp(0.5 * (odds[i + 1] - odds[i - 1]) / bend, -0.5, 0.5) : 0.0;
        likeliest = of_size(tried.step * (i + off));
        likeliest.log_odds = odds[i];
      }
    };
    const std::string name = likeliest.trial;
    sizes(kLogGains, [&](double log_gain) { return MistakenEmg{.trial = name, .gain = std::exp(log_gain)}; });
    sizes(kLags_s, [&](double late_s) { return MistakenEmg{.trial = name, .late_s = late_s}; });
    if (likeliest.log_odds <= kMistakenOdds) return;
    StudyData mended = data_;
    mended.trials[trial].activation = undone(data_, plain_, emg, likeliest);
    consider(likeliest, mended, others->options);
  }

  [[nodiscard]] std::optional<MistakenEmg> best() && { return std::move(best_); }

 private:
  /// Fits the data without the mistake, and keeps it if the evidence is the greatest so far.
  void consider(const MistakenEmg& mistake, const StudyData& without, const EstimatorOptions& options) {
    const auto log_evidence = [&](const StudyData& of, EstimatorOptions how) {
      how.progress = next_part();
      return fit::explore(of, how).modes.front().mode.log_evidence;
    };
    if (!as_it_is_) as_it_is_ = log_evidence(data_, fit::beginning_at(fit_, plain_));
    const double odds = log_evidence(without, options) - *as_it_is_;
    if (odds <= (best_ ? best_->log_odds : least_odds_)) return;
    best_ = mistake;
    best_->log_odds = odds;
    best_->r2 = fit_.r2;
  }

  /// The muscles that the other trials tell.
  struct ByOthers {
    EstimatorOptions options;  ///< Their answer is EstimatorOptions::begin_at.
    fit::Recorded session;
  };
  /// Fits without a trial; empty if it is the only one.
  [[nodiscard]] std::optional<ByOthers> without(std::size_t trial) {
    StudyData others = data_;
    others.trials[trial].calibration = false;
    if (std::ranges::none_of(others.trials, &TrialData::calibration)) return {};
    EstimatorOptions how = fit::beginning_at(fit_, plain_);
    how.progress = next_part();
    const fit::Exploration found = fit::explore(others, how);
    const Density& density = *found.modes.front().density;
    const Eigen::VectorXd& x = found.modes.front().mode.x;
    FittedUnknowns told;
    told.solution = density.z_of(x);
    told.noise = density.noise_of(x).head(kNoiseFieldCount);
    told.lag = fit_.lag;
    for (const fit::Unknown& unknown : density.parameters().free()) told.free_parameters.push_back(unknown.label);
    EstimatorOptions options = plain_;
    options.begin_at = std::make_shared<const FittedUnknowns>(std::move(told));
    return ByOthers{std::move(options), density.likelihood().recorded()};
  }

  /// Returns ln p of one trial with this EMG and the muscles that the other trials tell, at the best size of its error.
  [[nodiscard]] double of_one_trial(std::size_t trial, TimeSeries emg, const ByOthers& others) const {
    StudyData alone = data_;
    for (TrialData& other : alone.trials) other.calibration = false;
    alone.trials[trial].calibration = true;
    alone.trials[trial].activation = std::move(emg);
    const fit::Likelihood likelihood(alone, others.options, fit::Columns::at_reference, &others.session);
    fit::NoiseValues noise = others.options.begin_at->noise;
    noise.conservativeResize(kNoiseFieldCount + 1);
    double best = -std::numeric_limits<double>::infinity();
    for (double& log_share = noise[kNoiseFieldCount] = -0.5; log_share <= 3.0; log_share += 0.5) {
      const double off = log_share / fit::beliefs::kTrialTorqueNoise.sd;
      best = std::max(best, likelihood.value(likelihood.reference(), noise) - 0.5 * off * off);
    }
    return best;
  }

  /// Returns the progress of the next fit. Nobody knows how many follow.
  Progress next_part() {
    const double from = 1.0 - std::pow(0.7, considered_), to = 1.0 - std::pow(0.7, ++considered_);
    Progress part = part_of(progress_, from, to);
    if (part.report)
      part.report = [in = part.report](double share, std::string_view /*what*/) {
        in(share, "looks for mistaken EMG");
      };
    return part;
  }

  const StudyData& data_;
  const IdentificationResult& fit_;
  EstimatorOptions plain_;
  const Progress& progress_;
  int considered_ = 0;
  double least_odds_ = kMistakenOdds;
  std::optional<double> as_it_is_;  ///< ln of the evidence with the mistakes.
  std::optional<MistakenEmg> best_;
};

}  // namespace

bool MistakenEmg::spoils_all(double least_r2) const {
  return !(r2 > least_r2) || (!is_exchange() && log_odds > kSureOdds);
}

std::string MistakenEmg::about_trial() const {
  if (is_exchange()) return fmt::format("electrodes of {} and {} exchanged", first, second);
  if (is_clock())
    return fmt::format("EMG that is {:.1f} s too {} beside its torque", std::abs(late_s),
                       late_s > 0.0 ? "late" : "early");
  return fmt::format("EMG of {:.2g} times the other trials' gain", gain);
}

std::string MistakenEmg::finding() const {
  if (!is_exchange()) return fmt::format("trial '{}' has {}", trial, about_trial());
  return about_trial() + (trial.empty() ? " in every trial" : fmt::format(" in trial '{}'", trial));
}

std::string MistakenEmg::sentence() const {
  return fmt::format("{}: 10^{:.0f} times as probable as the EMG as it is", finding(), log_odds / std::numbers::ln10);
}

std::optional<MistakenEmg> mistaken_emg(const StudyData& data,
                                        const EstimatorOptions& options,
                                        const IdentificationResult& fit) {
  Mistakes mistakes(data, options, fit);
  mistakes.consider_all_trials();
  for (const std::size_t trial : doubtful_trials(data, fit)) mistakes.consider_trial(trial);
  return std::move(mistakes).best();
}

}  // namespace myoid::run
