#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "myoid/identification/noise_level.h"
#include "myoid/identification/normal_search.h"
#include "myoid/identification/residual_model.h"

namespace myoid::identification {

/// The weights of the samples, which a pass of the search holds fixed.
struct Weighting {
  Eigen::VectorXd sd_nm;  ///< Per sample.
  double share = 1.0;     ///< nu: effective over all samples.
  /// Per sample: emg_share emg_factor^2 of its joint; empty: no correction.
  Eigen::VectorXd emg_variance;
  double offset = 0.0;  ///< Keeps the corrected cost positive.
  /// The correction's term grows with the square of the torques. Where the data hardly bound the
  /// torques, the term would outgrow the cost: then this is false and the correction is left out.
  bool corrected = true;
  Eigen::VectorXd noise_gain;     ///< Square of the model's noise gain by EMG channel, in the mean.
  Eigen::VectorXd exponent;       ///< p of a = g u^p by EMG channel where the noise was found.
  std::vector<NoiseLevel> noise;  ///< Per joint.
};

/// The derivatives that NormalEquations gets beside the cost: none, the gradient, or both.
enum class Derivatives { none, gradient, curvature };

/// Residual, weights and priors of one study: the cost that is minimized,
///
///   C(z) = 1/2 nu sum_i m_i rho((T^_i - T_i) / s_i) + 1/2 sum_j ((z_j - prior_j) / sd_j)^2
///
/// with multiplicities m_i that are 1 but for bootstrap replicates. The EMG, by which T^ is
/// multiplied, has errors of its own: they make the squared residual larger by c_a^2 sum_channels
/// T_channel^2 on average, the more so the greater the muscles are taken to be, so that plain least
/// squares makes them too weak, above all where co-contracting muscles cancel (attenuation by
/// errors in the regressors). With `EstimatorOptions::correct_attenuation` that expectation is
/// subtracted,
///
///   rho -> rho - c_a^2 sum_channels T_channel(z)^2 / s_i^2,
///
/// and from J'J, in the same way, what noise alone contributes to it. Of c_a^2 no more than the
/// EMG's bandwidth makes expected: residuals that go with the muscles' torques beyond that are the
/// model's error, which is in the torque and weakens nothing. Taken for noise of the EMG they would
/// drive the strengths up, which makes more of them, and so on.
class Estimator {
 public:
  Estimator(const StudyData& data, const EstimatorOptions& options);

  [[nodiscard]] const ResidualModel& model() const { return *model_; }
  [[nodiscard]] const std::vector<Unknown>& free() const { return model_->parameters().free(); }
  [[nodiscard]] const EstimatorOptions& options() const { return options_; }
  /// Expected c_a^2 of each EMG channel, or 1 where nothing is known.
  [[nodiscard]] const Eigen::VectorXd& channel_variance() const { return channel_variance_; }
  /// Square of the relative spread of each channel's envelope before both sides are low-passed.
  [[nodiscard]] Eigen::VectorXd envelope_variance(const NoiseLevel& found) const;
  /// p of a = g u^p of every EMG channel.
  [[nodiscard]] Eigen::VectorXd exponents(const Eigen::VectorXd& z) const;
  [[nodiscard]] const Eigen::VectorXd& lower() const { return lower_; }
  [[nodiscard]] const Eigen::VectorXd& upper() const { return upper_; }

  /// Departures from the plain cost, for replicates.
  struct Variant {
    Eigen::VectorXd multiplicity;  ///< Per sample; empty: 1.
    Eigen::VectorXd prior_mean;    ///< Per variable; empty: the priors' own.
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
  /// Weights and parameters in turn, EstimatorOptions::passes times.
  [[nodiscard]] Solution solve(const Eigen::VectorXd& start) const;
  /// From several starts; the best.
  [[nodiscard]] Solution solve_from_all_starts(const Eigen::VectorXd& start) const;
  /// With given weights.
  [[nodiscard]] NormalSearchResult search(const Eigen::VectorXd& start,
                                          const Weighting& weighting,
                                          double step_tolerance,
                                          double cost_tolerance,
                                          int iterations = 200,
                                          const Variant& variant = {},
                                          const std::vector<bool>& held = {}) const;
  /// Per-sample contributions to the gradient (p x n), and nu J'WJ of the data with noise taken
  /// out.
  struct Scores {
    Eigen::MatrixXd scores;
    Eigen::MatrixXd information;
    Eigen::MatrixXd rows;         ///< p x n: (nu W)^1/2 J', nothing taken out.
    Eigen::VectorXd residual;     ///< n: predicted less measured, over the standard deviation.
    Eigen::VectorXd attenuation;  ///< The correction's part of the sum of the scores.
  };
  [[nodiscard]] Scores scores(const Solution& solution) const;
  /// Start number s: the given one moved by a spread of the prior in a fixed pattern of signs.
  [[nodiscard]] Eigen::VectorXd moved_start(const Eigen::VectorXd& start, int s) const;

