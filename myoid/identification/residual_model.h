#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/error_shapes.h"
#include "myoid/identification/muscle_rows.h"
#include "myoid/identification/parameters.h"
#include "myoid/identification/residual_block.h"

namespace myoid::identification {

/// Relative spread that an envelope has where no noise of the electrode matters: that of rectified
/// Gaussian noise of the EMG's bandwidth over the time that the filters average (0.4815 / cut-off
/// of two passes of second order). Where the bandwidth is not known, as of 150 Hz.
[[nodiscard]] double envelope_spread(const EstimatorOptions& options, const std::string& channel);

/// Consecutive rows of the residual: one joint of one trial.
struct Piece {
  int trial = 0;  ///< In StudyData::trials.
  int joint = 0;
  Eigen::Index first = 0, count = 0;
};

/// The model's prediction at one point of the search; rows as in the pieces.
struct Evaluation {
  Eigen::VectorXd predicted;   ///< Low-passed as `measured()`.
  Eigen::MatrixXd gradient;    ///< p x n: column i is d predicted_i / dz.
  Eigen::MatrixXd unfiltered;  ///< p x n: the gradient before it is low-passed.
  /// C x n: the factor of the relative spread of each channel's rectified EMG, not low-passed. The
  /// noise behind a low-pass goes with the mean square of the factor, not with its squared mean.
  Eigen::MatrixXd channel_torque;
  Eigen::VectorXd motion_variance;  ///< n: from the errors of angle and rate.
};

/// The slopes of a cost by the model's prediction; rows as in the pieces.
struct PullBack {
  Eigen::VectorXd predicted;       ///< As Evaluation::predicted.
  Eigen::MatrixXd channel_torque;  ///< As Evaluation::channel_torque; in its place come weights.
  Eigen::VectorXd by_predicted;    ///< d cost / d predicted.
};

/// The one residual of all estimators: predicted minus measured torque (or force: one muscle with a
/// moment arm of 1) over the samples of the calibration trials, thinned and low-passed.
class ResidualModel {
 public:
  ResidualModel(const StudyData& data, const EstimatorOptions& options);

  [[nodiscard]] const ParameterMap& parameters() const { return map_; }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] std::vector<Eigen::Index> piece_lengths() const;
  [[nodiscard]] std::vector<Eigen::Index> rows_of_joint(int joint) const;
  [[nodiscard]] Eigen::Index sample_count() const { return measured_.size(); }
  [[nodiscard]] const Eigen::VectorXd& measured() const { return measured_; }
  [[nodiscard]] double rate_hz() const { return rate_hz_; }
  [[nodiscard]] int dropped() const { return dropped_; }
  /// EMG channel on which a variable acts alone; -1: several, or none.
  [[nodiscard]] int channel_of_variable(Eigen::Index j) const {
    return channel_of_variable_[static_cast<std::size_t>(j)];
  }
  /// noise_gain of every EMG channel (C x n), one number for each run of samples.
  [[nodiscard]] const Eigen::MatrixXd& noise_gain() const { return noise_gain_; }
  [[nodiscard]] int joint_count() const { return static_cast<int>(map_.joints().size()); }

  /// The filled part of an Evaluation: prediction and torque of the channels; also the gradient;
  /// also the variance from motion.
  enum class Depth { value, gradient, noise };
  void evaluate(const Eigen::VectorXd& z, Depth depth, Evaluation& out) const;

  /// Computes two products with Evaluation's matrices without the matrices, in half of the time:
  /// `by_prediction` = gradient * by_predicted and, for a variable j with a channel c of its own,
  /// `by_channel`[j] = the sum over i of unfiltered(j, i) * channel_torque(c, i), else 0; p each.
  /// `weigh(piece, rows)` is called once for each of `pieces()`, from several threads: it reads
  /// `predicted` and `channel_torque` of the piece's rows, sets their `by_predicted` and puts the
  /// weights in the place of the torques.
  void pull_back(const Eigen::VectorXd& z,
                 const std::function<void(std::size_t piece, PullBack& rows)>& weigh,
                 Eigen::VectorXd& by_prediction,
                 Eigen::VectorXd& by_channel) const;

  /// For each muscle its torque times 1, the Legendre polynomials P1 to P3 of its length over the
  /// recorded range, ln(activation) / 2.3 + 1 (a non-linear EMG), its speed over the greatest, and
  /// its change within 0.15 s (a delay of its own);
  /// for each joint 1 and P1 of the first muscle's length, of the size of the torque (what is
  /// passive). What moment arms, force-length curves, tendons, passive tissue, EMG that is not
  /// linear and motion under the skin do wrong is smooth in these. What the fit finds as a number
  /// of its own weighs nothing, lest it counts twice: 1 where the gain of the muscle's own
  /// electrode is an unknown (or F_max, of a force that was measured: no moment arm is between),
  /// ln(activation) where its exponent or shape, the lag where a delay of its own, 1 and P1 of a
  /// joint where its offset and its stiffness.
  [[nodiscard]] ErrorShapes error_shapes(const Eigen::VectorXd& z) const;

 private:
  using Block = ResidualBlock;
  void add_trial(const StudyData& data, int trial, const EstimatorOptions& options);
  void add_block(const StudyData& data,
                 int trial,
                 const std::vector<Eigen::Index>& rows,
                 const EstimatorOptions& options);
  /// Adds a joint's rows to the block, and to the measured torques.
  struct JointRecording;
  void add_joint(Block& block, const JointRecording& of, const std::vector<Eigen::Index>& rows);
  struct Chains;
  [[nodiscard]] Chains chains_by_owner(const std::vector<ParameterMap::Chain>& chains) const;
  /// Workspace of the calling thread: good until its next call.
  [[nodiscard]] const std::vector<MuscleRows>& evaluate_muscles(const Block& block,
                                                                const ModelValues& values,
                                                                const Chains& chains) const;
  void add_torques(const Block& block,
                   const ModelValues& values,
                   const std::vector<MuscleRows>& muscles,
                   Eigen::VectorXd& predicted,
                   Eigen::MatrixXd& channel_torque) const;
  void add_gradient(const Block& block,
                    const std::vector<MuscleRows>& muscles,
                    const Chains& chains,
                    Evaluation& out) const;
  void add_motion_variance(const Block& block,
                           const std::vector<MuscleRows>& muscles,
                           Evaluation& out) const;
  void for_each_block(const std::function<void(std::size_t)>& one) const;

  ParameterMap map_;
  std::vector<Block> blocks_;
  std::vector<Piece> pieces_;
  Eigen::VectorXd measured_;
  Eigen::MatrixXd noise_gain_;
  std::vector<int> channel_of_variable_;
  EmgLag lag_ = EmgLag::delay;
  bool measured_is_force_ = false;
  double angle_sd_rad_ = 0.0, angle_rate_sd_radps_ = 0.0;
  double rate_hz_ = 0.0;
  int dropped_ = 0;
};

}  // namespace myoid::identification
