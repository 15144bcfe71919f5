#pragma once

#include <memory>
#include <vector>

#include "myoid/identification/noise_level.h"
#include "myoid/identification/normal_search.h"
#include "myoid/identification/residual_model.h"

namespace myoid::identification {

/// The weights of the samples; a pass of the search holds them fixed.
struct Weighting {
  Eigen::VectorXd sd_nm;  ///< Standard deviation, per sample.
  double share = 1.0;     ///< nu: effective number of samples over all samples.
  /// Per sample: emg_share emg_factor^2 of its joint; empty: no correction.
  Eigen::VectorXd emg_variance;
  double offset = 0.0;  ///< Keeps the corrected cost positive.
  /// The correction's term grows with the square of the torques. False where the data hardly bound
  /// the torques and the term would outgrow the cost; the correction is then left out.
  bool corrected = true;
  Eigen::VectorXd noise_gain;  ///< Mean square of the model's noise gain, by EMG channel.
  /// p of a = g u^p by EMG channel at the point where the noise was estimated.
  Eigen::VectorXd exponent;
  std::vector<NoiseLevel> noise;  ///< Per joint.
};

/// The derivatives in NormalEquations beside the cost: none, the gradient, or both.
enum class Derivatives { none, gradient, curvature };

/// Residual, weights and priors of one study. The search minimizes the cost
///
///   C(z) = 1/2 nu sum_i m_i rho((T^_i - T_i) / s_i) + 1/2 sum_j ((z_j - prior_j) / sd_j)^2
///
/// with multiplicities m_i that are 1 except in bootstrap replicates. The EMG, which multiplies T^,
/// has errors of its own. On average they enlarge the squared residual by c_a^2 sum_channels
/// T_channel^2, the more the stronger the muscles are. So plain least squares makes muscles too
/// weak, above all where co-contracting muscles cancel (attenuation by errors in the regressors).
/// With `EstimatorOptions::correct_attenuation` the cost subtracts that expectation,
///
///   rho -> rho - c_a^2 sum_channels T_channel(z)^2 / s_i^2,
///
/// and J'J in the same way loses the contribution of noise alone. c_a^2 is at most the expectation from the EMG's
/// bandwidth. Residuals beyond it that vary with the muscles' torques are the model's error, which is in the torque and
/// weakens no muscle. Taken for noise of the EMG they would raise the strengths, and so the residuals, again and again.
class Estimator {
 public:
  Estimator(const StudyData& data, const EstimatorOptions& options);

  [[nodiscard]] const ResidualModel& model() const { return *model_; }
  [[nodiscard]] const std::vector<Unknown>& free() const { return model_->parameters().free(); }
  [[nodiscard]] const EstimatorOptions& options() const { return options_; }
  /// Expected c_a^2 of each EMG channel, or 1 where its bandwidth is unknown.
  [[nodiscard]] const Eigen::VectorXd& channel_variance() const { return channel_variance_; }
  /// Squared relative spread of each channel's envelope before prediction and measurement are low-passed.
  [[nodiscard]] Eigen::VectorXd envelope_variance(const NoiseLevel& found) const;
  /// Returns p of a = g u^p for every EMG channel.
  [[nodiscard]] Eigen::VectorXd exponents(const Eigen::VectorXd& z) const;
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }
  /// Per unknown: 1 / sd² of its prior; 0 without a prior.
  [[nodiscard]] const Eigen::VectorXd& prior_precision() const { return prior_precision_; }

  /// Deviations of a replicate from the plain cost.
  struct Variant {
    Eigen::VectorXd multiplicity;  ///< Per sample; empty: all 1.
    Eigen::VectorXd prior_mean;    ///< Per variable; empty: the means of the priors.
  };
  [[nodiscard]] NormalEquations normal_equations(const Eigen::VectorXd& z,
                                                 const Weighting& weighting,
                                                 Derivatives derivatives,
                                                 const Variant& variant = {}) const;

