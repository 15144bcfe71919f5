#include "myoid/intervals/uncertainty.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

#include <Eigen/Cholesky>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/core/numbers.h"
#include "myoid/intervals/score_blocks.h"
#include "myoid/math/decompositions.h"
#include "myoid/math/random.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// Returns inverse_of(a) * b, by a Cholesky factor if `a` has one.
Eigen::VectorXd solve_positive(const Eigen::MatrixXd& a, const Eigen::VectorXd& b) {
  const Eigen::VectorXd scale = a.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::LLT<Eigen::MatrixXd> factor(scale.asDiagonal() * a * scale.asDiagonal());
  const bool regular =
      factor.info() == Eigen::Success && factor.matrixLLT().diagonal().minCoeff() > 1e-5;  // 1 in each column
  if (!regular) return inverse_of(a) * b;
  return scale.cwiseProduct(factor.solve(scale.cwiseProduct(b)));
}

/// Returns true if the smallest eigenvalue of these rows and columns surely exceeds `least`: A -
/// least I then has a Cholesky factor.
bool above_in_all_directions(const Eigen::MatrixXd& a, const std::vector<Eigen::Index>& set, double least) {
  Eigen::Matrix4d factor;
  const std::size_t n = set.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = j; i < n; ++i) {
      const auto row = static_cast<Eigen::Index>(i), column = static_cast<Eigen::Index>(j);
      double rest = a(set[i], set[j]) - (i == j ? least : 0.0);
      for (Eigen::Index k = 0; k < column; ++k) rest -= factor(row, k) * factor(column, k);
      if (i > j) {
        factor(row, column) = rest / factor(column, column);
        continue;
      }
      if (!(rest > 0.0)) return false;
      factor(row, column) = std::sqrt(rest);
    }
  }
  return true;
}

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

double largest_log_sd(const std::vector<NoiseLevel>& noise) {
  double largest = 0.0;
  for (const NoiseLevel& level : noise) largest = std::max(largest, level.log_variance_sd);
  return largest;
}

Eigen::MatrixXd with_priors(Eigen::MatrixXd of_data, const Eigen::VectorXd& precision) {
  of_data.diagonal() += precision;
  return of_data;
}

/// Finds the parameters that the data alone determine, by the eigenvectors of the information scaled to unit columns.
void find_determined(const Eigen::MatrixXd& information, Sandwich& result) {
  const Eigen::Index p = information.rows();
  const Eigen::VectorXd norm = information.diagonal().cwiseSqrt();
  const double largest_norm = norm.maxCoeff();
  Eigen::VectorXd unit(p);
  for (Eigen::Index j = 0; j < p; ++j) unit[j] = norm[j] > 0.0 ? 1.0 / norm[j] : 0.0;
  const math::SymmetricEigen eigen = math::symmetric_eigen(unit.asDiagonal() * information * unit.asDiagonal());
  const Eigen::VectorXd& values = eigen.values;  // rising
  const double top = values[values.size() - 1];
  result.condition = values[0] > 0.0 ? std::sqrt(top / values[0]) : kInfinity;
  std::vector<Eigen::Index> open;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    // The values are squares of singular values, with round-off of 1e-16 of the largest.
    if (values[k] <= 1e-13 * top || !(largest_norm > 0.0)) open.push_back(k);
  }
  result.undetermined = eigen.vectors(Eigen::all, open);
  result.determined.assign(static_cast<std::size_t>(p), true);
  for (Eigen::Index j = 0; j < p; ++j) {
    result.determined[static_cast<std::size_t>(j)] = norm[j] > 0.0 && result.undetermined.row(j).norm() < 1e-3;
  }
}

