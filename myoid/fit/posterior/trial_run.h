#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/envelope.h"
#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/measurement/reduction.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/fit/posterior/noise_model.h"
#include "myoid/ground/core/time_series.h"

namespace myoid::fit {

/// A stretch of one calibration trial without a gap, n even samples, and its measured torques behind L. Quantities of
/// the J joints stand joint after joint: n J rows, or m J behind L. Trials longer than 8 s are cut into runs of equal
/// length. The errors of different runs count as independent except for the person's own (unseen.h): 8 s are many times
/// the errors' memory, and the work grows with the square of a run's length.
struct TrialRun {
  int trial = 0;  ///< Index in StudyData::trials.
  /// Place of the run's middle in the session: 0 at the maximal contractions, else at the begin; 1 is the whole length.
  double session = 0.0;
  std::vector<int> joints;              ///< J indices in ParameterMap::joints().
  Eigen::VectorXd time_s;               ///< n
  Eigen::MatrixXd length_m;             ///< n x muscles, musculotendon length.
  Eigen::MatrixXd velocity_mps;         ///< n x muscles
  Eigen::MatrixXd arm_m{};              ///< n J x muscles
  Eigen::MatrixXd motion{};             ///< n J x 3: angle, rate, acceleration; 0 where not known.
  Eigen::VectorXd resting_nm{};         ///< n J: measured passive torque of the joint, or 0.
  Eigen::VectorXd dynamics_nm{};        ///< n J: of JointData; empty: no dynamometer.
  std::vector<Envelope> envelopes{};    ///< Per EMG channel: the drive (drive.h).
  std::vector<EnvelopeError> errors{};  ///< Per EMG channel: the envelope's error.
  /// Per EMG channel: relative sd of rectified EMG behind its filter, or UnseenActivation::sd.
  Eigen::VectorXd envelope_sd{};
  std::vector<std::vector<Envelope>> parts{};  ///< Per EMG channel: UnseenActivation::parts; empty: measured.
  Eigen::VectorXd rest{};                      ///< Per EMG channel: resting over full level, 0 where not known.
  double interval_s = 0.0;
  Reduction reduction;
  Eigen::VectorXd measured_nm{};         ///< m J: L y.
  std::vector<std::size_t> fascicles{};  ///< K muscles with measured fiber lengths.
  Eigen::VectorXd measured_m{};          ///< m K: these lengths behind L; NaN where L meets an absent one.

  /// Returns the first row of the run's j-th joint among the n J rows.
  [[nodiscard]] Eigen::Index first_row(std::size_t j) const { return static_cast<Eigen::Index>(j) * time_s.size(); }
  [[nodiscard]] Eigen::Index row_count() const { return first_row(joints.size()); }
  /// Returns the first row of the k-th of `fascicles`, whose rows stand behind those of all joints.
  [[nodiscard]] Eigen::Index first_row_of_fascicle(std::size_t k) const { return first_row(joints.size() + k); }
  /// Number of rows of joints and fascicles, n (J + K).
  [[nodiscard]] Eigen::Index all_rows() const { return first_row_of_fascicle(fascicles.size()); }
  /// Number of measured values behind L, m (J + K).
  [[nodiscard]] Eigen::Index measured_count() const { return measured_nm.size() + measured_m.size(); }
};

/// Returns all runs of the calibration trials, of their `fitted_stretches` at EstimatorOptions::max_rate_hz, in order.
/// Throws InvalidInput if no run is left.
[[nodiscard]] std::vector<TrialRun> trial_runs(const StudyData& data,
                                               const EstimatorOptions& options,
                                               const ParameterMap& map);

/// Returns all samples of a trial as one run, for prediction. Its place in the session is that of
/// the trial of the same name in `data`, or the session's end if there is none.
[[nodiscard]] TrialRun whole_run(const TrialData& trial,
                                 const StudyData& data,
                                 const EstimatorOptions& options,
                                 const ParameterMap& map);

/// Returns the drives of a run on the finest clock among them, each under its channel's name.
[[nodiscard]] TimeSeries drives(const TrialRun& run, const std::vector<std::string>& channels);

}  // namespace myoid::fit
