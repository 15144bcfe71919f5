#include "myoid/fit/methods/prediction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "myoid/fit/measurement/envelope.h"
#include "myoid/fit/measurement/muscle_activation.h"
#include "myoid/fit/posterior/likelihood.h"
#include "myoid/fit/posterior/trial_run.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::fit {

EstimatorOptions beginning_at(const IdentificationResult& fit, EstimatorOptions options) {
  if (fit.noise.size() > 0) options.begin_at = std::make_shared<const FittedUnknowns>(fit);
  return options;
}

Prediction predict(const StudyData& data,
                   const TrialData& trial,
                   const std::vector<muscle::HillParameters<double>>& muscles,
                   double delay_s,
                   EmgLag lag) {
  ChannelValues as_it_is{};
  as_it_is[kDelay] = delay_s;
  as_it_is[kGain] = as_it_is[kExponent] = 1.0;
  ModelValues values{.muscles = {}, .channels = {muscles.size(), as_it_is}, .joints = {}};
  for (const muscle::HillParameters<double>& muscle : muscles) values.muscles.push_back(muscle_values(muscle));
  return predict(data, trial, values, lag);
}

Prediction predict(const StudyData& data, const TrialData& trial, const ModelValues& values, EmgLag lag) {
  const Eigen::Index n = trial.time_s.size();
  Prediction p;
  p.force_n.resize(n, trial.length_m.cols());
  p.activation.resize(n, trial.length_m.cols());
  const bool with_torque = trial.moment_arm_m.rows() == n;
  std::vector<std::string> channels;
  std::vector<std::vector<Activation>> activations;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const std::string& name = data.muscles[k].emg_channel;
    auto it = std::find(channels.begin(), channels.end(), name);
    const auto c = static_cast<std::size_t>(it - channels.begin());
    if (it == channels.end()) {
      channels.push_back(name);
      activations.push_back(activation(Envelope(trial.activation.time_s(), trial.activation.column(name)), trial.time_s,
                                       values.channels[c], lag));
    }
    const auto column = static_cast<Eigen::Index>(k);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Activation& a = activations[c][static_cast<std::size_t>(i)];
      p.activation(i, column) = a.value;
      p.force_n(i, column) =
          tension_n(a.value, trial.length_m(i, column), trial.velocity_mps(i, column), values.muscles[k]);
    }
  }
  if (with_torque) {
    p.torque_nm = trial.moment_arm_m.cwiseProduct(p.force_n).rowwise().sum() + resting_torque_nm(trial);
    const std::vector<std::string> joints = joint_names(data);
    const auto at = static_cast<std::size_t>(std::find(joints.begin(), joints.end(), trial.joint) - joints.begin());
    if (at < values.joints.size()) {
      const JointValues& joint = values.joints[at];
      p.torque_nm.array() += joint[kOffset];
      if (const Eigen::MatrixXd motion = motion_of(trial, n); motion.size() > 0)
        p.torque_nm -=
            joint[kViscosity] * motion.col(1) + joint[kInertia] * motion.col(2) + joint[kStiffness] * motion.col(0);
    }
  }
  return p;
}

namespace {

/// Returns the options of a fit's predictions: its lag, and its answer as the reference of the unseen quantities.
EstimatorOptions of_predictions(EstimatorOptions options, const IdentificationResult& fit) {
  options.law = fit.lag;
  options.progress = {};
  return beginning_at(fit, std::move(options));
}

/// Returns diag(J C J'), J n x p.
Eigen::VectorXd variance_by(const Eigen::MatrixXd& jacobian, const Eigen::MatrixXd& covariance) {
  return (jacobian * covariance).cwiseProduct(jacobian).rowwise().sum().cwiseMax(0.0);
}

}  // namespace

/// Scores the predicted fiber lengths of a run, all samples of the trial, outside of what the study excludes.
FiberScores score_fibers(const StudyData& data, const TrialData& trial, const TrialRun& run, const Eigen::VectorXd& m) {
  FiberScores scores;
  const Eigen::Index n = trial.time_s.size();
  for (std::size_t i = 0; i < run.fascicles.size(); ++i) {
    FiberScore& of = scores.fibers.emplace_back(FiberScore{.muscle = data.muscles[run.fascicles[i]].name});
    for (const Eigen::Index row : included_rows(trial)) {
      const double off = m[static_cast<Eigen::Index>(i) * n + row] -
                         trial.fascicle_m(row, static_cast<Eigen::Index>(run.fascicles[i]));
      if (!std::isfinite(off)) continue;
      of.n += 1.0;
      of.sse_m2 += off * off;
    }
  }
  return scores;
}

