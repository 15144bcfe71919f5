#include "myoid/ground/math/change_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/numbers.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::inline ground::math {
namespace {

void validate(const Eigen::MatrixXd& x, const ChangePointOptions& options) {
  if (x.rows() == 0 || x.cols() == 0) throw InvalidInput("change points: there is no sample");
  if (!x.allFinite()) throw InvalidInput("change points: a sample is not finite");
  if (options.min_length < 1) {
    throw InvalidInput(fmt::format("change points: min_length is {}; 1 is the least", options.min_length));
  }
  if (options.penalty && !(*options.penalty > 0.0)) {
    throw InvalidInput(fmt::format("change points: the penalty is {}; it must be positive", *options.penalty));
  }
  if (!(options.samples_per_independent > 0.0)) {
    throw InvalidInput(
        fmt::format("change points: samples_per_independent is {}; positive", options.samples_per_independent));
  }
  if (options.noise_sd && (options.noise_sd->size() != x.cols() || !(options.noise_sd->array() > 0.0).all())) {
    throw InvalidInput(fmt::format("change points: noise_sd needs {} positive values", x.cols()));
  }
}

Eigen::VectorXd noise_from_differences(const Eigen::MatrixXd& x) {
  Eigen::VectorXd sd = Eigen::VectorXd::Ones(x.cols());
  for (Eigen::Index j = 0; j < x.cols() && x.rows() > 1; ++j) {
    std::vector<double> differences;
    for (Eigen::Index i = 1; i < x.rows(); ++i) differences.push_back(std::abs(x(i, j) - x(i - 1, j)));
    const double robust = 1.482602218505602 * median(differences) / std::numbers::sqrt2;
    if (robust > 0.0) sd[j] = robust;
  }
  return sd;
}

/// Costs of segments from running sums; centering the columns first keeps their digits.
class Costs {
 public:
  Costs(const Eigen::MatrixXd& x, SegmentCost kind, const Eigen::VectorXd& noise_sd)
      : kind_(kind), noise_sd_(noise_sd), mean_(x.colwise().mean().transpose()) {
    const Eigen::Index n = x.rows();
    sums_ = Eigen::MatrixXd::Zero(x.cols(), n + 1);
    squares_ = Eigen::MatrixXd::Zero(x.cols(), n + 1);
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::VectorXd centered = x.row(i).transpose() - mean_;
      sums_.col(i + 1) = sums_.col(i) + centered;
      squares_.col(i + 1) = squares_.col(i) + centered.cwiseAbs2();
    }
    floor_ = (1e-8 * squares_.col(n) / static_cast<double>(n)).cwiseMax(1e-300);
  }

  [[nodiscard]] double operator()(Eigen::Index begin, Eigen::Index end) const {
    const auto count = static_cast<double>(end - begin);
    double cost = 0.0;
    for (Eigen::Index j = 0; j < sums_.rows(); ++j) {
      const double sum = sums_(j, end) - sums_(j, begin);
      double squares = squares_(j, end) - squares_(j, begin);
      if (kind_ != SegmentCost::variance) squares = std::max(squares - sum * sum / count, 0.0);
      if (kind_ == SegmentCost::mean) {
        cost += squares / (noise_sd_[j] * noise_sd_[j]);
      } else {
        // The least cost over all variances v >= floor: pruning needs a minimum over parameters.
        const double v = std::max(squares / count, floor_[j]);
        cost += count * std::log(2.0 * std::numbers::pi * v) + squares / v;
      }
    }
    return cost;
  }

  [[nodiscard]] Segment describe(Eigen::Index begin, Eigen::Index end) const {
    const auto count = static_cast<double>(end - begin);
    const Eigen::VectorXd offset = (sums_.col(end) - sums_.col(begin)) / count;
    const Eigen::VectorXd variance =
        ((squares_.col(end) - squares_.col(begin)) / count - offset.cwiseAbs2()).cwiseMax(0.0);
    return {.begin = begin, .end = end, .mean = mean_ + offset, .variance = variance};
  }

 private:
  SegmentCost kind_;
  Eigen::VectorXd noise_sd_, mean_, floor_;
  Eigen::MatrixXd sums_, squares_;  // Column i: sums over the first i samples.
};

/// A start of the last segment that may still be the best.
struct Candidate {
  Eigen::Index begin;
  Eigen::Index useless_from;  ///< From this end on another start is at least as good.
};

}  // namespace

ChangePoints change_points(const Eigen::MatrixXd& x, const ChangePointOptions& options) {
  validate(x, options);
  const Eigen::Index n = x.rows(), shortest = options.min_length;
  ChangePoints result;
  if (options.cost == SegmentCost::mean)
    result.noise_sd = options.noise_sd ? *options.noise_sd : noise_from_differences(x);
  const auto columns = static_cast<double>(x.cols());
  const double parameters = options.cost == SegmentCost::mean_and_variance ? 2.0 * columns : columns;
  const double criterion = (parameters + 1.0) * std::log(static_cast<double>(std::max<Eigen::Index>(n, 2)));
  result.penalty = options.penalty.value_or(criterion) * options.samples_per_independent;

  // best[t] is the least cost of the first t samples; best[0] cancels the penalty of the first segment.
  const Costs costs(x, options.cost, result.noise_sd);
  std::vector<double> best(static_cast<std::size_t>(n + 1), kInfinity);
  std::vector<Eigen::Index> last(static_cast<std::size_t>(n + 1), 0);
  best[0] = -result.penalty;
  std::vector<Candidate> candidates;
  std::vector<double> through;
  for (Eigen::Index end = std::min(shortest, n); end <= n; ++end) {
    if (end % 1024 == 0) options.progress.check();
    const Eigen::Index newest = std::max<Eigen::Index>(end - shortest, 0);
    if (best[static_cast<std::size_t>(newest)] < kInfinity) candidates.push_back({newest, n + 1});
    std::erase_if(candidates, [&](const Candidate& c) { return c.useless_from <= end; });
    double& least = best[static_cast<std::size_t>(end)];
    through.clear();
    for (const Candidate& c : candidates) {
      through.push_back(best[static_cast<std::size_t>(c.begin)] + costs(c.begin, end));
      if (through.back() + result.penalty < least) {
        least = through.back() + result.penalty;
        last[static_cast<std::size_t>(end)] = c.begin;
      }
    }
    // A start that is worse here even without the penalty remains worse once a segment fits after it.
    for (std::size_t k = 0; k < candidates.size(); ++k) {
      if (through[k] >= least) candidates[k].useless_from = std::min(candidates[k].useless_from, end + shortest);
    }
  }
  result.cost = best[static_cast<std::size_t>(n)];
  for (Eigen::Index end = n; end > 0; end = last[static_cast<std::size_t>(end)])
    result.segments.push_back(costs.describe(last[static_cast<std::size_t>(end)], end));
  std::reverse(result.segments.begin(), result.segments.end());
  return result;
}

}  // namespace myoid::inline ground::math