  struct Solution {
    NormalSearchResult search;
    Weighting weighting;
    double misfit = 0.0;  ///< -2 log posterior up to a constant: comparable between starts.
  };
  /// Finds weights and parameters in turn, EstimatorOptions::passes times.
  [[nodiscard]] Solution solve(const Eigen::VectorXd& start) const;
  /// Solves from several starts and returns the best solution.
  [[nodiscard]] Solution solve_from_all_starts(const Eigen::VectorXd& start) const;
  /// Searches with given weights.
  [[nodiscard]] NormalSearchResult search(const Eigen::VectorXd& start,
                                          const Weighting& weighting,
                                          double step_tolerance,
                                          double cost_tolerance,
                                          int iterations = 200,
                                          const Variant& variant = {},
                                          const std::vector<bool>& held = {}) const;
  /// Per-sample contributions to the gradient (p x n), and nu J'WJ of the data after subtraction of the noise.
  struct Scores {
    Eigen::MatrixXd scores;
    Eigen::MatrixXd information;
    Eigen::MatrixXd rows;         ///< p x n: (nu W)^1/2 J', without subtraction.
    Eigen::VectorXd residual;     ///< n: predicted less measured, over the standard deviation.
    Eigen::VectorXd attenuation;  ///< The correction's part of the sum of the scores.
  };
  [[nodiscard]] Scores scores(const Solution& solution) const;
  /// Returns start number s: the given start moved by the prior's spread, in a fixed pattern of signs.
  [[nodiscard]] Eigen::VectorXd moved_start(const Eigen::VectorXd& start, int s) const;

 private:
  /// Returns the share of an envelope's noise variance that passes the residuals' low-pass.
  [[nodiscard]] double kept_by_residual_filter() const;
  void find_noise(const Eigen::VectorXd& z, const Evaluation& at, Weighting& weighting) const;
  /// Finds one joint's noise from the residuals of its rows; `power`: expected EMG noise per row.
  [[nodiscard]] NoiseLevel noise_of_joint(const std::vector<Eigen::Index>& rows,
                                          const Eigen::VectorXd& residual,
                                          const Eigen::VectorXd& power,
                                          const Evaluation& at,
                                          const Weighting& weighting) const;
  /// Sums over the rows of one piece or of all pieces: the loss, and its expected part by the noise
  /// of each EMG channel.
  struct RowSums {
    double loss = 0.0;
    Eigen::VectorXd by_noise;
  };
  /// Weighs the rows from `first` on: turns predicted torques into d (cost of the data) / d predicted, sets the roots
  /// of the weights, and replaces the channels' torques by their part of d (cost that the correction subtracts) / dz.
  RowSums weigh(const Weighting& weighting,
                const Variant& variant,
                Eigen::Index first,
                const Eigen::Ref<const Eigen::VectorXd>& predicted,
                Eigen::Ref<Eigen::MatrixXd> channel_torque,
                Eigen::Ref<Eigen::VectorXd> by_predicted,
                Eigen::Ref<Eigen::VectorXd> scale) const;
  /// Distance from the priors' means, and the slope of the priors' cost: distance over variance.
  struct PriorTerm {
    Eigen::VectorXd off, slope;
  };
  /// Sums of ResidualModel::pull_back over the rows; p each.
  struct RowSlopes {
    Eigen::VectorXd by_prediction, by_channel;
  };
  [[nodiscard]] double cost_of(const Weighting& weighting, const RowSums& sums, const PriorTerm& prior) const;
  [[nodiscard]] Eigen::VectorXd gradient_of(const Eigen::VectorXd& z,
                                            const Weighting& weighting,
                                            const RowSums& sums,
                                            const RowSlopes& slopes,
                                            const PriorTerm& prior) const;
  /// Computes cost and gradient without the matrix of the prediction's gradient.
  [[nodiscard]] NormalEquations cost_and_gradient(const Eigen::VectorXd& z,
                                                  const Weighting& weighting,
                                                  const PriorTerm& prior,
                                                  const Variant& variant) const;
  /// Derivative of an EMG channel's torque by a variable, for T_ch = p T and an activation g u^p:
  /// `slope` times the derivative of T, plus T_ch if `adds`.
  struct ChannelSlope {
    int channel = -1;  ///< -1: no single channel.
    double slope = 1.0;
    bool adds = false;
  };
  [[nodiscard]] ChannelSlope channel_slope(Eigen::Index j, const Eigen::VectorXd& exponent) const;
  /// Subtracts c_a^2 times the part of J'WJ within channels; the remainder stays positive.
  void correct_curvature(const Weighting& weighting, Eigen::MatrixXd& information) const;

  EstimatorOptions options_;
  std::shared_ptr<const ResidualModel> model_;
  Eigen::VectorXd lower_, upper_, prior_mean_, prior_precision_;
  Eigen::VectorXd channel_variance_;  ///< Per EMG channel: expected c_a^2, or 1 if unknown.
  bool emg_noise_known_ = false;
  double floor_nm_ = 0.0;
};

}  // namespace myoid::identification