/// The posterior at the fit's values, given the torque of the fitted trials.
struct TrialPredictions::ByPosterior {
  ByPosterior(const StudyData& data, const EstimatorOptions& of_fit, const IdentificationResult& fit)
      : options(of_predictions(of_fit, fit)), likelihood(data, options, Columns::at_reference) {
    if (likelihood.parameters().size() != fit.solution.size())
      throw std::logic_error("a fit predicts by other unknowns than its own");
    if (fit.noise.size() < kNoiseFieldCount)
      throw InvalidInput("the fit has {} sizes of its errors, at least {} belong to it; run the study again",
                         fit.noise.size(), static_cast<int>(kNoiseFieldCount));
    likelihood.refer_to(fit.solution);  // nothing to do where the search of the options begins there
    unseen = likelihood.unseen_given(fit.solution, fit.noise);
  }

  EstimatorOptions options;
  Likelihood likelihood;
  Likelihood::UnseenGiven unseen;
};

TrialPredictions::TrialPredictions(const StudyData& data,
                                   const EstimatorOptions& options,
                                   const IdentificationResult& fit)
    : data_(data), fit_(fit), residual_cutoff_hz_(options.residual_cutoff_hz.value_or(0.0)) {
  if (fit.noise.size() > 0) by_posterior_ = std::make_unique<ByPosterior>(data, options, fit);
}
TrialPredictions::~TrialPredictions() = default;

TrialFit TrialPredictions::of(const TrialData& trial) const {
  TrialFit found = unfitted_trial(trial);
  if (by_posterior_) {
    const ByPosterior& by = *by_posterior_;
    const TrialRun run = whole_run(trial, data_, by.options, by.likelihood.parameters());
    const Likelihood::RunForecast forecast = by.likelihood.forecast(run, fit_.solution, fit_.noise, by.unseen);
    const Eigen::MatrixXd& covariance = fit_.covariance;
    found.torque_fit_nm = forecast.mean_nm;
    found.torque_sd_nm = (forecast.variance_nm2 + variance_by(forecast.by_z, covariance)).cwiseSqrt();
    found.force_fit_n = forecast.force_n;
    found.add(score_fibers(data_, trial, run, forecast.fiber_m));
    found.drive = drives(run, by.likelihood.parameters().channels());
    found.force_sd_n.resizeLike(forecast.force_n);
    for (std::size_t k = 0; k < forecast.force_by_z.size(); ++k)
      found.force_sd_n.col(static_cast<Eigen::Index>(k)) = variance_by(forecast.force_by_z[k], covariance).cwiseSqrt();
  } else {
    Prediction predicted = predict(data_, trial, fit_.values, fit_.lag);
    found.force_fit_n = std::move(predicted.force_n);
    found.torque_fit_nm = std::move(predicted.torque_nm);
  }
  if (found.torque_fit_nm.size() == trial.torque_nm.size()) {
    const std::vector<Eigen::Index> rows = included_rows(trial);
    found.score = score(trial.torque_nm(rows), found.torque_fit_nm(rows));
    found.band = score(below(trial.time_s, trial.torque_nm, residual_cutoff_hz_)(rows),
                       below(trial.time_s, found.torque_fit_nm, residual_cutoff_hz_)(rows));
  }
  return found;
}

double covered_share(const Eigen::VectorXd& measured_nm,
                     const Eigen::VectorXd& predicted_nm,
                     const Eigen::VectorXd& sd_nm) {
  if (sd_nm.size() == 0 || sd_nm.size() != measured_nm.size()) return std::numeric_limits<double>::quiet_NaN();
  const Eigen::ArrayXd off = (measured_nm - predicted_nm).array().abs();
  return static_cast<double>((off <= math::normal_quantile(0.975) * sd_nm.array()).count()) /
         static_cast<double>(sd_nm.size());
}

TrialFit unfitted_trial(const TrialData& trial) {
  TrialFit fit;
  fit.trial = trial.name;
  fit.joint = trial.joint;
  fit.calibration = trial.calibration;
  fit.time_s = trial.time_s;
  fit.torque_nm = trial.torque_nm;
  return fit;
}

void add_torques_of_forces(const TrialData& trial, TrialFit& fit) {
  if (trial.moment_arm_m.rows() != trial.time_s.size()) return;
  const Eigen::VectorXd resting = resting_torque_nm(trial);
  fit.literature_torque_nm = trial.moment_arm_m.cwiseProduct(fit.literature_force_n).rowwise().sum() + resting;
  fit.torque_fit_nm = trial.moment_arm_m.cwiseProduct(fit.force_fit_n).rowwise().sum() + resting;
}

}  // namespace myoid::fit
