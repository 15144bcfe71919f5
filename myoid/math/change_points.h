#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/progress.h"

namespace myoid::math {

/// What may change from one segment to the next. Costs are -2 ln(likelihood) of normal samples,
/// summed over the columns, up to a constant in `mean`.
enum class SegmentCost {
  mean,              ///< The mean; the noise is known: sum (x - mean)^2 / sd^2.
  variance,          ///< The variance about the mean of the whole series: m (ln(2 pi v) + 1).
  mean_and_variance  ///< Both: m (ln(2 pi v) + 1), v about the segment's own mean.
};

struct ChangePointOptions {
  SegmentCost cost = SegmentCost::mean_and_variance;
  /// What one more change costs. Empty: the Bayesian information criterion, (p + 1) ln n with p
  /// parameters per segment (one or two per column) and one for the place of the change.
  std::optional<double> penalty;
  /// Multiplies the penalty: the samples that one independent sample is worth, n / n_eff. Samples
  /// that are correlated and counted as independent show changes that are none.
  double samples_per_independent = 1.0;
  /// Shortest segment, in samples. Two that are nearly equal have nearly no variance: with short
  /// segments allowed, the costs with a variance find changes everywhere.
  Eigen::Index min_length = 10;
  /// Of `mean`: standard deviation of the noise per column. Empty: 1.4826 times the median absolute
  /// first difference, over sqrt(2); right for white noise only.
  std::optional<Eigen::VectorXd> noise_sd;
  Progress progress;
};

struct Segment {
  Eigen::Index begin = 0;    ///< First sample.
  Eigen::Index end = 0;      ///< One behind the last.
  Eigen::VectorXd mean;      ///< Per column.
  Eigen::VectorXd variance;  ///< Per column, about that mean, divided by the count.
};

struct ChangePoints {
  std::vector<Segment> segments;  ///< In order; one more than there are changes.
  double cost = 0.0;              ///< Sum over segments + penalty x changes: the least possible.
  double penalty = 0.0;           ///< As used.
  Eigen::VectorXd noise_sd;       ///< As used by `mean`; empty otherwise.
};

/// Segments with the least total cost, exactly, by dynamic programming with pruning (PELT: Killick,
/// Fearnhead and Eckley 2012, the pruning delayed by `min_length`): rows of x are samples in time
/// order, columns signals that change together. Variances below 1e-8 of the column's own (or
/// 1e-300) count as that. Time grows with n where changes are many, with n^2 where there is none (1
/// s for 10 000 samples, measured). Throws InvalidInput if x has no rows or columns or is not
/// finite, or for options that are not positive or of the wrong size; Interrupted.
[[nodiscard]] ChangePoints change_points(const Eigen::MatrixXd& x,
                                         const ChangePointOptions& options = {});

}  // namespace myoid::math