 private:
  /// Share of the variance of an envelope's noise that the low-pass of the residuals leaves.
  [[nodiscard]] double kept_by_residual_filter() const;
  void find_noise(const Eigen::VectorXd& z, const Evaluation& at, Weighting& weighting) const;
  /// Noise of one joint from the residuals of its rows; `power`: expected EMG noise per row.
  [[nodiscard]] NoiseLevel noise_of_joint(const std::vector<Eigen::Index>& rows,
                                          const Eigen::VectorXd& residual,
                                          const Eigen::VectorXd& power,
                                          const Evaluation& at,
                                          const Weighting& weighting) const;
  /// Sums over the rows of one piece or of all: the loss, and its expected part by the noise of
  /// each EMG channel.
  struct RowSums {
    double loss = 0.0;
    Eigen::VectorXd by_noise;
  };
  /// From predicted torques and torques of the channels of the rows from `first` on: d (cost of the
  /// data) / d predicted, the weights' roots, and in the torques' place what d (cost taken out by
  /// the correction) / dz is of theirs.
  RowSums weigh(const Weighting& weighting,
                const Variant& variant,
                Eigen::Index first,
                const Eigen::Ref<const Eigen::VectorXd>& predicted,
                Eigen::Ref<Eigen::MatrixXd> channel_torque,
                Eigen::Ref<Eigen::VectorXd> by_predicted,
                Eigen::Ref<Eigen::VectorXd> scale) const;
  /// Distance from the priors' means, and that over the priors' variances: the slope of their cost.
  struct PriorTerm {
    Eigen::VectorXd off, slope;
  };
  /// ResidualModel::pull_back's sums over the rows; p each.
  struct RowSlopes {
    Eigen::VectorXd by_prediction, by_channel;
  };
  [[nodiscard]] double cost_of(const Weighting& weighting,
                               const RowSums& sums,
                               const PriorTerm& prior) const;
  [[nodiscard]] Eigen::VectorXd gradient_of(const Eigen::VectorXd& z,
                                            const Weighting& weighting,
                                            const RowSums& sums,
                                            const RowSlopes& slopes,
                                            const PriorTerm& prior) const;
  /// Cost and gradient without the matrix of the prediction's gradient.
  [[nodiscard]] NormalEquations cost_and_gradient(const Eigen::VectorXd& z,
                                                  const Weighting& weighting,
                                                  const PriorTerm& prior,
                                                  const Variant& variant) const;
  /// The change of an EMG channel's torque with a variable, for T_ch = p T and an activation g u^p:
  /// `slope` times the change of T, plus T_ch if `adds`.
  struct ChannelSlope {
    int channel = -1;  ///< -1: none alone.
    double slope = 1.0;
    bool adds = false;
  };
  [[nodiscard]] ChannelSlope channel_slope(Eigen::Index j, const Eigen::VectorXd& exponent) const;
  /// c_a^2 times the part of J'WJ that is within channels, taken away; what is left is positive.
  void correct_curvature(const Weighting& weighting, Eigen::MatrixXd& information) const;

  EstimatorOptions options_;
  std::shared_ptr<const ResidualModel> model_;
  Eigen::VectorXd lower_, upper_, prior_mean_, prior_precision_;
  Eigen::VectorXd channel_variance_;  ///< Per EMG channel: expected c_a^2, or 1 if unknown.
  bool emg_noise_known_ = false;
  double floor_nm_ = 0.0;
};

}  // namespace myoid::identification
