#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/identification/envelope.h"
#include "myoid/identification/parameters.h"
#include "myoid/identification/study_data.h"
#include "myoid/posterior/noise_model.h"
#include "myoid/posterior/reduction.h"

namespace myoid::identification {

/// A stretch of one calibration trial without a hole, n even samples, and its measured torques
/// behind L. What belongs to joints, J of them, stands joint after joint: n J rows, or m J behind
/// L. Trials longer than 8 s are cut into runs of equal length, whose errors count as
/// independent but for those that are the person's (unseen.h): 8 s are many times as long as the
/// errors' memory, and the work grows with the square of a run.
struct TrialRun {
  int trial = 0;                      ///< In StudyData::trials.
  double session = 0.0;               ///< Place of its middle in the session, -1/2 to 1/2.
  std::vector<int> joints;            ///< J: in ParameterMap::joints().
  Eigen::VectorXd time_s;             ///< n
  Eigen::MatrixXd length_m;           ///< n x muscles, musculotendon length.
  Eigen::MatrixXd velocity_mps;       ///< n x muscles
  Eigen::MatrixXd arm_m;              ///< n J x muscles
  Eigen::MatrixXd motion;             ///< n J x 3: angle, rate, acceleration; 0 where not known.
  Eigen::VectorXd resting_nm;         ///< n J: what a joint was measured to make by itself, or 0.
  std::vector<Envelope> envelopes;    ///< Per EMG channel: of the drive (drive.h).
  std::vector<EnvelopeError> errors;  ///< Per EMG channel: of the envelope.
  Eigen::VectorXd
      envelope_sd;       ///< Per EMG channel: relative sd of rectified EMG behind its filter.
  Eigen::VectorXd rest;  ///< Per EMG channel: resting over full level, 0 where not known.
  double interval_s = 0.0;
  Reduction reduction;
  Eigen::VectorXd measured_nm;  ///< m J: L y.

  /// First row of the run's j-th joint among the n J.
  [[nodiscard]] Eigen::Index first_row(std::size_t j) const {
    return static_cast<Eigen::Index>(j) * time_s.size();
  }
  [[nodiscard]] Eigen::Index row_count() const { return first_row(joints.size()); }
};

/// All runs of the calibration trials, thinned to EstimatorOptions::max_rate_hz, in order. The ends
/// of a trial are left out, where splines and filters are unreliable and the EMG must reach back by
/// the delay. Throws InvalidInput where nothing is left.
[[nodiscard]] std::vector<TrialRun> trial_runs(const StudyData& data,
                                               const EstimatorOptions& options,
                                               const ParameterMap& map);

/// All samples of a trial as one run, to predict it. It stands in the session where the trial of
/// its name stands in `data`; at its end without one.
[[nodiscard]] TrialRun whole_run(const TrialData& trial,
                                 const StudyData& data,
                                 const EstimatorOptions& options,
                                 const ParameterMap& map);

}  // namespace myoid::identification
