#include "myoid/design/posterior_information.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <Eigen/Cholesky>

#include "myoid/beliefs/beliefs.h"
#include "myoid/identification/residual_model.h"
#include "myoid/math/random.h"
#include "myoid/posterior/density.h"

namespace myoid {

using identification::EnvelopeError;
using identification::EstimatorOptions;
using identification::Likelihood;
using identification::StudyData;
using identification::TrialData;

namespace {

/// Returns the trial with the noise of rectified EMG behind the filter of the envelopes.
TrialData with_emg_noise(TrialData trial, const EstimatorOptions& options, double factor, std::uint64_t seed) {
  const Eigen::VectorXd& clock = trial.activation.time_s();
  const double interval_s = (clock[clock.size() - 1] - clock[0]) / static_cast<double>(clock.size() - 1);
  const Eigen::VectorXd filter = EnvelopeError(options.envelope_cutoff_hz, {}).from_white(interval_s);
  Eigen::MatrixXd noisy = trial.activation.values();
  for (Eigen::Index c = 0; c < noisy.cols(); ++c) {
    const std::string& channel = trial.activation.channels()[static_cast<std::size_t>(c)].name;
    math::Random random(math::seed_for(seed, "noise of " + channel));
    const Eigen::VectorXd white = random.normals(noisy.rows() + filter.size() - 1);
    const double sd = factor * identification::envelope_spread(options, channel);
    for (Eigen::Index i = 0; i < noisy.rows(); ++i)
      noisy(i, c) *= std::max(0.0, 1.0 + sd * filter.dot(white.segment(i, filter.size())));
  }
  trial.activation = TimeSeries(clock, trial.activation.channels(), std::move(noisy));
  return trial;
}

}  // namespace

PosteriorInformation::PosteriorInformation(StudyData muscles,
                                           std::vector<TrialData> session,
                                           EstimatorOptions options,
                                           const PlannedErrors& errors,
                                           identification::Believed believed)
    : muscles_(std::move(muscles)), options_(std::move(options)), emg_factor_(errors.emg_factor), believed_(believed) {
  // A movement is one trial, whose factor b of the torque's error is 1.
  noise_.setZero(identification::kNoiseFieldCount + 1);
  noise_[identification::kTorqueSd] = std::log(errors.torque_sd_nm);
  noise_[identification::kTorqueTime] = std::log(identification::beliefs::kTorqueNoiseTime.value);
  noise_[identification::kEmgFactor] = std::log(std::max(errors.emg_factor, 1e-3));
  noise_[identification::kModelErrorSize] = std::log(std::max(errors.model_error, 1e-3));
  StudyData all = muscles_;
  all.trials = std::move(session);
  const Likelihood likelihood(all, options_);
  session_ = likelihood.recorded();
  for (const identification::UnseenQuantity& quantity : likelihood.unseen().quantities)
    quantities_.push_back(quantity.name);
}

Eigen::MatrixXd PosteriorInformation::of(const TrialData& trial, const Eigen::VectorXd& z, std::uint64_t seed) const {
  StudyData one = muscles_;
  one.trials = {with_emg_noise(trial, options_, emg_factor_, seed)};
  Likelihood likelihood(one, options_, &session_);
  likelihood.believe(believed_);
  likelihood.refer_to(z);
  return likelihood.information_by_trial(z, noise_).front();
}

void join_strengths(const std::vector<identification::Unknown>& free, double strength_sd, Knowledge& known) {
  Eigen::MatrixXd precision = identification::prior_precision(free, strength_sd);
  for (Eigen::Index j = 0; j < precision.rows(); ++j) {
    if (!(precision(j, j) > 0.0)) precision(j, j) = known.precision(j, j);
  }
  known.precision = precision;
  known.covariance = precision.llt().solve(Eigen::MatrixXd::Identity(precision.rows(), precision.cols()));
}

}  // namespace myoid
