#include "myoid/identification/discrepancy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/Cholesky>

namespace myoid::identification {

double Discrepancy::reach(Eigen::Index j, double variance, double probability) const {
  std::vector<double> sd;
  double most = 0.0, all = 0.0;
  for (const Sizes& s : posterior) {
    sd.push_back(
        std::sqrt(variance + s.muscle * s.muscle * by_muscle[j] + s.joint * s.joint * by_joint[j]));
    most = std::max(most, sd.back());
    all += s.probability;
  }
  // What was left out is shared among the rest; beyond ten of the largest sd there is nothing.
  double low = 0.0, high = 10.0 * most;
  for (int step = 0; step < 60 && high > low; ++step) {
    const double middle = 0.5 * (low + high);
    double inside = 0.0;
    for (std::size_t k = 0; k < sd.size(); ++k)
      inside += posterior[k].probability / all *
                (sd[k] > 0.0 ? std::erf(middle / (std::sqrt(2.0) * sd[k])) : 1.0);
    (inside < probability ? low : high) = middle;
  }
  return high;
}

Discrepancy discrepancy(const Estimator& estimator,
                        const Estimator::Solution& solution,
                        const Eigen::MatrixXd& model_based) {
  constexpr double kPriorSize = 0.1;
  const ResidualModel& model = estimator.model();
  const Eigen::VectorXd& z = solution.search.x;
  const Weighting& weighting = solution.weighting;
  Evaluation at;
  model.evaluate(z, ResidualModel::Depth::gradient, at);
  const ErrorShapes shapes = model.error_shapes(z);
  const Eigen::VectorXd root = std::sqrt(weighting.share) * weighting.sd_nm.cwiseInverse();
  const Eigen::VectorXd residual = (model.measured() - at.predicted).cwiseProduct(root);
  const Eigen::MatrixXd s =
      shapes.weight.asDiagonal() * shapes.shapes_nm * root.asDiagonal();  // D S W^1/2
  // A parameter on its bound has not followed the data: what it would take out is in the residual.
  Eigen::MatrixXd gradient = at.gradient;
  Eigen::MatrixXd response = model_based;  // given those on their bound
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    const FreeParameter& f = estimator.free()[static_cast<std::size_t>(j)];
    const double margin = 1e-9 * (f.upper - f.lower);
    if (z[j] <= f.lower + margin || z[j] >= f.upper - margin) {
      gradient.row(j).setZero();
      const double variance = response(j, j);
      if (variance > 0.0) {
        const Eigen::VectorXd column = response.col(j);
        response -= column * column.transpose() / variance;
      }
      response.row(j).setZero();
      response.col(j).setZero();
    }
  }
  const Eigen::MatrixXd sj = s * root.asDiagonal() * gradient.transpose();
  // D C D and D h: directions of unit weight. Of the data as they are, A has nothing taken out.
  const Eigen::MatrixXd jacobian = gradient * root.asDiagonal();
  Eigen::MatrixXd a = jacobian * jacobian.transpose();
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    const double prior_sd = estimator.free()[static_cast<std::size_t>(j)].prior_sd;
    if (prior_sd > 0.0) a(j, j) += 1.0 / (prior_sd * prior_sd);
    a(j, j) = a(j, j) > 0.0 ? a(j, j) * (1.0 + 1e-12) : 1.0;
  }
  const Eigen::MatrixXd left = s * s.transpose() - sj * a.ldlt().solve(sj.transpose());
  Eigen::VectorXd h = s * residual;
  if (weighting.emg_variance.size() > 0) {
    // The noise of the EMG is in the shapes and in the residual alike: that product has a mean.
    const Eigen::MatrixXd noisy =
        shapes.weight.asDiagonal() * shapes.by_emg * shapes.unfiltered * root.asDiagonal();
    for (Eigen::Index b = 0; b < h.size(); ++b) {
      const int channel = shapes.channel[static_cast<std::size_t>(b)];
      if (channel < 0) continue;
      h[b] += estimator.channel_variance()[channel] *
              (noisy.row(b)
                   .transpose()
                   .cwiseProduct(root)
                   .cwiseProduct(weighting.emg_variance)
                   .cwiseProduct(model.noise_gain().row(channel).transpose()))
                  .dot(at.channel_torque.row(channel).transpose());
    }
  }
  // -2 log likelihood of h, up to a constant, with sizes e on the diagonal of E:
  //   log |I + E C E| - h'E (I + E C E)^-1 E h.
  const Eigen::Index count = h.size();
  const auto sizes = [&](double muscle, double joint) {
    Eigen::VectorXd e(count);
    for (Eigen::Index b = 0; b < count; ++b)
      e[b] = shapes.channel[static_cast<std::size_t>(b)] >= 0 ? muscle : joint;
    return e;
  };
  const auto misfit = [&](double muscle, double joint) {
    const Eigen::VectorXd e = sizes(muscle, joint);
    Eigen::MatrixXd m = e.asDiagonal() * left * e.asDiagonal();
    m.diagonal().array() += 1.0;
    const Eigen::LLT<Eigen::MatrixXd> factor(m);
    if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
    const Eigen::VectorXd eh = e.cwiseProduct(h);
    return 2.0 * factor.matrixLLT().diagonal().array().log().sum() - eh.dot(factor.solve(eh));
  };
  // A size is 0 in one case of two, else half normal: on a grid even in its logarithm.
  std::vector<double> grid{0.0}, prior{1.0};
  double others = 0.0;
  for (double size = 0.003; size < 0.5; size *= 1.25) {
    grid.push_back(size);
    prior.push_back(size * std::exp(-0.5 * std::pow(size / kPriorSize, 2)));
    others += prior.back();
  }
  for (std::size_t k = 1; k < prior.size(); ++k) prior[k] /= others;
  // Mean square of the sizes over their posterior.
  const auto points = static_cast<Eigen::Index>(grid.size());
  Eigen::MatrixXd values(points, points);
  for (Eigen::Index m = 0; m < points; ++m) {
    for (Eigen::Index j = 0; j < points; ++j)
      values(m, j) = misfit(grid[static_cast<std::size_t>(m)], grid[static_cast<std::size_t>(j)]);
  }
  const double least = values.minCoeff();
  double sum = 0.0, muscle_sum = 0.0, joint_sum = 0.0;
  for (Eigen::Index m = 0; m < points; ++m) {
    for (Eigen::Index j = 0; j < points; ++j) {
      const double muscle = grid[static_cast<std::size_t>(m)];
      const double joint = grid[static_cast<std::size_t>(j)];
      const double weight = prior[static_cast<std::size_t>(m)] *
                            prior[static_cast<std::size_t>(j)] *
                            std::exp(-0.5 * (values(m, j) - least));
      sum += weight;
      muscle_sum += weight * muscle * muscle;
      joint_sum += weight * joint * joint;
    }
  }
  Discrepancy result;
  result.relative_size = std::sqrt(muscle_sum / sum);
  result.joint_size = std::sqrt(joint_sum / sum);
  for (Eigen::Index m = 0; m < points; ++m) {
    for (Eigen::Index j = 0; j < points; ++j) {
      const auto at_m = static_cast<std::size_t>(m), at_j = static_cast<std::size_t>(j);
      const double share =
          prior[at_m] * prior[at_j] * std::exp(-0.5 * (values(m, j) - least)) / sum;
      if (share > 1e-4) result.posterior.push_back({grid[at_m], grid[at_j], share});
    }
  }
  const Eigen::MatrixXd unit = response * sj.transpose();
  result.by_muscle = (unit * sizes(1.0, 0.0).asDiagonal()).rowwise().squaredNorm();
  result.by_joint = (unit * sizes(0.0, 1.0).asDiagonal()).rowwise().squaredNorm();
  const Eigen::MatrixXd moved = unit * sizes(result.relative_size, result.joint_size).asDiagonal();
  result.covariance = moved * moved.transpose();
  return result;
}

}  // namespace myoid::identification
