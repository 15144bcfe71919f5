#include "myoid/run/resting_torque.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/ground/math/decompositions.h"

namespace myoid::run {
namespace {

constexpr int kHighestDegree = 5;
constexpr double kRangePerDegree_rad = 15.0 * std::numbers::pi / 180.0;
/// Range below which a sine looks like a line.
constexpr double kWeightRange_rad = 15.0 * std::numbers::pi / 180.0;
constexpr double kLeftByWeight = 0.1;  ///< share of the variance
/// Number of independent samples for the beliefs about a weight and about the departure from its
/// sine: over some 40 degrees mean, sine and cosine hardly differ.
constexpr double kIndependent = 30.0;
constexpr Eigen::Index kFewest = 20;
/// Speed, in both directions, below which no viscosity shows.
constexpr double kMoving_radps = 0.05;

/// Returns P_0 to P_(size-1) at x.
Eigen::RowVectorXd legendre(double x, Eigen::Index size) {
  Eigen::RowVectorXd p(size);
  p[0] = 1.0;
  if (size > 1) p[1] = x;
  for (Eigen::Index k = 2; k < size; ++k) {
    const auto n = static_cast<double>(k);
    p[k] = ((2.0 * n - 1.0) * x * p[k - 1] - (n - 1.0) * p[k - 2]) / n;
  }
  return p;
}

/// Returns the position of the angle in the range, -1 to 1.
double position(const RestingTorque& torque, double angle_rad) {
  const double range = torque.highest_rad - torque.lowest_rad;
  if (!(range > 0.0)) return 0.0;
  return std::clamp(2.0 * (angle_rad - torque.lowest_rad) / range - 1.0, -1.0, 1.0);
}

/// Returns mean, sine and cosine coefficients of the angle that fit the torque best.
Eigen::Vector3d nearest_sine(const Eigen::VectorXd& angle_rad, const Eigen::VectorXd& torque_nm) {
  if (angle_rad.maxCoeff() - angle_rad.minCoeff() < kWeightRange_rad) return {torque_nm.mean(), 0.0, 0.0};
  const Eigen::Index n = angle_rad.size();
  const double weight = std::sqrt(kIndependent / static_cast<double>(n)) / fit::beliefs::kRestingTissue.sd;
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(n + 2, 3);
  columns.col(0).head(n).setConstant(weight);
  columns.col(1).head(n) = weight * angle_rad.array().sin();
  columns.col(2).head(n) = weight * angle_rad.array().cos();
  columns(n, 1) = columns(n + 1, 2) = 1.0 / fit::beliefs::kRestingWeight.sd;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 2);
  right.head(n) = weight * torque_nm;
  return math::nearest_solution(columns, right);
}

/// Sets the weight if the torque has the shape of a weight's.
void find_weight(const Eigen::VectorXd& angle_rad, const Eigen::VectorXd& torque_nm, RestingTorque& result) {
  const Eigen::Vector3d sine = nearest_sine(angle_rad, torque_nm);
  const double spread = (torque_nm.array() - torque_nm.mean()).square().sum();
  const double left = beside_weight(angle_rad, torque_nm).squaredNorm();
  if (left > kLeftByWeight * spread || sine.tail<2>().norm() > kLargestWeight_nm) return;
  result.weight_sin_nm = sine[1];
  result.weight_cos_nm = sine[2];
}

}  // namespace

Eigen::VectorXd beside_weight(const Eigen::VectorXd& angle_rad, const Eigen::VectorXd& torque_nm) {
  const Eigen::Vector3d sine = nearest_sine(angle_rad, torque_nm);
  return torque_nm.array() - sine[0] - sine[1] * angle_rad.array().sin() - sine[2] * angle_rad.array().cos();
}

double RestingTorque::at(double angle_rad) const {
  const double inside = legendre(position(*this, angle_rad), coefficient_nm.size()).dot(coefficient_nm);
  const double end_rad = std::clamp(angle_rad, lowest_rad, highest_rad);
  return inside + weight_sin_nm * (std::sin(angle_rad) - std::sin(end_rad)) +
         weight_cos_nm * (std::cos(angle_rad) - std::cos(end_rad));
}

Eigen::VectorXd RestingTorque::at(const Eigen::VectorXd& angle_rad) const {
  return angle_rad.unaryExpr([this](double q) { return at(q); });
}

std::optional<RestingTorque> fit_resting_torque(const Eigen::VectorXd& angle_rad,
                                                const Eigen::VectorXd& velocity_radps,
                                                const Eigen::VectorXd& torque_nm) {
  const Eigen::Index n = angle_rad.size();
  if (n < kFewest || velocity_radps.size() != n || torque_nm.size() != n) return std::nullopt;
  if (!angle_rad.allFinite() || !velocity_radps.allFinite() || !torque_nm.allFinite()) return std::nullopt;
  RestingTorque result{.lowest_rad = angle_rad.minCoeff(), .highest_rad = angle_rad.maxCoeff()};
  const double range = result.highest_rad - result.lowest_rad;
  const Eigen::Index terms = 1 + std::min(kHighestDegree, static_cast<int>(range / kRangePerDegree_rad));
  const bool both_ways = velocity_radps.minCoeff() < -kMoving_radps && velocity_radps.maxCoeff() > kMoving_radps;
  Eigen::MatrixXd columns(n, terms + (both_ways ? 1 : 0));
  for (Eigen::Index i = 0; i < n; ++i) columns.row(i).head(terms) = legendre(position(result, angle_rad[i]), terms);
  if (both_ways) columns.col(terms) = -velocity_radps;
  const Eigen::VectorXd found = math::nearest_solution(columns, torque_nm);
  result.coefficient_nm = found.head(terms);
  if (both_ways) result.viscosity_nms = found[terms];
  find_weight(angle_rad, torque_nm - columns.rightCols(both_ways ? 1 : 0) * found.tail(both_ways ? 1 : 0), result);
  result.residual_nm = std::sqrt((columns * found - torque_nm).squaredNorm() / static_cast<double>(n));
  return result;
}

}  // namespace myoid::run
