#include "myoid/body/kinematics/posture_table.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace myoid::body {
namespace {

constexpr Eigen::Index kSamples = 8;  ///< Postures whose nearest neighbor is sought.
constexpr double kNeighbors = 1.7;    ///< Squared distance of neighbors over that of the nearest.
constexpr Eigen::Index kRanked = 48;  ///< Postures that may be a minimum: the best of all.

}  // namespace

PostureTable::PostureTable(Eigen::MatrixXd postures, const Eigen::MatrixXd& places_m)
    : postures_(std::move(postures)), places_m_(places_m.transpose()) {
  const Eigen::Index count = places_m_.cols(), markers = places_m_.rows() / 3;
  terms_.resize(count, 4 * markers);
  for (Eigen::Index m = 0; m < markers; ++m) {
    const auto xyz = places_m.middleCols(3 * m, 3);
    terms_.middleCols(4 * m, 3) = xyz;
    terms_.col(4 * m + 3) = xyz.rowwise().squaredNorm();
  }
  std::vector<double> nearest;
  for (Eigen::Index i = 0; i < count; i += std::max<Eigen::Index>(1, count / kSamples)) {
    double least = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < count; ++j)
      if (j != i) least = std::min(least, (places_m_.col(i) - places_m_.col(j)).squaredNorm());
    nearest.push_back(least);
  }
  const auto middle = nearest.begin() + static_cast<std::ptrdiff_t>(nearest.size() / 2);
  std::nth_element(nearest.begin(), middle, nearest.end());
  if (middle != nearest.end()) near_m2_ = kNeighbors * *middle;
}

std::vector<Eigen::Index> PostureTable::minima(const std::vector<Target>& targets, std::size_t count) const {
  Eigen::VectorXd factors(terms_.cols());
  for (std::size_t m = 0; m < targets.size(); ++m)
    factors.segment<4>(static_cast<Eigen::Index>(4 * m)) << -2.0 * targets[m].weight * targets[m].place_m,
        targets[m].weight;
  const Eigen::VectorXd costs = terms_ * factors;  // less a part that all postures share
  std::vector<Eigen::Index> ranked(static_cast<std::size_t>(costs.size()));
  std::iota(ranked.begin(), ranked.end(), Eigen::Index{0});
  const auto end = ranked.begin() + std::min(kRanked, costs.size());
  std::partial_sort(ranked.begin(), end, ranked.end(),
                    [&](Eigen::Index a, Eigen::Index b) { return costs[a] < costs[b]; });
  std::vector<Eigen::Index> minima;
  for (auto row = ranked.begin(); row != end && minima.size() < count; ++row) {
    const bool has_better_neighbor = std::any_of(ranked.begin(), row, [&](Eigen::Index better) {
      return (places_m_.col(*row) - places_m_.col(better)).squaredNorm() < near_m2_;
    });
    if (!has_better_neighbor) minima.push_back(*row);
  }
  return minima;
}

}  // namespace myoid::body
