#include "tests/coverage/seen_strength.h"

#include <cmath>

#include <Eigen/Cholesky>

namespace myoid::fit {

Eigen::VectorXd log_strength(const ParameterMap& map,
                             const std::vector<TrialRun>& runs,
                             const std::vector<RunEvaluation>& at,
                             const Unseen& unseen,
                             const Eigen::VectorXd& x) {
  const Eigen::Index muscles = runs.front().arm_m.cols();
  Eigen::MatrixXd square = Eigen::MatrixXd::Zero(muscles, muscles);
  Eigen::VectorXd product = Eigen::VectorXd::Zero(muscles);
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Eigen::MatrixXd torque(runs[r].arm_m.rows(), muscles);
    for (Eigen::Index k = 0; k < muscles; ++k)
      torque.col(k) = runs[r].arm_m.col(k).cwiseProduct(at[r].muscle(static_cast<std::size_t>(k)).force_n);
    square += torque.transpose() * torque;
    product += torque.transpose() * (unseen.columns[r] * x);
  }
  const Eigen::VectorXd relative = square.ldlt().solve(product);
  Eigen::VectorXd change = Eigen::VectorXd::Zero(map.size());
  for (Eigen::Index j = 0; j < map.size(); ++j) {
    const Unknown& of = map.free()[static_cast<std::size_t>(j)];
    if (of.is(Scope::muscle, kMaxForce)) change[j] = 2.0 * std::asinh(0.5 * relative[of.targets.front().owner]);
  }
  return change;
}

}  // namespace myoid::fit
