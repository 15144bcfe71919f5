#include "myoid/body/kinematics/valley_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include <Eigen/Cholesky>

#include "myoid/body/kinematics/joint_angles.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

constexpr double kEndPrice = 0.2;      ///< Price of a turn of one radian along the valley over the limb's part.
constexpr double kTwinPrice = 2.0;     ///< The same of the turn that brings other angles into their ranges.
constexpr double kMiddle_rad = 0.1;    ///< The middle angle turns no farther into its range.
constexpr double kShortest_rad = 0.2;  ///< Nearer ends are in the same minimum.
constexpr double kCorrelation = 0.9;   ///< Of the errors of two angles that make a valley.
constexpr double kTakesPart = 0.2;     ///< A coordinate with a lower rate ends no valley.
constexpr double kRidge = 1e-12;       ///< Over the greatest curvature: keeps the inverse finite.

bool is_ranged(const body::BodyModel& model, Eigen::Index c) {
  const body::Coordinate& of = model.coordinates[at(c)];
  return of.motion == body::MotionType::rotational && of.lower < of.upper && !model.is_constrained(static_cast<int>(c));
}

/// Two coordinates of which one turns back almost all that the other turns.
struct Valley {
  Eigen::Index first = -1;    ///< Of the model; turns by 1.
  Eigen::Index second = -1;   ///< The other one.
  Eigen::VectorXd direction;  ///< Rates of the model's coordinates.
  double price_m2 = 0.0;      ///< Rise of 2 J over one radian.
};

/// Returns the valley of the two coordinates whose errors are correlated most, if that is enough.
std::optional<Valley> valley_of(const body::BodyModel& model, const LimbMinimum& limb) {
  const Eigen::Index n = limb.curvature.rows();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(n, n);
  const Eigen::LLT<Eigen::MatrixXd> factor(limb.curvature + kRidge * limb.curvature.diagonal().maxCoeff() * one);
  if (factor.info() != Eigen::Success) return std::nullopt;
  const Eigen::MatrixXd inverse = factor.solve(one);
  double most = kCorrelation * kCorrelation;
  Eigen::Index first = -1, second = -1;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const double square = inverse(i, j) * inverse(i, j) / (inverse(i, i) * inverse(j, j));
      if (!(square > most) || !is_ranged(model, limb.coordinates[at(i)]) || !is_ranged(model, limb.coordinates[at(j)]))
        continue;
      most = square;
      first = inverse(i, i) > inverse(j, j) ? i : j;
      second = i + j - first;
    }
  }
  if (first < 0) return std::nullopt;
  Valley valley{limb.coordinates[at(first)], limb.coordinates[at(second)],
                Eigen::VectorXd::Zero(static_cast<Eigen::Index>(model.coordinates.size())),
                1.0 / inverse(first, first)};
  for (Eigen::Index i = 0; i < n; ++i)
    valley.direction[limb.coordinates[at(i)]] = inverse(i, first) / inverse(first, first);
  return valley;
}

/// Returns how far the valley goes until a coordinate meets the end of its range.
double length_of(const body::BodyModel& model, const Eigen::VectorXd& q, const Eigen::VectorXd& direction) {
  double length = 2.0 * kPi;
  for (Eigen::Index c = 0; c < q.size(); ++c) {
    if (std::abs(direction[c]) < kTakesPart || !is_ranged(model, c)) continue;
    const body::Coordinate& of = model.coordinates[at(c)];
    const double room = direction[c] > 0.0 ? of.upper - q[c] : q[c] - of.lower;
    length = std::min(length, std::max(0.0, room) / std::abs(direction[c]));
  }
  return length;
}

/// Returns the other angles of a joint brought into their ranges, if the sum of the ways is at most `longest_rad`.
std::optional<Eigen::VectorXd> ranged_twin(const body::BodyModel& model,
                                           const Eigen::VectorXd& q,
                                           const std::array<int, 3>& c,
                                           double middle,
                                           double longest_rad) {
  Eigen::VectorXd twin = q;
  double way = 0.0;
  const std::array<double, 3> angles{q[c[0]] + kPi, middle, q[c[2]] + kPi};
  for (std::size_t i = 0; i < 3; ++i) {
    const body::Coordinate& of = model.coordinates[at(c[i])];
    const double angle = turned_to_range(of, angles[i]);
    twin[c[i]] = std::clamp(angle, of.lower, of.upper);
    const double turn = std::abs(twin[c[i]] - angle);
    if (!is_ranged(model, c[i]) || (i == 1 && turn > kMiddle_rad)) return std::nullopt;
    way += turn;
  }
  if (way > longest_rad) return std::nullopt;
  return twin;
}

}  // namespace

std::vector<Eigen::VectorXd> valley_starts(const body::BodyModel& model,
                                           const Eigen::VectorXd& q,
                                           const LimbMinimum& limb) {
  std::vector<Eigen::VectorXd> starts;
  const std::optional<Valley> valley = valley_of(model, limb);
  if (!valley) return starts;
  if (valley->price_m2 < kEndPrice * limb.part_m2) {
    for (const double way : {-1.0, 1.0}) {
      const double length = length_of(model, q, way * valley->direction);
      if (length > kShortest_rad) starts.emplace_back(q + way * length * valley->direction);
    }
  }
  const body::Joint& joint = model.joints[at(model.coordinates[at(valley->first)].joint)];
  const auto angles = free_angles(model, joint);
  if (!angles || std::find(angles->begin(), angles->end(), valley->second) == angles->end()) return starts;
  const double longest_rad = std::sqrt(kTwinPrice * limb.part_m2 / valley->price_m2);
  for (const double middle : {kPi - q[(*angles)[1]], -q[(*angles)[1]]})
    if (auto twin = ranged_twin(model, q, *angles, middle, longest_rad)) starts.push_back(std::move(*twin));
  return starts;
}

}  // namespace myoid::body