/// Returns the covariance of the scores' sum by the autocorrelation of all residuals together.
Eigen::MatrixXd by_autocorrelation(const Estimator& estimator, const Estimator::Scores& by_sample, double share) {
  const ResidualModel& model = estimator.model();
  const double told_apart_hz = 8.0 * estimator.options().residual_cutoff_hz.value_or(6.25);
  const auto stride = static_cast<Eigen::Index>(std::max(1.0, std::floor(model.rate_hz() / told_apart_hz)));
  return share * math::covariance_of_sum(by_sample.rows,
                                         math::positive_autocorrelation(by_sample.residual, model.piece_lengths()),
                                         model.piece_lengths(), stride);
}

/// Returns the covariance with unchanged correlations and no variance below `least`.
Eigen::MatrixXd at_least(Eigen::MatrixXd covariance, const Eigen::VectorXd& least) {
  for (Eigen::Index j = 0; j < covariance.rows(); ++j) {
    const double factor = std::sqrt(std::max(1.0, least[j] / std::max(covariance(j, j), 1e-300)));
    if (factor > 1.0) {
      covariance.row(j) *= factor;
      covariance.col(j) *= factor;
    }
  }
  return covariance;
}

/// Sums and shifts by trial; p x trials.
struct OverTrials {
  std::vector<int> trials;  ///< Sandwich::trials.
  Eigen::MatrixXd shift;    ///< Sandwich::trial_shift.
  Eigen::MatrixXd sums;     ///< Sums of the scores, each with the spread that it has outside the fit.
  /// Expected share of each trial in the variance over trials, and its square, summed.
  Eigen::VectorXd shares, squared_shares;
};

/// Computes the sums and shifts. `scores`: n x p. `whole`: information of the data without
/// subtraction, and of the priors. `prior_shares`: the priors' parts of the variances.
OverTrials over_trials(const ResidualModel& model,
                       const Eigen::MatrixXd& scores,
                       const Eigen::MatrixXd& rows,
                       const Eigen::MatrixXd& whole,
                       const Eigen::MatrixXd& model_based,
                       const Eigen::VectorXd& prior_shares) {
  OverTrials result;
  std::vector<int>& trials = result.trials;
  for (const Piece& piece : model.pieces()) {
    if (std::find(trials.begin(), trials.end(), piece.trial) == trials.end()) trials.push_back(piece.trial);
  }
  const Eigen::Index p = whole.rows();
  result.sums.resize(p, static_cast<Eigen::Index>(trials.size()));
  result.shift.resize(p, result.sums.cols());
  result.shares = prior_shares;
  result.squared_shares = Eigen::VectorXd::Zero(p);
  const Eigen::LLT<Eigen::MatrixXd> factor(whole);
  for (Eigen::Index k = 0; k < result.sums.cols(); ++k) {
    Eigen::MatrixXd of_trial = Eigen::MatrixXd::Zero(p, p);
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(p);
    for (const Piece& piece : model.pieces()) {
      if (piece.trial != trials[static_cast<std::size_t>(k)]) continue;
      sum += scores.middleRows(piece.first, piece.count).colwise().sum().transpose();
      const auto part = rows.middleCols(piece.first, piece.count);
      of_trial += part * part.transpose();
    }
    result.shift.col(k) = solve_positive(whole - of_trial, sum);
    const Eigen::VectorXd share = (model_based * of_trial).cwiseProduct(model_based).rowwise().sum();
    result.shares += share;
    result.squared_shares += share.cwiseAbs2();
    result.sums.col(k) = factor.info() == Eigen::Success ? unfitted(factor, of_trial, sum) : sum;
  }
  return result;
}

Eigen::MatrixXd squares_about_mean(const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd off = columns.colwise() - columns.rowwise().mean();
  return off * off.transpose();
}

