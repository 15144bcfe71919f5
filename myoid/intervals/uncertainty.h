#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/identification/estimator.h"

namespace myoid::identification {

/// Covariances from the curvature and the scores at the minimum, in the solver's scale.
struct Sandwich {
  /// A^-1 B A^-1, B from autocovariances within trials up to 0.4 s. With weights its variances are
  /// at least those by the autocorrelation of all residuals. Without weights B is from blocks of 2
  /// s as `cluster` is from trials, with Student's quantile.
  Eigen::MatrixXd newey_west;
  /// B from the sums of scores over trials, each with the spread that it has outside the fit (Bell
  /// & McCaffrey 2002); needs at least 8 trials.
  std::optional<Eigen::MatrixXd> cluster;
  std::vector<int> trials;      ///< Calibration trials, as indices in StudyData::trials.
  Eigen::MatrixXd trial_shift;  ///< p x trials: shift of the estimates without this trial, in one
                                ///< Newton step, (A - A_trial)^-1 times its scores.
  /// (K - 1)/K times the sum of the squared shifts, plus the prior's share as in the other two;
  /// needs at least 5 trials.
  std::optional<Eigen::MatrixXd> jackknife;
  /// Standard deviations by chance of the logarithm of an interval's width, from the sums over trials and from the
  /// jackknife, by parameter. They grow as fewer trials inform the parameter (Satterthwaite 1946).
  Eigen::VectorXd trial_spread;
  /// The same of Newey and West's interval, with its triangle of lags.
  double sample_spread = 0.0;
  Eigen::MatrixXd model_based;  ///< A^-1
  Eigen::MatrixXd information;  ///< Information of the data alone, nu J'WJ.
  /// Change of the estimates if the variance of the EMG's noise grows by its own spread (NoiseLevel::log_variance_sd).
  /// The change is large if the data hardly separate the muscles from quantities without noise.
  Eigen::VectorXd by_noise;
  double condition = 0.0;        ///< Condition of J with unit columns.
  std::vector<bool> determined;  ///< True: the data alone determine the parameter.
  Eigen::MatrixXd undetermined;  ///< Unit columns: combinations that the data leave open.
};
[[nodiscard]] Sandwich sandwich(const Estimator& estimator, const Estimator::Solution& solution);

/// An interval of one parameter in the solver's scale; empty if the route gives no end.
struct Interval {
  std::optional<double> low, high;
};

struct BootstrapResult {
  Eigen::MatrixXd replicates;  ///< Converged replicates, one per row.
  int failed = 0;
  std::vector<Interval> intervals;  ///< 2.5 and 97.5 % quantiles.
  double spread = 0.0;              ///< As Sandwich::trial_spread, by the numbers of replicates and blocks.
};
/// Refits to resampled data: draws blocks with replacement within each trial (whole trials if
/// `bootstrap_block_s` is 0) and prior means from the priors; the weights are the solution's.
/// Replicates run in parallel; number k depends on the seed and k alone.
[[nodiscard]] BootstrapResult bootstrap(const Estimator& estimator, const Estimator::Solution& solution);

/// Parameters that the data hardly separate, with the collinearity index 1 / sqrt(smallest
/// eigenvalue) of S'S, S the sensitivities with unit columns (Brun and others 2001).
struct CollinearSet {
  std::vector<Eigen::Index> parameters;
  double index = 0.0;
};
/// Returns at most twelve sets of two to four with an index above 10, the worst first; no set contains a smaller one.
/// `information` is J'WJ.
[[nodiscard]] std::vector<CollinearSet> collinear_sets(const Eigen::MatrixXd& information);

}  // namespace myoid::identification
