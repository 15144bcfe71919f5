#include "myoid/math/bootstrap.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/core/error.h"
#include "myoid/math/statistics.h"

namespace myoid::math {
namespace {

/// Appends `count` indices of a piece that begins at `first`, drawn in blocks.
void draw_piece(std::vector<Eigen::Index>& indices,
                Eigen::Index first,
                Eigen::Index count,
                Eigen::Index length,
                BlockScheme scheme,
                Random& random) {
  const Eigen::Index block = std::min(length, count);
  Eigen::Index at = 0, left = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const bool fresh = scheme == BlockScheme::stationary
                           ? i == 0 || random.uniform() * static_cast<double>(block) < 1.0
                           : left == 0;
    if (fresh) {
      at = random.below(scheme == BlockScheme::moving ? count - block + 1 : count);
      left = block;
    }
    indices.push_back(first + at);
    at = (at + 1) % count;
    --left;
  }
}

/// R(k) = 1/n sum x_t x_{t+k} about the common mean, pairs within pieces only.
double autocovariance(const Eigen::VectorXd& x,
                      const std::vector<Eigen::Index>& pieces,
                      Eigen::Index lag) {
  double sum = 0.0;
  Eigen::Index first = 0;
  for (const Eigen::Index piece : pieces) {
    if (piece > lag) {
      sum += x.segment(first, piece - lag).dot(x.segment(first + lag, piece - lag));
    }
    first += piece;
  }
  return sum / static_cast<double>(x.size());
}

double normal_share(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

std::vector<double> sorted_replicates(const Eigen::VectorXd& replicates, double level) {
  if (replicates.size() < 2) {
    throw InvalidInput(
        fmt::format("bootstrap interval: {} replicates; 2 are the least", replicates.size()));
  }
  if (!replicates.allFinite()) throw InvalidInput("bootstrap interval: a replicate is not finite");
  if (!(level > 0.0 && level < 1.0))
    throw InvalidInput(fmt::format("bootstrap interval: level {}; between 0 and 1", level));
  std::vector<double> sorted(replicates.begin(), replicates.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

double order_statistic(const std::vector<double>& sorted, double share) {
  const auto count = static_cast<double>(sorted.size());
  const double rank = std::clamp(share * (count + 1.0), 1.0, count);
  const auto below = static_cast<std::size_t>(std::floor(rank));
  if (below >= sorted.size()) return sorted.back();
  const double part = rank - std::floor(rank);
  return sorted[below - 1] + part * (sorted[below] - sorted[below - 1]);
}

}  // namespace

std::vector<Eigen::Index> block_bootstrap_indices(const std::vector<Eigen::Index>& pieces,
                                                  Eigen::Index length,
                                                  BlockScheme scheme,
                                                  Random& random) {
  if (length < 1)
    throw InvalidInput(fmt::format("bootstrap: blocks of {} samples; 1 is the least", length));
  std::vector<Eigen::Index> indices;
  Eigen::Index first = 0;
  for (const Eigen::Index piece : pieces) {
    if (piece < 0) throw InvalidInput(fmt::format("bootstrap: a piece of {} samples", piece));
    draw_piece(indices, first, piece, length, scheme, random);
    first += piece;
  }
  return indices;
}

std::vector<Eigen::Index> cluster_bootstrap_indices(Eigen::Index clusters, Random& random) {
  if (clusters < 1)
    throw InvalidInput(fmt::format("bootstrap: {} clusters; 1 is the least", clusters));
  std::vector<Eigen::Index> drawn(static_cast<std::size_t>(clusters));
  for (Eigen::Index& cluster : drawn) cluster = random.below(clusters);
  std::sort(drawn.begin(), drawn.end());
  return drawn;
}

double block_length(const Eigen::Ref<const Eigen::VectorXd>& x,
                    const std::vector<Eigen::Index>& pieces,
                    BlockScheme scheme) {
  const Eigen::Index n = x.size();
  if (std::accumulate(pieces.begin(), pieces.end(), Eigen::Index{0}) != n || n == 0) {
    throw InvalidInput(
        fmt::format("block_length: the pieces do not add up to {} samples, or there is none", n));
  }
  const Eigen::Index longest = *std::max_element(pieces.begin(), pieces.end());
  const Eigen::VectorXd centered = x.array() - x.mean();
  const double variance = autocovariance(centered, pieces, 0);
  if (!(variance > 0.0)) return 1.0;

  // The first lag after which K correlations in a row are within chance.
  const auto count = static_cast<double>(n);
  const double chance = 2.0 * std::sqrt(std::log10(std::max(count, 2.0)) / count);
  const auto in_a_row =
      std::max<Eigen::Index>(5, static_cast<Eigen::Index>(std::ceil(std::sqrt(std::log10(count)))));
  const Eigen::Index most = std::min<Eigen::Index>(
      longest - 1, static_cast<Eigen::Index>(std::ceil(std::sqrt(count))) * 4 + in_a_row);
  Eigen::Index last_large = 0, quiet = 0;
  for (Eigen::Index k = 1; k <= most && quiet < in_a_row; ++k) {
    const bool large = std::abs(autocovariance(centered, pieces, k)) >= chance * variance;
    quiet = large ? 0 : quiet + 1;
    if (large) last_large = k;
  }
  const Eigen::Index window = std::min(std::max<Eigen::Index>(2 * last_large, 1), longest - 1);

  double g = variance, weighted = 0.0;
  for (Eigen::Index k = 1; k <= window; ++k) {
    const double t = static_cast<double>(k) / static_cast<double>(window);
    const double lambda = t <= 0.5 ? 1.0 : 2.0 * (1.0 - t);
    const double both_sides = 2.0 * lambda * autocovariance(centered, pieces, k);
    g += both_sides;
    weighted += static_cast<double>(k) * both_sides;
  }
  const double d = (scheme == BlockScheme::stationary ? 2.0 : 4.0 / 3.0) * g * g;
  if (!(d > 0.0)) return static_cast<double>(longest);
  return std::clamp(std::cbrt(2.0 * weighted * weighted / d * count), 1.0,
                    static_cast<double>(longest));
}

Eigen::VectorXd BootstrapResult::mean() const { return estimates.colwise().mean().transpose(); }

Eigen::MatrixXd BootstrapResult::covariance() const {
  const Eigen::MatrixXd centered = estimates.rowwise() - estimates.colwise().mean();
  return centered.transpose() * centered /
         static_cast<double>(std::max<Eigen::Index>(estimates.rows() - 1, 1));
}

BootstrapResult bootstrap(const DrawIndices& draw,
                          const EstimateFromIndices& estimate,
                          const BootstrapOptions& options) {
  if (options.replicates < 1)
    throw InvalidInput(fmt::format("bootstrap: {} replicates; 1 is the least", options.replicates));
  std::vector<std::optional<Eigen::VectorXd>> all(static_cast<std::size_t>(options.replicates));
  std::atomic<std::size_t> done{0};
  oneapi::tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    options.progress.check();
    Random random(options.seed, k);
    all[k] = estimate(draw(random));
    options.progress.tell(static_cast<double>(++done) / static_cast<double>(all.size()),
                          "bootstrap replicates");
  });
  BootstrapResult result;
  std::vector<Eigen::VectorXd> found;
  for (const std::optional<Eigen::VectorXd>& one : all) {
    if (!one || !one->allFinite()) {
      ++result.failed;
      continue;
    }
    if (!found.empty() && one->size() != found.front().size())
      throw InvalidInput("bootstrap: the estimates of two replicates differ in size");
    found.push_back(*one);
  }
  result.estimates.resize(static_cast<Eigen::Index>(found.size()),
                          found.empty() ? 0 : found.front().size());
  for (std::size_t k = 0; k < found.size(); ++k)
    result.estimates.row(static_cast<Eigen::Index>(k)) = found[k].transpose();
  return result;
}

BootstrapInterval percentile_interval(const Eigen::Ref<const Eigen::VectorXd>& replicates,
                                      double level) {
  const std::vector<double> sorted = sorted_replicates(replicates, level);
  return {order_statistic(sorted, (1.0 - level) / 2.0),
          order_statistic(sorted, (1.0 + level) / 2.0)};
}

std::optional<BootstrapInterval> bca_interval(const Eigen::Ref<const Eigen::VectorXd>& replicates,
                                              double estimate,
                                              const Eigen::Ref<const Eigen::VectorXd>& jackknife,
                                              double level) {
  const std::vector<double> sorted = sorted_replicates(replicates, level);
  const auto [low, high] = std::equal_range(sorted.begin(), sorted.end(), estimate);
  const double below =
      static_cast<double>(low - sorted.begin()) + 0.5 * static_cast<double>(high - low);
  const double share = below / static_cast<double>(sorted.size());
  if (share <= 0.0 || share >= 1.0) return std::nullopt;
  const double z0 = normal_quantile(share);
  double acceleration = 0.0;
  if (jackknife.size() > 1) {
    const Eigen::ArrayXd d = jackknife.mean() - jackknife.array();
    const double squares = d.square().sum();
    if (squares > 0.0) acceleration = d.cube().sum() / (6.0 * std::pow(squares, 1.5));
  }
  const auto moved = [&](double tail) {
    const double z = z0 + normal_quantile(tail);
    return normal_share(z0 + z / (1.0 - acceleration * z));
  };
  return BootstrapInterval{order_statistic(sorted, moved((1.0 - level) / 2.0)),
                           order_statistic(sorted, moved((1.0 + level) / 2.0))};
}

}  // namespace myoid::math
