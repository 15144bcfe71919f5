#include "myoid/methods/torque.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/beliefs/beliefs.h"
#include "myoid/identification/estimator.h"
#include "myoid/identification/nuisances.h"
#include "myoid/identification/told_by_motion.h"
#include "myoid/intervals/estimates.h"
#include "myoid/intervals/verdict_rules.h"
#include "myoid/methods/basins.h"
#include "myoid/methods/late_emg.h"
#include "myoid/methods/noise_free.h"
#include "myoid/methods/prediction.h"
#include "myoid/methods/smooth_prediction.h"
#include "myoid/posterior/drive.h"
#include "myoid/posterior/posterior.h"

namespace myoid::identification {
namespace {

void add_predictions(const StudyData& data, const TorqueOptions& options, IdentificationResult& result) {
  ModelValues literature = result.values;
  for (std::size_t k = 0; k < data.muscles.size(); ++k)
    literature.muscles[k] = muscle_values(data.muscles[k].start, data.muscles[k].extras);
  for (ChannelValues& channel : literature.channels) {
    channel[kDelay] = options.usual_delay_s();
    channel[kGain] = 1.0;
    channel[kShape] = 0.0;
    channel[kExponent] = 1.0;
  }
  const TrialPredictions predictions(data, options, result);
  for (const TrialData& whole : data.trials) {
    for (std::size_t j = 0; j < joint_count(whole); ++j) {
      const TrialData trial = of_joint(whole, j);
      TrialFit& fit = result.trials.emplace_back(predictions.of(trial));
      Prediction before = predict(data, trial, literature, options.lag);
      fit.literature_force_n = std::move(before.force_n);
      fit.literature_torque_nm = std::move(before.torque_nm);
    }
  }
}

IdentificationResult finish(const Estimator& estimator,
                            const Estimator::Solution& solution,
                            const StudyData& data,
                            std::chrono::steady_clock::time_point begin) {
  const TorqueOptions& options = estimator.options();
  IdentificationResult result = report_estimates(estimator, solution, data);
  const Eigen::VectorXd start = estimator.model().parameters().start();
  // A start that explains the torque may be the minimum; one that does not, and was not left, is no answer.
  if (start.size() > 0 && result.r2 < kVerdictRules.least_r2 &&
      (solution.search.x - start).cwiseAbs().maxCoeff() <= 1e-9 * (1.0 + start.cwiseAbs().maxCoeff())) {
    result.termination = math::Termination::no_descent;
    result.message = "the search did not leave its start";
    result.warnings.push_back(
        "the search did not leave its start, which explains little of the torque: the numbers are the starting values, "
        "no "
        "answer of the recording; do the muscles make any force there (lengths, slack lengths, activations)?");
  }
  if (options.predictions) add_predictions(data, options, result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

/// Data without noise leave nothing to what is unseen: both readings are the same.
void take_as_both_readings(IdentificationResult& exact) {
  for (ParameterEstimate& e : exact.estimates) {
    e.given_estimate = e.estimate;
    e.given_ci_low = e.ci_low;
    e.given_ci_high = e.ci_high;
  }
}

/// Returns the data's preference for lags over a delay: the difference of two sums of squared
/// residuals over their expected variances, times the share of independent samples. The variance
/// with lags is that with a delay, less the noise of the envelopes that the lags remove. Without
/// this reduction the smoother prediction would win even if muscles follow by a delay.
double preference_for_lags(const Estimator& by_delay,
                           const Estimator::Solution& delayed,
                           const Estimator& by_lags,
                           const Estimator::Solution& lagged) {
  Evaluation with_delay, with_lags;
  by_delay.model().evaluate(delayed.search.x, ResidualModel::Depth::value, with_delay);
  by_lags.model().evaluate(lagged.search.x, ResidualModel::Depth::value, with_lags);
  const EstimatorOptions& options = by_lags.options();
  const ChannelValues channel = by_lags.model().parameters().values(lagged.search.x).channels.front();
  const double kept = share_behind_lags({.cutoff_hz = options.residual_cutoff_hz.value_or(options.envelope_cutoff_hz),
                                         .lag_s = lag_times_s(channel, EmgLag::shared)});
  const Eigen::VectorXd& measured = by_delay.model().measured();
  double sum = 0.0;
  for (const Piece& piece : by_delay.model().pieces()) {
    const double factor = delayed.weighting.noise[static_cast<std::size_t>(piece.joint)].emg_factor;
    for (Eigen::Index i = piece.first; i < piece.first + piece.count; ++i) {
      const double variance = std::pow(delayed.weighting.sd_nm[i], 2);
      const double of_emg =
          factor * factor * with_delay.channel_torque.col(i).cwiseAbs2().dot(by_delay.channel_variance());
      const double behind = variance - (1.0 - kept) * std::min(of_emg, variance);
      sum += std::pow(with_delay.predicted[i] - measured[i], 2) / variance -
             std::pow(with_lags.predicted[i] - measured[i], 2) / behind;
    }
  }
  return delayed.weighting.share * sum;
}

/// Warns where the priors, and no fault of the files, are the cause of a fit that explains little.
void judge_priors(const StudyData& data, const TorqueOptions& options, IdentificationResult& result) {
  if (!options.predictions || !options.priors || options.estimator == EstimatorKind::posterior ||
      result.r2 >= kVerdictRules.least_r2)
    return;
  TorqueOptions plain = options;
  plain.priors = plain.weights = false;
  plain.gain_prior_sd.clear();
  plain.intervals = {};
  const Estimator estimator(data, plain);
  const Estimator::Solution found = estimator.solve(estimator.model().parameters().start());
  const double r2 = report_estimates(estimator, found, data).r2;
  constexpr double kDescribes = 0.9;  // other faults also fit somewhat better without priors
  if (!(r2 >= kDescribes)) return;
  std::erase_if(result.warnings, [](const std::string& text) { return text.starts_with(kExplainsLittle); });
  result.warnings.push_back(
      fmt::format("{} (R2 {:.2f}), and without the priors R2 is {:.2f}: the priors hold the numbers away from what the "
                  "recording tells, and no number is called identified; start from values that are nearer to the "
                  "person's, such as the strength",
                  kExplainsLittle, result.r2, r2));
}

/// Returns the best of the minima from many starts and the table of all minima, at the weights of the best.
Estimator::Solution best_of_basins(const Estimator& estimator, const Eigen::VectorXd& start, BasinTable& table) {
  constexpr double kLower = 1e-3;  // of the cost; the same minimum is reproduced more exactly
  Estimator::Solution best = estimator.solve(start);
  for (bool again = true; again;) {
    table = find_basins(estimator, best.weighting, estimator.options().multistart);
    again = false;
    for (const BasinRow& basin : table.basins) {
      if (!(basin.cost < (1.0 - kLower) * best.search.cost)) break;
      Estimator::Solution attempt = estimator.solve(basin.x);
      if (!(attempt.misfit < best.misfit)) continue;
      best = std::move(attempt);
      again = true;
      break;
    }
  }
  return best;
}

/// Returns the best minimum from all starts that the options ask for; with `multistart` also the table.
Estimator::Solution best_solution(const Estimator& estimator,
                                  const Eigen::VectorXd& start,
                                  std::vector<BasinTable>& tables) {
  tables.clear();
  if (estimator.options().multistart < 2) return estimator.solve_from_all_starts(start);
  return best_of_basins(estimator, start, tables.emplace_back());
}

IdentificationResult by_least_squares(const StudyData& data, const TorqueOptions& options) {
  validate(data);
  const auto begin = std::chrono::steady_clock::now();
  const Estimator estimator(data, options);
  const Eigen::VectorXd start = estimator.model().parameters().start();
  std::vector<BasinTable> tables;
  const Estimator::Solution by_delay = best_solution(estimator, start, tables);
  const double delay_s = estimator.model().parameters().values(by_delay.search.x).channels.front()[kDelay];
  const bool choose = options.choose_lag && options.lag == EmgLag::delay && options.weights;
  if (!choose || delay_s < 1e-3) {
    IdentificationResult result = finish(estimator, by_delay, data, begin);
    result.basins = std::move(tables);
    return result;
  }
  TorqueOptions with_lags = options;
  with_lags.lag = EmgLag::shared;
  const Estimator lagging(data, with_lags);
  std::vector<BasinTable> tables_of_lags;
  const Estimator::Solution by_lags = options.multistart < 2
                                          ? lagging.solve(by_delay.search.x)
                                          : best_solution(lagging, by_delay.search.x, tables_of_lags);
  const double gain = preference_for_lags(estimator, by_delay, lagging, by_lags);
  const bool lags = gain > 0.0 && by_lags.search.termination == math::Termination::converged;
  IdentificationResult result = lags ? finish(lagging, by_lags, data, begin) : finish(estimator, by_delay, data, begin);
  result.basins = std::move(lags ? tables_of_lags : tables);
  result.shared_lag_gain = gain;
  return result;
}

}  // namespace

void judge_motion_alone(const StudyData& data, IdentificationResult& result) {
  const std::optional<double> share = told_by_motion_alone(data);
  if (!share || *share < kVerdictRules.motion_alone) return;
  result.warnings.push_back(
      fmt::format("angle, rate and acceleration alone tell {:.1f} % of the torque's variance: no fit can tell the "
                  "muscles from a spring and an inertia, and intervals may miss the truth. Record efforts against "
                  "several loads, or at held angles",
                  100.0 * *share));
  for (ParameterEstimate& e : result.estimates) {
    if (e.verdict != Verdict::identified && e.verdict != Verdict::reproducible) continue;
    e.verdict = Verdict::weak;
    e.reason = fmt::format("motion alone tells {:.1f} % of the torque", 100.0 * *share);
  }
}

IdentificationResult identify_torque(const StudyData& data, const TorqueOptions& options) {
  IdentificationResult result;
  if (options.estimator == EstimatorKind::posterior) {
    const TorqueOptions remembering = remembering_drives(options);
    result = identify_by_posterior(data, remembering);
    if (options.predictions) add_predictions(data, remembering, result);
  } else {
    result = by_least_squares(data, options);
  }
  if (!options.measured_is_force) judge_priors(data, options, result);
  if (!options.measured_is_force) judge_motion_alone(data, result);
  if (options.predictions && !options.measured_is_force) judge_late_emg(data, options, result);
  return result;
}

IdentificationResult identify_torque_or_exact(const StudyData& data,
                                              const TorqueOptions& options,
                                              const std::vector<std::string>& speed_may_be_free) {
  validate(data);
  const auto begin = std::chrono::steady_clock::now();
  TorqueOptions plain = options;
  plain.priors = false;
  plain.weights = false;
  plain.residual_cutoff_hz.reset();
  plain.gain_prior_sd.clear();
  plain.max_rate_hz = std::max(options.max_rate_hz, kNoiseFreeRate_hz);
  plain.estimator = EstimatorKind::least_squares;
  StudyData held = data;
  hold_nuisances(held);
  StudyData freed = held;
  free_speeds(freed, speed_may_be_free);
  StudyData of_emg = data;
  hold_nuisances(of_emg, beliefs::kEmgExponent.name);
  for (const StudyData* study : {&held, &freed, &of_emg}) {
    if (study == &freed && speed_may_be_free.empty()) continue;
    if (study == &of_emg && of_emg.rules == held.rules) continue;
    const Estimator estimator(*study, plain);
    const std::optional<Estimator::Solution> found = noise_free_solution(*study, estimator);
    if (!found) continue;
    IdentificationResult result = finish(estimator, *found, *study, begin);
    result.exact = true;
    take_as_both_readings(result);
    if (options.multistart > 1) result.basins.push_back(find_basins(estimator, found->weighting, options.multistart));
    return result;
  }
  StudyData whole = data;
  free_speeds(whole, speed_may_be_free);
  if (!tells_nuisances(whole, options)) hold_nuisances(whole);
  return identify_torque(whole, options);
}

}  // namespace myoid::identification
