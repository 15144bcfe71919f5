#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/progress.h"
#include "myoid/math/random.h"

namespace myoid::math {

/// How correlated samples are redrawn in blocks of neighbors.
enum class BlockScheme {
  moving,     ///< Blocks of fixed length that lie within the piece (Kunsch 1989).
  circular,   ///< The same, the piece's end joined to its start: no sample is favored.
  stationary  ///< Lengths geometric with mean `length`, circular (Politis and Romano 1994).
};

/// Indices of one replicate of consecutive pieces (trials) whose lengths are given: as many as
/// there are samples; those of each piece are drawn, in blocks, from that piece alone. `length` is
/// cut to the piece's own. Throws InvalidInput unless length >= 1 and no piece is negative.
[[nodiscard]] std::vector<Eigen::Index> block_bootstrap_indices(
    const std::vector<Eigen::Index>& pieces,
    Eigen::Index length,
    BlockScheme scheme,
    Random& random);

/// Which clusters (trials, cycles) one replicate consists of: `clusters` numbers in
/// 0..clusters-1, drawn with replacement, in rising order. Throws InvalidInput if clusters < 1.
[[nodiscard]] std::vector<Eigen::Index> cluster_bootstrap_indices(Eigen::Index clusters,
                                                                  Random& random);

/// Block length that minimizes the mean squared error of the bootstrap variance of a mean, from
/// the autocovariances within `pieces`: b = (2 G^2 n / D)^(1/3), G = sum lambda(k/M) |k| R(k),
/// D = 4/3 g^2 (moving, circular) or 2 g^2 (stationary), g = sum lambda(k/M) R(k), flat-top lambda,
/// M twice the lag where the correlations vanish (Politis and White 2004, corrected by Patton,
/// Politis and White 2009). At least 1, at most the longest piece; 1 for a constant series. Throws
/// InvalidInput if the pieces do not add up to the length of x.
[[nodiscard]] double block_length(const Eigen::Ref<const Eigen::VectorXd>& x,
                                  const std::vector<Eigen::Index>& pieces,
                                  BlockScheme scheme);

struct BootstrapOptions {
  Eigen::Index replicates = 400;
  std::uint64_t seed = 1;
  Progress progress;
};

struct BootstrapResult {
  Eigen::MatrixXd estimates;  ///< One row per replicate that gave an estimate, in their order.
  Eigen::Index failed = 0;    ///< Replicates that gave none.

  [[nodiscard]] Eigen::VectorXd mean() const;
  [[nodiscard]] Eigen::MatrixXd covariance() const;  ///< Divided by rows - 1.
};

using DrawIndices = std::function<std::vector<Eigen::Index>(Random&)>;
/// The estimate from one set of indices; empty when the refit fails. Called from several threads.
using EstimateFromIndices =
    std::function<std::optional<Eigen::VectorXd>(const std::vector<Eigen::Index>&)>;

/// Draws and estimates `replicates` times, in parallel. Replicate k draws from Random(seed, k):
/// neither thread count nor a failed replicate changes the others. Throws InvalidInput if estimates
/// differ in size or replicates < 1; Interrupted; and what the two functions throw.
[[nodiscard]] BootstrapResult bootstrap(const DrawIndices& draw,
                                        const EstimateFromIndices& estimate,
                                        const BootstrapOptions& options = {});

struct BootstrapInterval {
  double lower = 0.0;
  double upper = 0.0;
};

/// The central share `level` of the replicates: order statistics at (B + 1)(1 -+ level)/2,
/// interpolated, the outermost at the ends. Throws InvalidInput if there are fewer than 2
/// replicates, one is not finite, or not 0 < level < 1.
[[nodiscard]] BootstrapInterval percentile_interval(
    const Eigen::Ref<const Eigen::VectorXd>& replicates, double level);

/// Bias-corrected and accelerated interval (Efron 1987): percentiles moved by
/// z0 = Phi^-1(share of replicates below the estimate, ties by half) and by the acceleration
/// a = sum d^3 / (6 (sum d^2)^(3/2)), d = mean - value of the `jackknife` values (the estimate
/// without each cluster in turn); an empty jackknife means a = 0. Throws as percentile_interval.
/// Empty when all replicates lie on one side of the estimate: the bias has no correction.
[[nodiscard]] std::optional<BootstrapInterval> bca_interval(
    const Eigen::Ref<const Eigen::VectorXd>& replicates,
    double estimate,
    const Eigen::Ref<const Eigen::VectorXd>& jackknife,
    double level);

}  // namespace myoid::math
