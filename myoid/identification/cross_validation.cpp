#include "myoid/identification/cross_validation.h"

#include <algorithm>
#include <cmath>

#include <oneapi/tbb/parallel_for.h>

namespace myoid::identification {

Score score(const Eigen::VectorXd& measured, const Eigen::VectorXd& predicted) {
  Score s;
  const Eigen::VectorXd error = predicted - measured;
  s.rmse_nm = std::sqrt(error.squaredNorm() / static_cast<double>(measured.size()));
  const double range = measured.maxCoeff() - measured.minCoeff();
  s.nrmse_range = range > 0.0 ? s.rmse_nm / range : 0.0;
  s.r2 = coefficient_of_determination(measured, predicted);
  const double variance = (measured.array() - measured.mean()).square().sum();
  s.vaf = variance > 0.0 ? 1.0 - (error.array() - error.mean()).square().sum() / variance : 0.0;
  return s;
}

std::vector<Fold> cross_validate(const StudyData& data, const TorqueOptions& options) {
  std::vector<std::size_t> held;
  for (std::size_t i = 0; i < data.trials.size(); ++i) {
    if (data.trials[i].calibration) held.push_back(i);
  }
  if (held.size() < 2) return {};
  std::vector<muscle::HillParameters<double>> literature;
  for (const MuscleSetup& setup : data.muscles) literature.push_back(setup.start);
  const double literature_delay = options.delay_s.value_or(options.delay_prior_mean_s);
  std::vector<Fold> folds(held.size());
  oneapi::tbb::parallel_for(std::size_t{0}, held.size(), [&](std::size_t f) {
    StudyData training = data;
    training.trials[held[f]].calibration = false;
    TorqueOptions once = options;
    once.starts = 1;
    once.passes =
        once.warm_start.size() > 0 ? 2 : once.passes;  // the noise hardly changes with one trial
    once.progress.report = nullptr;
    const IdentificationResult fit = identify_torque(training, once);
    const TrialData& trial = data.trials[held[f]];
    Fold& fold = folds[f];
    fold.trial = trial.name;
    fold.time_s = trial.time_s;
    fold.measured_nm = trial.torque_nm;
    fold.predicted_nm = predict(data, trial, fit.muscles, fit.delay_s).torque_nm;
    // One gain for the literature's muscles, and the mean, from the other trials.
    double product = 0.0;
    double square = 0.0;
    double sum = 0.0;
    double count = 0.0;
    for (const std::size_t other : held) {
      if (other == held[f]) continue;
      const TrialData& t = data.trials[other];
      const Eigen::VectorXd torque = predict(data, t, literature, literature_delay).torque_nm;
      product += torque.dot(t.torque_nm);
      square += torque.squaredNorm();
      sum += t.torque_nm.sum();
      count += static_cast<double>(t.torque_nm.size());
    }
    fold.gain = square > 0.0 ? product / square : 0.0;
    fold.literature_nm = fold.gain * predict(data, trial, literature, literature_delay).torque_nm;
    fold.identified = score(fold.measured_nm, fold.predicted_nm);
    fold.literature = score(fold.measured_nm, fold.literature_nm);
    fold.constant =
        score(fold.measured_nm, Eigen::VectorXd::Constant(fold.measured_nm.size(), sum / count));
  });
  return folds;
}

}  // namespace myoid::identification
