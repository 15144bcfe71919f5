#include "myoid/identification/resting_torque.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/QR>

namespace myoid::identification {
namespace {

constexpr int kHighestDegree = 5;
constexpr double kRangePerDegree_rad = 20.0 * std::numbers::pi / 180.0;
constexpr Eigen::Index kFewest = 20;
/// Slower than this, in both directions, there is no viscosity to be seen.
constexpr double kMoving_radps = 0.05;

/// P_0 to P_(size-1) at x.
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

/// Position of the angle in the range, -1 to 1.
double position(const RestingTorque& torque, double angle_rad) {
  const double range = torque.highest_rad - torque.lowest_rad;
  if (!(range > 0.0)) return 0.0;
  return std::clamp(2.0 * (angle_rad - torque.lowest_rad) / range - 1.0, -1.0, 1.0);
}

}  // namespace

double RestingTorque::at(double angle_rad) const {
  return legendre(position(*this, angle_rad), coefficient_nm.size()).dot(coefficient_nm);
}

Eigen::VectorXd RestingTorque::at(const Eigen::VectorXd& angle_rad) const {
  return angle_rad.unaryExpr([this](double q) { return at(q); });
}

std::optional<RestingTorque> fit_resting_torque(const Eigen::VectorXd& angle_rad,
                                                const Eigen::VectorXd& velocity_radps,
                                                const Eigen::VectorXd& torque_nm) {
  const Eigen::Index n = angle_rad.size();
  if (n < kFewest || velocity_radps.size() != n || torque_nm.size() != n) return std::nullopt;
  if (!angle_rad.allFinite() || !velocity_radps.allFinite() || !torque_nm.allFinite())
    return std::nullopt;
  RestingTorque result{.lowest_rad = angle_rad.minCoeff(), .highest_rad = angle_rad.maxCoeff()};
  const double range = result.highest_rad - result.lowest_rad;
  const Eigen::Index terms =
      1 + std::min(kHighestDegree, static_cast<int>(range / kRangePerDegree_rad));
  const bool both_ways =
      velocity_radps.minCoeff() < -kMoving_radps && velocity_radps.maxCoeff() > kMoving_radps;
  Eigen::MatrixXd columns(n, terms + (both_ways ? 1 : 0));
  for (Eigen::Index i = 0; i < n; ++i)
    columns.row(i).head(terms) = legendre(position(result, angle_rad[i]), terms);
  if (both_ways) columns.col(terms) = -velocity_radps;
  const Eigen::VectorXd found = columns.colPivHouseholderQr().solve(torque_nm);
  result.coefficient_nm = found.head(terms);
  if (both_ways) result.viscosity_nms = found[terms];
  result.residual_nm = std::sqrt((columns * found - torque_nm).squaredNorm() /
                                 static_cast<double>(n));
  return result;
}

}  // namespace myoid::identification
