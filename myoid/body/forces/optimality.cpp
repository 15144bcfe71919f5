#include "myoid/body/forces/optimality.h"

#include <algorithm>
#include <cmath>

namespace myoid::body {

double kkt_residual(const SharingProblem& problem, const SharingSolution& solution) {
  const Eigen::MatrixXd a = problem.moment_arm * problem.optimal_force.asDiagonal();
  const Eigen::VectorXd& x = solution.activation;
  double worst = 0.0;
  for (Eigen::Index k = 0; k < a.rows(); ++k) {
    double scale = std::abs(problem.torque[k]) + std::abs(solution.reserve_torque[k]);
    for (Eigen::Index i = 0; i < x.size(); ++i) scale = std::max(scale, std::abs(a(k, i) * x[i]));
    const double balance = a.row(k).dot(x) + solution.reserve_torque[k] - problem.torque[k];
    if (scale > 0.0) worst = std::max(worst, std::abs(balance) / scale);
  }
  const double p = problem.exponent;
  const Eigen::VectorXd pull = a.transpose() * solution.multiplier;
  double scale = pull.size() > 0 ? pull.cwiseAbs().maxCoeff() : 0.0;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    const double w = problem.weight.size() > 0 ? problem.weight[i] : 1.0;
    const double power = x[i] == 0.0 ? 0.0 : std::copysign(p * w * std::pow(std::abs(x[i]), p - 1.0), x[i]);
    const double emg = problem.emg.size() > 0 ? 2.0 * problem.emg_weight * (x[i] - problem.emg[i]) : 0.0;
    const double gradient = power + emg - pull[i];
    scale = std::max({scale, std::abs(power), 1e-12});
    double violation = std::abs(gradient);
    if (x[i] <= problem.lower[i]) violation = std::max(0.0, -gradient);
    if (x[i] >= problem.upper[i]) violation = std::max(0.0, gradient);
    if (problem.lower[i] == problem.upper[i]) violation = 0.0;
    worst = std::max(worst, violation / std::max(scale, 1.0));
    worst = std::max({worst, problem.lower[i] - x[i], x[i] - problem.upper[i]});
  }
  return worst;
}

}  // namespace myoid::body
