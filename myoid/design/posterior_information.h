#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/design/design_knowledge.h"
#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/posterior/likelihood.h"

namespace myoid {

/// The errors of a recording that is planned.
struct PlannedErrors {
  double torque_sd_nm = 0.3;
  double emg_factor = 1.0;   ///< Noise of the envelopes over that of their bandwidth.
  double model_error = 0.0;  ///< Relative size s.
};

/// What a movement tells of the unknowns z and of the unseen quantities x, by the likelihood of the
/// estimator `posterior`.
///
///   M = [L J, L S W]' A^-1 [L J, L S W],   unknowns and quantities, square
///
/// A is the covariance of the run's own errors (Likelihood). Movements of one person have x in
/// common: their M add, and beside the priors of z each x has a precision of 1. The covariance of z
/// is a block of the inverse.
class PosteriorInformation {
 public:
  /// `session` are the movements that there are, of a person of the starting values: what is
  /// relative to a muscle's recorded lengths is relative to theirs. `believed` geometry and scales
  /// that are exact weigh nothing.
  PosteriorInformation(identification::StudyData muscles,
                       std::vector<identification::TrialData> session,
                       identification::EstimatorOptions options,
                       const PlannedErrors& errors,
                       identification::Believed believed);

  /// Names of x.
  [[nodiscard]] const std::vector<std::string>& quantities() const { return quantities_; }
  /// M of a trial without noise of a person with these unknowns. The noise of its envelopes, drawn
  /// by `seed`, is added: the estimator smooths an envelope by as much as it finds of it.
  [[nodiscard]] Eigen::MatrixXd of(const identification::TrialData& trial,
                                   const Eigen::VectorXd& z,
                                   std::uint64_t seed) const;

 private:
  identification::StudyData muscles_;
  identification::EstimatorOptions options_;
  identification::NoiseValues noise_;
  double emg_factor_ = 1.0;
  identification::Believed believed_;
  identification::Recorded session_;
  std::vector<std::string> quantities_;
};

/// Gives the muscles' F_max the share of their variance that a person's muscles have in common
/// (identification::prior_precision).
void join_strengths(const std::vector<identification::Unknown>& free,
                    double common_share,
                    Knowledge& known);

}  // namespace myoid
