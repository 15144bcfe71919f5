#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/envelope.h"
#include "myoid/identification/muscle_rows.h"
#include "myoid/identification/parameters.h"
#include "myoid/math/butterworth.h"

namespace myoid::identification {

/// Returns an envelope's relative spread without electrode noise: that of rectified Gaussian noise
/// with the EMG's bandwidth, averaged over the filters' time (0.4815 / cut-off of two passes of
/// second order). An unknown bandwidth counts as 150 Hz.
[[nodiscard]] double envelope_spread(const EstimatorOptions& options, const std::string& channel);

/// A joint of a block. Its n rows of the residual begin at `first`.
struct ResidualJoint {
  int joint = 0;
  std::size_t piece = 0;  ///< Index in ResidualModel::pieces().
  Eigen::Index first = 0;
  Eigen::MatrixXd arm_m;       ///< n x m
  Eigen::MatrixXd motion;      ///< n x 3: angle, rate, acceleration; empty if unknown.
  Eigen::VectorXd resting_nm;  ///< n, or empty: none.
};

/// A gapless, thinned run of samples of one calibration trial: n samples, m muscles.
struct ResidualBlock {
  int trial = 0;
  Eigen::VectorXd time_s;
  Eigen::MatrixXd length_m, velocity_mps;  ///< n x m
  std::vector<Envelope> envelopes;         ///< Per channel.
  Eigen::VectorXd noise_gain;              ///< Per channel.
  std::vector<ResidualJoint> joints;
  std::vector<math::SecondOrderSection> filter;  ///< Empty: the rows are not low-passed.
};

/// Errors of a muscle model as torques: sum_b x_b shape_b(t) with x = contrast D y. The y are independent and have the
/// standard deviation `size`, the relative size of the error; D is the diagonal matrix of `weight`.
struct ErrorShapes {
  Eigen::MatrixXd shapes_nm;   ///< k x n, low-passed as `measured()`.
  Eigen::MatrixXd unfiltered;  ///< k x n, not low-passed.
  Eigen::VectorXd weight;      ///< k
  /// k x k, symmetric: the identity, except for the lags of muscles with one pure delay. For these
  /// only the differences from their mean are errors, because the delay is the mean.
  Eigen::MatrixXd contrast;
  std::vector<int> channel;  ///< k: EMG channel that multiplies the shape; -1: none.
  /// k x k: d shape_b / d ln(envelope) of its channel = sum_j by_emg(b, j) shape_j.
  Eigen::MatrixXd by_emg;
};

/// Consecutive rows of the residual: one joint of one trial.
struct Piece {
  int trial = 0;  ///< Index in StudyData::trials.
  int joint = 0;
  Eigen::Index first = 0, count = 0;
};

/// The model's prediction at one point of the search; rows as in the pieces.
struct Evaluation {
  Eigen::VectorXd predicted;   ///< Low-passed as `measured()`.
  Eigen::MatrixXd gradient;    ///< p x n: column i is d predicted_i / dz.
  Eigen::MatrixXd unfiltered;  ///< p x n: the gradient, not low-passed.
  /// C x n: factor on the relative spread of each channel's rectified EMG, not low-passed. The
  /// noise behind a low-pass varies with the factor's mean square, not with its squared mean.
  Eigen::MatrixXd channel_torque;
  Eigen::VectorXd motion_variance;  ///< n: from the errors of angle and rate.
};

/// Slopes of a cost by the model's prediction; rows as in the pieces.
struct PullBack {
  Eigen::VectorXd predicted;  ///< As Evaluation::predicted.
  /// As Evaluation::channel_torque; `weigh` replaces it by weights.
  Eigen::MatrixXd channel_torque;
  Eigen::VectorXd by_predicted;  ///< d cost / d predicted.
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
  /// Returns the EMG channel on which a variable acts alone; -1: several, or none.
  [[nodiscard]] int channel_of_variable(Eigen::Index j) const {
    return channel_of_variable_[static_cast<std::size_t>(j)];
  }
  /// Returns noise_gain of every EMG channel (C x n), one number per run of samples.
  [[nodiscard]] const Eigen::MatrixXd& noise_gain() const { return noise_gain_; }
  [[nodiscard]] int joint_count() const { return static_cast<int>(map_.joints().size()); }

  /// The filled part of an Evaluation. `value`: prediction and torque of the channels; `gradient`:
  /// also the gradient; `noise`: also the variance from motion.
  enum class Depth { value, gradient, noise };
  void evaluate(const Eigen::VectorXd& z, Depth depth, Evaluation& out) const;

  /// Computes two products with Evaluation's matrices in half of the time, without the matrices: `by_prediction` =
  /// gradient * by_predicted and, for a variable j with a channel c of its own, `by_channel`[j] = the sum over i of
  /// unfiltered(j, i) * channel_torque(c, i), else 0; p each. Calls `weigh(piece, rows)` once for each of `pieces()`,
  /// from several threads. `weigh` reads `predicted` and `channel_torque` of the piece's rows, sets their
  /// `by_predicted` and replaces the torques by the weights.
  void pull_back(const Eigen::VectorXd& z,
                 const std::function<void(std::size_t piece, PullBack& rows)>& weigh,
                 Eigen::VectorXd& by_prediction,
                 Eigen::VectorXd& by_channel) const;

  /// Returns the shapes of the model's error. For each muscle they are its torque times 1, the Legendre polynomials P1
  /// to P3 of its length over the recorded range, ln(activation) / 2.3 + 1 (a non-linear EMG), its speed over the
  /// greatest, and its change within 0.15 s (a delay of its own). For each joint they are 1 and P1 of the first
  /// muscle's length, scaled by the torque (passive torque). Errors of moment arms, force-length curves, tendons,
  /// passive tissue, non-linear EMG and motion under the skin are smooth in these. A shape that is itself an unknown of
  /// the fit has weight 0, lest it counts twice: 1 where the gain of the muscle's own electrode is an unknown (or
  /// F_max, for a measured force, which involves no moment arm), ln(activation) where the exponent or shape is, the lag
  /// where the muscle's own delay is, 1 and P1 of a joint where its offset and its stiffness are.
  [[nodiscard]] ErrorShapes error_shapes(const Eigen::VectorXd& z) const;

 private:
  using Block = ResidualBlock;
  void add_trial(const StudyData& data, int trial, const EstimatorOptions& options);
  void add_block(const StudyData& data,
                 int trial,
                 const std::vector<Eigen::Index>& rows,
                 const EstimatorOptions& options);
  /// Adds the joint that the view of a trial shows (of_joint).
  void add_joint(Block& block, const TrialData& view, const std::vector<Eigen::Index>& rows);
  /// Workspace of the calling thread: good until its next call.
  [[nodiscard]] const std::vector<MuscleRows>& evaluate_muscles(const Block& block,
                                                                const ModelValues& values,
                                                                const ChainsByOwner& chains) const;
  void add_torques(const Block& block,
                   const ModelValues& values,
                   const std::vector<MuscleRows>& muscles,
                   Eigen::VectorXd& predicted,
                   Eigen::MatrixXd& channel_torque) const;
  void add_gradient(const Block& block,
                    const std::vector<MuscleRows>& muscles,
                    const ChainsByOwner& chains,
                    Evaluation& out) const;
  void add_motion_variance(const Block& block, const std::vector<MuscleRows>& muscles, Evaluation& out) const;
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
