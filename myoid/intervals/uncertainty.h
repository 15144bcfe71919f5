#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/estimator.h"

namespace myoid::identification {

/// Covariances from the curvature and the scores at the minimum, in the solver's scale.
struct Sandwich {
  Eigen::MatrixXd newey_west;  ///< A^-1 B A^-1, B from autocovariances within trials up to 0.4 s;
                               ///< where weights are used never below what the autocorrelation
                               ///< of all residuals makes of the gradients; without them B from
                               ///< blocks of 2 s as below over trials, with Student's quantile.
  std::optional<Eigen::MatrixXd> cluster;  ///< B from the sums of scores over trials, each as it
                                           ///< would be spread outside the fit (Bell & McCaffrey
                                           ///< 2002); with at least 8 trials.
  std::vector<int> trials;                 ///< Calibration trials, in StudyData::trials.
  Eigen::MatrixXd trial_shift;  ///< p x trials: by how much the estimates move without that trial,
                                ///< in one Newton step, (A - A_trial)^-1 times its scores.
  std::optional<Eigen::MatrixXd> jackknife;  ///< (K - 1)/K sum of those shifts squared, and the
                                             ///< prior's share as in the other two; with at least
                                             ///< 5 trials.
  /// Standard deviations of the logarithm of an interval's width by chance alone, from the sums
  /// over trials and from the jackknife, by parameter. They grow as fewer trials tell of the
  /// parameter (Satterthwaite 1946) ...
  Eigen::VectorXd trial_spread;
  double sample_spread = 0.0;   ///< ... and of Newey and West's, with its triangle of lags.
  Eigen::MatrixXd model_based;  ///< A^-1
  Eigen::MatrixXd information;  ///< Of the data alone, nu J'WJ.
  /// Change of the estimates if the variance of the EMG's noise is larger by its own spread
  /// (NoiseLevel::log_variance_sd). It is large if the data hardly tell the muscles from quantities
  /// without noise.
  Eigen::VectorXd by_noise;
  int rank = 0;                  ///< Of the data with unit columns, tolerance 1e-7.
  double condition = 0.0;        ///< Of J with unit columns.
  std::vector<bool> determined;  ///< By the data alone.
  Eigen::MatrixXd undetermined;  ///< Unit columns: combinations the data leave free.
};
[[nodiscard]] Sandwich sandwich(const Estimator& estimator, const Estimator::Solution& solution);

/// An interval of one parameter in the solver's scale; empty where the route gives none.
struct Interval {
  std::optional<double> low, high;
};

struct BootstrapResult {
  Eigen::MatrixXd replicates;  ///< Converged ones, rows.
  int failed = 0;
  std::vector<Interval> intervals;  ///< 2.5 and 97.5 % quantiles.
  double spread = 0.0;  ///< As Sandwich::trial_spread, from the numbers of replicates and blocks.
};
/// Refits to resampled data: blocks are drawn with replacement within each trial (whole trials if
/// `bootstrap_block_s` is 0), and prior means are drawn from the priors; weights are those of the
/// solution. Replicates run in parallel; number k depends on the seed and k alone.
[[nodiscard]] BootstrapResult bootstrap(const Estimator& estimator,
                                        const Estimator::Solution& solution);

/// Parameters that the data hardly tell apart: the collinearity index 1 / sqrt(smallest eigenvalue)
/// of S'S, S the sensitivities with unit columns (Brun and others 2001).
struct CollinearSet {
  std::vector<Eigen::Index> parameters;
  double index = 0.0;
};
/// Sets of two to four with an index above `limit`, none containing a smaller one, worst first, at
/// most `count`. `information` is J'WJ.
[[nodiscard]] std::vector<CollinearSet> collinear_sets(const Eigen::MatrixXd& information,
                                                       double limit = 10.0,
                                                       std::size_t count = 12);

}  // namespace myoid::identification
