#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/progress.h"

namespace myoid::inline ground::math {

/// Quantities that change between segments. Costs are -2 ln(likelihood) of normal samples, summed
/// over the columns, up to a constant in `mean`.
enum class SegmentCost {
  mean,              ///< The mean, with known noise: sum (x - mean)^2 / sd^2.
  variance,          ///< The variance about the mean of the whole series: m (ln(2 pi v) + 1).
  mean_and_variance  ///< Both: m (ln(2 pi v) + 1), v about the segment's own mean.
};

struct ChangePointOptions {
  SegmentCost cost = SegmentCost::mean_and_variance;
  /// Cost of one change. Empty: the Bayesian information criterion, (p + 1) ln n with p parameters
  /// per segment (one or two per column) and one for the place of the change.
  std::optional<double> penalty;
  /// Multiplies the penalty: samples per independent sample, n / n_eff. Correlated samples that are
  /// counted as independent show changes that do not exist.
  double samples_per_independent = 1.0;
  /// Shortest segment, in samples. Two nearly equal samples have nearly no variance: short segments
  /// would let the costs with a variance find changes everywhere.
  Eigen::Index min_length = 10;
  /// For `mean`: standard deviation of the noise per column. Empty: 1.4826 times the median
  /// absolute first difference, divided by sqrt(2), which is right for white noise only.
  std::optional<Eigen::VectorXd> noise_sd;
  Progress progress;
};

struct Segment {
  Eigen::Index begin = 0;    ///< First sample.
  Eigen::Index end = 0;      ///< One behind the last.
  Eigen::VectorXd mean;      ///< For each column.
  Eigen::VectorXd variance;  ///< For each column: mean square about that mean.
};

struct ChangePoints {
  std::vector<Segment> segments;  ///< In order; one more than changes.
  double cost = 0.0;              ///< Sum over segments + penalty x changes.
  double penalty = 0.0;           ///< The penalty used.
  Eigen::VectorXd noise_sd;       ///< The noise used by `mean`; empty otherwise.
};

/// Finds the segments with the least total cost exactly, by dynamic programming with pruning (PELT: Killick, Fearnhead
/// and Eckley 2012, the pruning delayed by `min_length`). Rows of x are samples in time order; columns are signals that
/// change together. Smaller variances than 1e-8 of the column's own (or 1e-300) are raised to that value. The time
/// grows with n for many changes and with n^2 for none (measured: 1 s for 10 000 samples). Throws InvalidInput if x has
/// no rows or columns or is not finite, or for options that are not positive or of the wrong size; Interrupted.
[[nodiscard]] ChangePoints change_points(const Eigen::MatrixXd& x, const ChangePointOptions& options = {});

}  // namespace myoid::inline ground::math