/// Makes intervals from the converged replicates; the others are empty in `found`.
BootstrapResult bootstrap_result(const std::vector<Eigen::VectorXd>& found, std::size_t blocks, Eigen::Index p) {
  BootstrapResult result;
  std::vector<std::size_t> good;
  for (std::size_t k = 0; k < found.size(); ++k) {
    if (found[k].size() > 0) {
      good.push_back(k);
    } else {
      ++result.failed;
    }
  }
  result.replicates.resize(static_cast<Eigen::Index>(good.size()), p);
  for (std::size_t i = 0; i < good.size(); ++i)
    result.replicates.row(static_cast<Eigen::Index>(i)) = found[good[i]].transpose();
  result.intervals.resize(static_cast<std::size_t>(p));
  // Each end is a quantile of the replicates with sd sqrt(0.975 0.025 / R) / 0.0585 (density at
  // 1.96); the blocks are a sample themselves.
  if (!good.empty())
    result.spread =
        std::hypot(0.96 / std::sqrt(static_cast<double>(good.size())), std::sqrt(0.5 / static_cast<double>(blocks)));
  if (good.size() < 40) return result;
  for (Eigen::Index j = 0; j < p; ++j) {
    const std::vector<double> values(result.replicates.col(j).begin(), result.replicates.col(j).end());
    result.intervals[static_cast<std::size_t>(j)] = {quantile(values, 0.025), quantile(values, 0.975)};
  }
  return result;
}

}  // namespace

Sandwich sandwich(const Estimator& estimator, const Estimator::Solution& solution) {
  const ResidualModel& model = estimator.model();
  const Estimator::Scores by_sample = estimator.scores(solution);
  const Eigen::VectorXd& precision = estimator.prior_precision();
  Sandwich result;
  result.information = by_sample.information;
  result.model_based = inverse_of(with_priors(result.information, precision));
  result.by_noise = largest_log_sd(solution.weighting.noise) * result.model_based * by_sample.attenuation;
  find_determined(result.information, result);

  const Eigen::MatrixXd scores = by_sample.scores.transpose();
  const auto lag = static_cast<Eigen::Index>(std::lround(0.4 * model.rate_hz()));
  const Eigen::MatrixXd b = with_priors(math::newey_west(scores, model.piece_lengths(), lag), precision);
  result.newey_west = result.model_based * b * result.model_based;
  // The triangle of lags gives Var(B) / B^2 = 4/3 L / n; the width varies with the root of B.
  result.sample_spread = 0.5 * std::sqrt(4.0 / 3.0 * static_cast<double>(std::max<Eigen::Index>(1, lag)) /
                                         static_cast<double>(model.sample_count()));
  if (estimator.options().weights) {
    // Few effective samples make B uncertain, and B counts the autocovariances only up to its
    // longest lag. The autocorrelation of all samples together bounds B from below.
    const Eigen::MatrixXd expected =
        with_priors(by_autocorrelation(estimator, by_sample, solution.weighting.share), precision);
    const Eigen::VectorXd least = (result.model_based * expected).cwiseProduct(result.model_based).rowwise().sum();
    result.newey_west = at_least(std::move(result.newey_west), least);
  }

  const Eigen::MatrixXd whole = with_priors(by_sample.rows * by_sample.rows.transpose(), precision);
  const Eigen::MatrixXd of_priors = result.model_based * precision.asDiagonal() * result.model_based;
  OverTrials over = over_trials(model, scores, by_sample.rows, whole, result.model_based, of_priors.diagonal());
  if (!estimator.options().weights) {
    // Without weights, few effective samples make Newey and West's estimate a third too small.
    // Blocks of many correlation times, each as if not fitted, with the quantile of their number,
    // are not too small (Bell & McCaffrey 2002).
    if (const auto over_blocks = block_covariance(model, by_sample, whole, precision)) result.newey_west = *over_blocks;
  }
  result.trials = std::move(over.trials);
  result.trial_shift = std::move(over.shift);
  const auto clusters = static_cast<double>(result.trials.size());
  if (result.trials.size() >= 5)
    result.jackknife = (clusters - 1.0) / clusters * squares_about_mean(result.trial_shift) + of_priors;
  result.trial_spread = (0.5 * over.squared_shares.array()).sqrt() / over.shares.array().max(1e-300);
  if (result.trials.size() >= 8) {
    const Eigen::MatrixXd sum = with_priors(over.sums * over.sums.transpose(), precision);
    result.cluster = result.model_based * sum * result.model_based;
  }
  return result;
}

