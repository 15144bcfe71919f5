#include "myoid/methods/torque.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "myoid/identification/estimator.h"
#include "myoid/identification/muscle_activation.h"
#include "myoid/intervals/estimates.h"
#include "myoid/methods/basins.h"
#include "myoid/methods/noise_free.h"
#include "myoid/methods/trial_fit.h"
#include "myoid/muscle/hill_muscle.h"
#include "myoid/posterior/posterior.h"

namespace myoid::identification {
namespace {

void add_predictions(const StudyData& data,
                     const TorqueOptions& options,
                     IdentificationResult& result) {
  ModelValues literature = result.values;
  for (std::size_t k = 0; k < data.muscles.size(); ++k)
    literature.muscles[k] = muscle_values(data.muscles[k].start, data.muscles[k].extras);
  for (ChannelValues& channel : literature.channels) {
    channel[kDelay] = options.delay_s.value_or(options.delay_prior_mean_s);
    channel[kGain] = 1.0;
    channel[kShape] = 0.0;
    channel[kExponent] = 1.0;
  }
  for (const TrialData& whole : data.trials) {
    for (std::size_t j = 0; j < joint_count(whole); ++j) {
      const TrialData trial = of_joint(whole, j);
      TrialFit fit = unfitted_trial(trial);
      Prediction before = predict(data, trial, literature, options.lag);
      auto [after, smooth] = predict(data, trial, result, options.envelope_cutoff_hz);
      fit.smooth_hz = smooth.cutoff_hz;
      if (after.torque_nm.size() == trial.torque_nm.size()) {
        const std::vector<Eigen::Index> rows = included_rows(trial);
        const Eigen::VectorXd measured = trial.torque_nm(rows);
        const Eigen::VectorXd predicted = after.torque_nm(rows);
        fit.score = score(measured, predicted);
        const double cutoff_hz = options.residual_cutoff_hz.value_or(0.0);
        fit.band = score(below(trial.time_s, trial.torque_nm, cutoff_hz)(rows),
                         below(trial.time_s, after.torque_nm, cutoff_hz)(rows));
      }
      fit.literature_force_n = std::move(before.force_n);
      fit.literature_torque_nm = std::move(before.torque_nm);
      fit.force_fit_n = std::move(after.force_n);
      fit.torque_fit_nm = std::move(after.torque_nm);
      result.trials.push_back(std::move(fit));
    }
  }
}

IdentificationResult finish(const Estimator& estimator,
                            const Estimator::Solution& solution,
                            const StudyData& data,
                            std::chrono::steady_clock::time_point begin) {
  const TorqueOptions& options = estimator.options();
  IdentificationResult result = report_estimates(estimator, solution, data);
  if (options.predictions) add_predictions(data, options, result);
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

/// The data's preference for lags over a delay: the difference of two sums of squared residuals
/// over their expected variances, times the share of independent samples. The variance with lags is
/// the variance with a delay, less the noise of the envelopes that the lags remove. Without that
/// reduction the smoother prediction would win even where muscles follow by a delay.
double preference_for_lags(const Estimator& by_delay,
                           const Estimator::Solution& delayed,
                           const Estimator& by_lags,
                           const Estimator::Solution& lagged) {
  Evaluation with_delay, with_lags;
  by_delay.model().evaluate(delayed.search.x, ResidualModel::Depth::value, with_delay);
  by_lags.model().evaluate(lagged.search.x, ResidualModel::Depth::value, with_lags);
  const EstimatorOptions& options = by_lags.options();
  const ChannelValues channel =
      by_lags.model().parameters().values(lagged.search.x).channels.front();
  const double kept = share_behind_lags(
      {.cutoff_hz = options.residual_cutoff_hz.value_or(options.envelope_cutoff_hz),
       .lag_s = lag_times_s(channel, EmgLag::shared)});
  const Eigen::VectorXd& measured = by_delay.model().measured();
  double sum = 0.0;
  for (const Piece& piece : by_delay.model().pieces()) {
    const double factor = delayed.weighting.noise[static_cast<std::size_t>(piece.joint)].emg_factor;
    for (Eigen::Index i = piece.first; i < piece.first + piece.count; ++i) {
      const double variance = std::pow(delayed.weighting.sd_nm[i], 2);
      const double of_emg =
          factor * factor *
          with_delay.channel_torque.col(i).cwiseAbs2().dot(by_delay.channel_variance());
      const double behind = variance - (1.0 - kept) * std::min(of_emg, variance);
      sum += std::pow(with_delay.predicted[i] - measured[i], 2) / variance -
             std::pow(with_lags.predicted[i] - measured[i], 2) / behind;
    }
  }
  return delayed.weighting.share * sum;
}

/// Returns the best of the minima from many starts and the table of all minima, at the weights of
/// the best.
Estimator::Solution best_of_basins(const Estimator& estimator,
                                   const Eigen::VectorXd& start,
                                   BasinTable& table) {
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

/// Returns the best minimum from all starts that the options ask for; with `multistart` also the
/// table.
Estimator::Solution best_solution(const Estimator& estimator,
                                  const Eigen::VectorXd& start,
                                  std::vector<BasinTable>& tables) {
  tables.clear();
  if (estimator.options().multistart < 2) return estimator.solve_from_all_starts(start);
  return best_of_basins(estimator, start, tables.emplace_back());
}

}  // namespace

Prediction predict(const StudyData& data,
                   const TrialData& trial,
                   const std::vector<muscle::HillParameters<double>>& muscles,
                   double delay_s,
                   EmgLag lag) {
  Prediction p;
  p.activation = muscle_activation(data, trial, trial.time_s, delay_s);
  if (lag != EmgLag::delay) {
    ChannelValues as_it_is{};
    as_it_is[kDelay] = delay_s;
    as_it_is[kGain] = as_it_is[kExponent] = 1.0;
    for (std::size_t k = 0; k < data.muscles.size(); ++k) {
      const Envelope envelope(trial.activation.time_s(),
                              trial.activation.column(data.muscles[k].emg_channel));
      const std::vector<Activation> a = activation(envelope, trial.time_s, as_it_is, lag);
      for (std::size_t i = 0; i < a.size(); ++i)
        p.activation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = a[i].value;
    }
  }
  p.force_n.resize(trial.time_s.size(), trial.length_m.cols());
  for (Eigen::Index k = 0; k < p.force_n.cols(); ++k) {
    const auto& parameters = muscles[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < p.force_n.rows(); ++i) {
      p.force_n(i, k) = muscle::hill_force(p.activation(i, k),
                                           trial.length_m(i, k) - parameters.tendon_slack_length_m,
                                           trial.velocity_mps(i, k), parameters);
    }
  }
  if (trial.moment_arm_m.rows() == trial.time_s.size()) {
    p.torque_nm =
        trial.moment_arm_m.cwiseProduct(p.force_n).rowwise().sum() + resting_torque_nm(trial);
  }
  return p;
}

Prediction predict(const StudyData& data,
                   const TrialData& trial,
                   const ModelValues& values,
                   EmgLag lag) {
  const Eigen::Index n = trial.time_s.size();
  Prediction p;
  p.force_n.resize(n, trial.length_m.cols());
  p.activation.resize(n, trial.length_m.cols());
  p.channel_torque_nm.setZero(n, static_cast<Eigen::Index>(values.channels.size()));
  const bool with_torque = trial.moment_arm_m.rows() == n;
  std::vector<std::string> channels;
  std::vector<std::vector<Activation>> activations;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const std::string& name = data.muscles[k].emg_channel;
    auto it = std::find(channels.begin(), channels.end(), name);
    const auto c = static_cast<std::size_t>(it - channels.begin());
    if (it == channels.end()) {
      channels.push_back(name);
      activations.push_back(
          activation(Envelope(trial.activation.time_s(), trial.activation.column(name)),
                     trial.time_s, values.channels[c], lag));
    }
    const auto column = static_cast<Eigen::Index>(k);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Activation& a = activations[c][static_cast<std::size_t>(i)];
      p.activation(i, column) = a.value;
      p.force_n(i, column) = tension_n(a.value, trial.length_m(i, column),
                                       trial.velocity_mps(i, column), values.muscles[k]);
      if (!with_torque || !(a.value > 0.0)) continue;
      // Force is nearly proportional to activation.
      p.channel_torque_nm(i, static_cast<Eigen::Index>(c)) +=
          trial.moment_arm_m(i, column) * p.force_n(i, column) * a.by_log_envelope / a.value;
    }
  }
  if (with_torque) {
    p.torque_nm =
        trial.moment_arm_m.cwiseProduct(p.force_n).rowwise().sum() + resting_torque_nm(trial);
    const std::vector<std::string> joints = joint_names(data);
    const auto at = static_cast<std::size_t>(std::find(joints.begin(), joints.end(), trial.joint) -
                                             joints.begin());
    if (at < values.joints.size()) {
      const JointValues& joint = values.joints[at];
      p.torque_nm.array() += joint[kOffset];
      if (trial.angle_rad.size() == n && trial.velocity_radps.size() == n &&
          trial.acceleration_radps2.size() == n) {
        p.torque_nm -= joint[kViscosity] * trial.velocity_radps +
                       joint[kInertia] * trial.acceleration_radps2 +
                       joint[kStiffness] * trial.angle_rad;
      }
    }
  }
  return p;
}

FittedPrediction predict(const StudyData& data,
                         const TrialData& trial,
                         const IdentificationResult& fit,
                         double envelope_cutoff_hz) {
  FittedPrediction result{predict(data, trial, fit.values, fit.lag), {}};
  const Eigen::MatrixXd& torque = result.of.channel_torque_nm;
  EnvelopeNoise noise{.cutoff_hz = envelope_cutoff_hz};
  if (torque.cols() == fit.envelope_variance.size() && torque.rows() > 0) {
    const Eigen::VectorXd variance_nm2 =
        torque.cwiseAbs2().colwise().mean().transpose().cwiseProduct(fit.envelope_variance);
    noise.variance_nm2 = variance_nm2.sum();
    // Channels may lag differently: take the channel with the most noise.
    Eigen::Index loudest = 0;
    variance_nm2.maxCoeff(&loudest);
    noise.lag_s = lag_times_s(fit.values.channels[static_cast<std::size_t>(loudest)], fit.lag);
  }
  result.smooth = smooth_prediction(trial.time_s, result.of.torque_nm, noise);
  return result;
}

IdentificationResult identify_torque(const StudyData& data, const TorqueOptions& options) {
  if (options.estimator == EstimatorKind::posterior && !options.measured_is_force) {
    IdentificationResult result = identify_by_posterior(data, options);
    if (options.predictions) add_predictions(data, options, result);
    return result;
  }
  validate(data);
  const auto begin = std::chrono::steady_clock::now();
  const Estimator estimator(data, options);
  const Eigen::VectorXd start = estimator.model().parameters().start();
  std::vector<BasinTable> tables;
  const Estimator::Solution by_delay = best_solution(estimator, start, tables);
  const double delay_s =
      estimator.model().parameters().values(by_delay.search.x).channels.front()[kDelay];
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
  const Estimator::Solution by_lags =
      options.multistart < 2 ? lagging.solve(by_delay.search.x)
                             : best_solution(lagging, by_delay.search.x, tables_of_lags);
  const double gain = preference_for_lags(estimator, by_delay, lagging, by_lags);
  const bool lags = gain > 0.0 && by_lags.search.termination == math::Termination::converged;
  IdentificationResult result =
      lags ? finish(lagging, by_lags, data, begin) : finish(estimator, by_delay, data, begin);
  result.basins = std::move(lags ? tables_of_lags : tables);
  result.shared_lag_gain = gain;
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
  StudyData freed = data;
  free_speeds(freed, speed_may_be_free);
  for (const StudyData* study : {&data, static_cast<const StudyData*>(&freed)}) {
    if (study == &freed && speed_may_be_free.empty()) break;
    const Estimator estimator(*study, plain);
    const std::optional<Estimator::Solution> found = noise_free_solution(*study, estimator);
    if (!found) continue;
    IdentificationResult result = finish(estimator, *found, *study, begin);
    result.exact = true;
    if (options.multistart > 1)
      result.basins.push_back(find_basins(estimator, found->weighting, options.multistart));
    return result;
  }
  return identify_torque(freed, options);
}

}  // namespace myoid::identification
