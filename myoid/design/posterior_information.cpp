#include "myoid/design/posterior_information.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "myoid/beliefs/beliefs.h"
#include "myoid/posterior/density.h"
#include "myoid/posterior/drive.h"

namespace myoid {

using identification::EstimatorOptions;
using identification::Likelihood;
using identification::StudyData;
using identification::TrialData;

PosteriorInformation::PosteriorInformation(StudyData muscles,
                                           std::vector<TrialData> session,
                                           EstimatorOptions options,
                                           const PlannedErrors& errors,
                                           identification::Believed believed)
    : muscles_(std::move(muscles)), options_(std::move(options)), believed_(believed) {
  options_.drives = std::make_shared<identification::DriveMemory>(errors.emg_factor * errors.emg_factor);
  // A movement is one trial, whose factor b of the torque's error is 1.
  noise_.setZero(identification::kNoiseFieldCount + 1);
  noise_[identification::kTorqueSd] = std::log(errors.torque_sd_nm);
  noise_[identification::kTorqueTime] = std::log(identification::beliefs::kTorqueNoiseTime.value);
  noise_[identification::kEmgFactor] = std::log(std::max(errors.emg_factor, 1e-3));
  noise_[identification::kModelErrorSize] = std::log(std::max(errors.model_error, 1e-3));
  StudyData all = muscles_;
  all.trials = std::move(session);
  const Likelihood likelihood(all, options_, identification::Columns::at_reference);
  for (const identification::Unknown& unknown : likelihood.parameters().free()) unknowns_.push_back(unknown.label);
  session_ = likelihood.recorded();
  for (const identification::UnseenQuantity& quantity : likelihood.unseen().quantities)
    quantities_.push_back(quantity.name);
}

Eigen::MatrixXd PosteriorInformation::of(const TrialData& trial, const Eigen::VectorXd& z) const {
  StudyData one = muscles_;
  one.trials = {trial};
  EstimatorOptions at = options_;
  at.begin_at = std::make_shared<const identification::FittedUnknowns>(
      identification::FittedUnknowns{.free_parameters = unknowns_, .solution = z, .lag = at.law});
  Likelihood likelihood(one, at, identification::Columns::at_reference, &session_);
  likelihood.believe(believed_);
  return likelihood.information_by_trial(z, noise_).front();
}

}  // namespace myoid
