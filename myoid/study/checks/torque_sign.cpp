#include "myoid/study/checks/torque_sign.h"

#include <algorithm>
#include <cmath>

namespace myoid::study {
namespace {

/// Returns 1 - min |A g - b|^2 / |b|^2 over g >= 0, by coordinate descent on A'A, which falls at every step.
double share_of(const Eigen::MatrixXd& square, const Eigen::VectorXd& projected, double total) {
  constexpr int kRounds = 200;
  Eigen::VectorXd gains = Eigen::VectorXd::Zero(projected.size());
  Eigen::VectorXd slope = -projected;
  for (int round = 0; round < kRounds; ++round) {
    double moved = 0.0;
    for (Eigen::Index k = 0; k < gains.size(); ++k) {
      if (!(square(k, k) > 0.0)) continue;
      const double wanted = std::max(0.0, gains[k] - slope[k] / square(k, k));
      const double change = wanted - gains[k];
      if (change == 0.0) continue;
      gains[k] = wanted;
      slope += change * square.col(k);
      moved = std::max(moved, std::abs(change) * std::sqrt(square(k, k)));
    }
    if (moved * moved < 1e-12 * total) break;
  }
  // |A g - b|^2 = g'(A'A g - A'b) - g'A'b + b'b, with slope = A'A g - A'b.
  const double left = gains.dot(slope) - gains.dot(projected) + total;
  return 1.0 - std::max(0.0, left) / total;
}

}  // namespace

SignsExplained signs_explained(const Eigen::MatrixXd& muscle_torque_nm, const Eigen::VectorXd& torque_nm) {
  const double total = torque_nm.squaredNorm();
  if (!(total > 0.0)) return {};
  const Eigen::MatrixXd square = muscle_torque_nm.transpose() * muscle_torque_nm;
  const Eigen::VectorXd projected = muscle_torque_nm.transpose() * torque_nm;
  return {share_of(square, projected, total), share_of(square, -projected, total)};
}

}  // namespace myoid::study
