#include "myoid/fit/methods/force.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/intervals/verdicts.h"
#include "myoid/fit/measurement/nuisances.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/methods/torque.h"
#include "myoid/ground/core/error.h"

namespace myoid::fit {

StudyData force_study(const StudyData& data, std::size_t muscle) {
  const auto column = static_cast<Eigen::Index>(muscle);
  StudyData one;
  one.muscles.push_back(data.muscles[muscle]);
  for (const TrialData& trial : data.trials) {
    if (trial.force_n.rows() != trial.time_s.size()) {
      throw InvalidInput(fmt::format(
          "method force: trial '{}' has no muscle forces; measure them, or share the torque first (myoid so)",
          trial.name));
    }
    TrialData t;
    t.name = trial.name;
    t.calibration = trial.calibration;
    t.condition = trial.condition;
    t.joint = data.muscles[muscle].name;
    t.time_s = trial.time_s;
    t.length_m = trial.length_m.col(column);
    t.velocity_mps = trial.velocity_mps.col(column);
    t.moment_arm_m = Eigen::MatrixXd::Ones(trial.time_s.size(), 1);
    t.torque_nm = trial.force_n.col(column);
    t.force_n = trial.force_n.col(column);
    if (trial.fascicle_m.size() > 0) t.fascicle_m = trial.fascicle_m.col(column);
    t.activation = trial.activation;
    t.excluded = trial.excluded;
    one.trials.push_back(std::move(t));
  }
  for (const ParameterRule& rule : data.rules) {
    const Scope scope = parameter_field(rule.parameter).scope;
    if (scope == Scope::joint) continue;
    ParameterRule kept = rule;
    kept.owners.clear();
    kept.tie = false;
    const std::string& name = scope == Scope::muscle ? one.muscles[0].name : one.muscles[0].emg_channel;
    if (covers(rule.owners, name)) one.rules.push_back(std::move(kept));
  }
  return one;
}

namespace {

/// Returns the options of one muscle's fit. A force has no moment arm that could be wrong, and the electrode is the
/// muscle's own: both are exact. All muscles of one person follow their EMG by the same law, which is not chosen.
EstimatorOptions of_one_force(EstimatorOptions options) {
  options.muscles.clear();
  options.measured_is_force = true;
  options.unseen.moment_arm = options.unseen.moment_arm_slope = options.unseen.crosstalk = 0.0;
  options.choose_lag = false;
  options.progress.report = nullptr;
  return options;
}

/// Holds the nuisances where the trials do not tell them.
void hold_untold(StudyData& one, const EstimatorOptions& once) {
  if (!tells_nuisances(one, once)) hold_nuisances(one);
}

/// Fits one muscle of the study that `force_study` makes.
IdentificationResult identify_muscle_force(StudyData one, const ForceOptions& options) {
  const EstimatorOptions once = of_one_force(options.estimator);
  if (options.detect_exact) {
    if (std::optional<IdentificationResult> exact = identify_exactly(one, once)) return std::move(*exact);
    hold_untold(one, once);
  }
  return identify_torque(one, once);
}

/// Copies the fit of muscle k into the result of all muscles.
void take_over(IdentificationResult fit, const StudyData& data, std::size_t k, IdentificationResult& all) {
  const std::string& name = data.muscles[k].name;
  const auto column = static_cast<Eigen::Index>(k);
  all.muscles[k] = fit.muscles.front();
  all.exact = all.exact && fit.exact;
  all.r2 = std::min(all.r2, fit.r2);
  if (fit.termination != math::Termination::converged) {
    all.termination = fit.termination;
    all.message += fmt::format("{}: {}. ", name, fit.message);
  }
  for (ParameterEstimate& e : fit.estimates) {
    e.method = Method::force;
    if (e.muscle == "subject" || e.muscle == data.muscles[k].emg_channel) e.muscle = name;
  }
  const auto append = [](auto& to, auto& from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  append(all.estimates, fit.estimates);
  append(all.prior_distances, fit.prior_distances);
  append(all.open_sums, fit.open_sums);
  append(all.diagnoses, fit.diagnoses);
  append(all.warnings, fit.warnings);
  all.model_error = std::max(all.model_error, fit.model_error);
  all.samples_used += fit.samples_used;
  all.effective_samples += fit.effective_samples;
  all.iterations += fit.iterations;
  for (std::size_t t = 0; t < all.trials.size() && t < fit.trials.size(); ++t) {
    all.trials[t].literature_force_n.col(column) = fit.trials[t].literature_force_n.col(0);
    all.trials[t].force_fit_n.col(column) = fit.trials[t].force_fit_n.col(0);
  }
}

/// Predicts the forces of muscle k, which is not fitted, by its starting values.
void predict_unfitted(const StudyData& one, std::size_t k, const EstimatorOptions& options, IdentificationResult& all) {
  const auto column = static_cast<Eigen::Index>(k);
  for (std::size_t t = 0; t < one.trials.size(); ++t) {
    const Prediction p = predict(one, one.trials[t], {one.muscles.front().start}, options.usual_delay_s());
    all.trials[t].literature_force_n.col(column) = p.force_n.col(0);
    all.trials[t].force_fit_n.col(column) = p.force_n.col(0);
  }
}

}  // namespace

std::vector<Fold> cross_validate_force(const StudyData& data,
                                       const EstimatorOptions& options,
                                       const CrossValidationOptions& how) {
  const EstimatorOptions once = of_one_force(options);
  std::vector<Fold> folds;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    if (!covers(options.muscles, data.muscles[k].name)) continue;
    StudyData one = force_study(data, k);
    hold_untold(one, once);
    std::vector<Fold> of_one = cross_validate(one, identify_torque, once, how);
    std::ranges::move(of_one, std::back_inserter(folds));
  }
  return folds;
}

IdentificationResult identify_force(const StudyData& data, const ForceOptions& options) {
  validate(data);
  const auto begin = std::chrono::steady_clock::now();
  IdentificationResult all;
  all.method = Method::force;
  all.termination = math::Termination::converged;
  all.exact = true;
  all.lag = options.estimator.law;
  for (const TrialData& trial : data.trials) {
    TrialFit fit = unfitted_trial(trial);
    fit.literature_force_n = Eigen::MatrixXd::Zero(trial.time_s.size(), trial.length_m.cols());
    fit.force_fit_n = fit.literature_force_n;
    all.trials.push_back(std::move(fit));
  }
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const StudyData one = force_study(data, k);
    all.muscles.push_back(data.muscles[k].start);
    if (covers(options.estimator.muscles, data.muscles[k].name)) {
      take_over(identify_muscle_force(one, options), data, k, all);
    } else {
      predict_unfitted(one, k, options.estimator, all);
    }
  }
  for (std::size_t t = 0; t < data.trials.size(); ++t) {
    const TrialData& trial = data.trials[t];
    TrialFit& fit = all.trials[t];
    if (trial.moment_arm_m.rows() != trial.time_s.size() || trial.torque_nm.size() != trial.time_s.size()) continue;
    add_torques_of_forces(trial, fit);
    const std::vector<Eigen::Index> rows = included_rows(trial);
    const Eigen::VectorXd measured = trial.torque_nm(rows);
    const Eigen::VectorXd predicted = fit.torque_fit_nm(rows);
    fit.score = score(measured, predicted);
  }
  if (options.shared_forces) {
    fit::apply({{.reason = reason_of(Finding::shared_force, {}), .finding = Finding::shared_force}}, all);
    for (ParameterEstimate& e : all.estimates)
      e.std_error = e.ci_low = e.ci_high = e.given_ci_low = e.given_ci_high = std::nullopt;
  }
  all.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return all;
}

}  // namespace myoid::fit
