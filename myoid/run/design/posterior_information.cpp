#include "myoid/run/design/posterior_information.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/posterior/density.h"
#include "myoid/fit/posterior/drive.h"

namespace myoid::run {

using fit::EstimatorOptions;
using fit::Likelihood;
using fit::StudyData;
using fit::TrialData;

PosteriorInformation::PosteriorInformation(StudyData muscles,
                                           std::vector<TrialData> session,
                                           EstimatorOptions options,
                                           const PlannedErrors& errors,
                                           fit::Believed believed)
    : muscles_(std::move(muscles)), options_(std::move(options)), believed_(believed) {
  options_.drives = std::make_shared<fit::DriveMemory>(errors.emg_factor * errors.emg_factor);
  // A movement is one trial, whose factor b of the torque's error is 1.
  noise_.setZero(fit::kNoiseFieldCount + 1);
  noise_[fit::kTorqueSd] = std::log(errors.torque_sd_nm);
  noise_[fit::kTorqueTime] = std::log(fit::beliefs::kTorqueNoiseTime.value);
  noise_[fit::kEmgFactor] = std::log(std::max(errors.emg_factor, 1e-3));
  noise_[fit::kModelErrorSize] = std::log(std::max(errors.model_error, 1e-3));
  StudyData all = muscles_;
  all.trials = std::move(session);
  const Likelihood likelihood(all, options_, fit::Columns::at_reference);
  for (const fit::Unknown& unknown : likelihood.parameters().free()) unknowns_.push_back(unknown.label);
  session_ = likelihood.recorded();
  for (const fit::UnseenQuantity& quantity : likelihood.unseen().quantities) quantities_.push_back(quantity.name);
}

Eigen::MatrixXd PosteriorInformation::of(const TrialData& trial, const Eigen::VectorXd& z) const {
  StudyData one = muscles_;
  one.trials = {trial};
  EstimatorOptions at = options_;
  at.begin_at = std::make_shared<const fit::FittedUnknowns>(
      fit::FittedUnknowns{.free_parameters = unknowns_, .solution = z, .lag = at.law});
  Likelihood likelihood(one, at, fit::Columns::at_reference, &session_);
  likelihood.believe(believed_);
  return likelihood.information_by_trial(z, noise_).front();
}

}  // namespace myoid::run