BootstrapResult bootstrap(const Estimator& estimator, const Estimator::Solution& solution) {
  const ResidualModel& model = estimator.model();
  const IntervalOptions& options = estimator.options().intervals;
  const std::vector<Block> blocks = blocks_of(model, options.bootstrap_block_s);
  const auto count = static_cast<std::size_t>(std::max(0, options.bootstrap));
  const Eigen::Index p = solution.search.x.size();
  std::vector<Eigen::VectorXd> found(count);
  std::atomic<int> done = 0;
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t k) {
    estimator.options().progress.check();
    math::Random random(options.seed, k + 1);
    Estimator::Variant variant;
    variant.multiplicity = Eigen::VectorXd::Zero(model.sample_count());
    for (std::size_t first = 0; first < blocks.size();) {
      std::size_t end = first;
      while (end < blocks.size() && blocks[end].stratum == blocks[first].stratum) ++end;
      for (std::size_t draw = first; draw < end; ++draw) {
        const Block& block =
            blocks[first + static_cast<std::size_t>(random.below(static_cast<Eigen::Index>(end - first)))];
        for (const auto& [begin, length] : block.rows) variant.multiplicity.segment(begin, length).array() += 1.0;
      }
      first = end;
    }
    variant.prior_mean = Eigen::VectorXd::Zero(p);
    for (Eigen::Index j = 0; j < p; ++j) {
      const Unknown& f = estimator.free()[static_cast<std::size_t>(j)];
      if (f.prior.sd > 0.0) variant.prior_mean[j] = f.prior.mean + f.prior.sd * random.normal();
    }
    const NormalSearchResult fit = estimator.search(solution.search.x, solution.weighting, 1e-4, 1e-3, 30, variant);
    if (fit.termination == math::Termination::converged) found[k] = fit.x;
    estimator.options().progress.tell(static_cast<double>(++done) / static_cast<double>(count), "bootstrap");
  });
  return bootstrap_result(found, blocks.size(), p);
}

std::vector<CollinearSet> collinear_sets(const Eigen::MatrixXd& information) {
  constexpr double kLimit = 10.0;
  constexpr std::size_t kMost = 12;
  const Eigen::Index p = information.rows();
  std::vector<CollinearSet> found;
  std::vector<Eigen::Index> usable;
  for (Eigen::Index j = 0; j < p; ++j) {
    if (information(j, j) > 0.0) usable.push_back(j);
  }
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd unit = scale.asDiagonal() * information * scale.asDiagonal();
  const auto contains_smaller = [&](const std::vector<Eigen::Index>& set) {
    return std::any_of(found.begin(), found.end(), [&](const CollinearSet& other) {
      return other.parameters.size() < set.size() &&
             std::includes(set.begin(), set.end(), other.parameters.begin(), other.parameters.end());
    });
  };
  const auto consider = [&](const std::vector<Eigen::Index>& set) {
    if (above_in_all_directions(unit, set, 0.999 / (kLimit * kLimit)) || contains_smaller(set)) return;
    const double smallest = math::symmetric_eigenvalues(unit(set, set))[0];
    const double index = smallest > 1e-16 ? 1.0 / std::sqrt(smallest) : 1e8;
    if (index > kLimit) found.push_back({set, index});
  };
  const std::size_t n = usable.size();
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j) consider({usable[i], usable[j]});
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      for (std::size_t k = j + 1; k < n; ++k) consider({usable[i], usable[j], usable[k]});
  if (n <= 40) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        for (std::size_t k = j + 1; k < n; ++k)
          for (std::size_t l = k + 1; l < n; ++l) consider({usable[i], usable[j], usable[k], usable[l]});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const CollinearSet& a, const CollinearSet& b) { return a.index > b.index; });
  if (found.size() > kMost) found.resize(kMost);
  return found;
}

}  // namespace myoid::identification
