#include "myoid/intervals/discrepancy.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>

#include "myoid/beliefs/beliefs.h"
#include "myoid/core/numbers.h"
#include "myoid/core/units.h"
#include "myoid/intervals/score_blocks.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// A possible size of an error, with its prior probability.
struct PossibleSize {
  double size = 0.0, probability = 1.0;
};

/// Returns the prior: 0 in one case of two, else half normal 0.1 on a logarithmic grid. Without any
/// errors the size is 0.
std::vector<PossibleSize> possible_sizes(bool any_errors) {
  std::vector<PossibleSize> sizes{{0.0, 1.0}};
  if (!any_errors) return sizes;
  double sum = 0.0;
  for (double size = 0.003; size < 0.5; size *= 1.25) {
    sizes.push_back({size, size * std::exp(-0.5 * std::pow(size / beliefs::kModelError.sd, 2))});
    sum += sizes.back().probability;
  }
  for (std::size_t k = 1; k < sizes.size(); ++k) sizes[k].probability *= 0.5 / sum;
  sizes.front().probability = 0.5;
  return sizes;
}

/// Returns the size of every shape: `muscle` for a muscle's, `joint` for a joint's.
Eigen::VectorXd sizes_of(const std::vector<bool>& of_muscle, double muscle, double joint) {
  Eigen::VectorXd e(static_cast<Eigen::Index>(of_muscle.size()));
  for (std::size_t b = 0; b < of_muscle.size(); ++b) e[static_cast<Eigen::Index>(b)] = of_muscle[b] ? muscle : joint;
  return e;
}

/// Returns -2 log likelihood of h ~ N(0, C + C E^2 C) up to a constant, with sizes e on the
/// diagonal of E: log |I + E C E| - h'E (I + E C E)^-1 E h.
double misfit(const Eigen::MatrixXd& c, const Eigen::VectorXd& h, const Eigen::VectorXd& e) {
  Eigen::MatrixXd m = e.asDiagonal() * c * e.asDiagonal();
  m.diagonal().array() += 1.0;
  const Eigen::LLT<Eigen::MatrixXd> factor(m);
  if (factor.info() != Eigen::Success) return std::numeric_limits<double>::infinity();
  const Eigen::VectorXd eh = e.cwiseProduct(h);
  return 2.0 * factor.matrixLLT().diagonal().array().log().sum() - eh.dot(factor.solve(eh));
}

/// Returns the pairs of sizes with a posterior probability above 1e-4.
std::vector<Discrepancy::Sizes> posterior_sizes(const Eigen::MatrixXd& c,
                                                const Eigen::VectorXd& h,
                                                const std::vector<bool>& of_muscle) {
  const auto any = [&](bool muscle) {
    return std::find(of_muscle.begin(), of_muscle.end(), muscle) != of_muscle.end();
  };
  std::vector<Discrepancy::Sizes> all;
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> misfits;
  for (const PossibleSize& muscle : possible_sizes(any(true))) {
    for (const PossibleSize& joint : possible_sizes(any(false))) {
      all.push_back({muscle.size, joint.size, muscle.probability * joint.probability});
      misfits.push_back(misfit(c, h, sizes_of(of_muscle, muscle.size, joint.size)));
      least = std::min(least, misfits.back());
    }
  }
  double sum = 0.0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    all[k].probability *= std::exp(-0.5 * (misfits[k] - least));
    sum += all[k].probability;
  }
  for (Discrepancy::Sizes& of : all) of.probability /= sum;
  all.erase(
      std::remove_if(all.begin(), all.end(), [](const Discrepancy::Sizes& of) { return !(of.probability > 1e-4); }),
      all.end());
  return all;
}

bool on_bound(const Unknown& p, double z) {
  const double margin = 1e-9 * (p.bounds.upper - p.bounds.lower);
  return z <= p.bounds.lower + margin || z >= p.bounds.upper - margin;
}

/// Gradient of the prediction (p x n) and response of the estimates (p x p, A^-1), given the parameters on their
/// bounds. These do not follow the data, so their part of an error stays in the residual.
struct Followed {
  Eigen::MatrixXd gradient, response;
};

Followed given_bounds(const std::vector<Unknown>& free, const Eigen::VectorXd& z, Followed of) {
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    if (!on_bound(free[static_cast<std::size_t>(j)], z[j])) continue;
    of.gradient.row(j).setZero();
    const double variance = of.response(j, j);
    if (variance > 0.0) {
      const Eigen::VectorXd column = of.response.col(j);
      of.response -= column * column.transpose() / variance;
    }
    of.response.row(j).setZero();
    of.response.col(j).setZero();
  }
  return of;
}

/// Returns the mean of each shape's product with the residual that the EMG's noise causes; the
/// noise is in both factors. `root`: n, (nu W)^1/2.
Eigen::VectorXd mean_by_emg_noise(const Estimator& estimator,
                                  const Weighting& weighting,
                                  const ErrorShapes& shapes,
                                  const Eigen::MatrixXd& channel_torque,
                                  const Eigen::VectorXd& root) {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(shapes.shapes_nm.rows());
  const Eigen::MatrixXd noisy = shapes.by_emg * shapes.unfiltered * root.asDiagonal();
  for (Eigen::Index b = 0; b < mean.size(); ++b) {
    const int channel = shapes.channel[static_cast<std::size_t>(b)];
    if (channel < 0) continue;
    mean[b] = estimator.channel_variance()[channel] *
              (noisy.row(b)
                   .transpose()
                   .cwiseProduct(root)
                   .cwiseProduct(weighting.emg_variance)
                   .cwiseProduct(estimator.model().noise_gain().row(channel).transpose()))
                  .dot(channel_torque.row(channel).transpose());
  }
  return mean;
}

/// Returns the rows of `errors` that are not 0: combinations of shapes that are model errors.
std::vector<Eigen::Index> rows_of_errors(const Eigen::MatrixXd& errors) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index b = 0; b < errors.rows(); ++b) {
    if (errors.row(b).norm() > 1e-9) kept.push_back(b);
  }
  return kept;
}

}  // namespace

double Discrepancy::reach(Eigen::Index j, double variance, double probability) const {
  std::vector<double> sd;
  double most = 0.0, all = 0.0;
  for (const Sizes& s : posterior) {
    sd.push_back(std::sqrt(variance + s.muscle * s.muscle * by_muscle[j] + s.joint * s.joint * by_joint[j]));
    most = std::max(most, sd.back());
    all += s.probability;
  }
  if (!(most > 0.0) || !std::isfinite(most)) return most;
  // The remaining pairs share the probability of the pairs below 1e-4. The probability within x is
  // concave in x, so Newton's steps from below stay below the root.
  double x = math::normal_quantile(0.5 + 0.5 * probability) * *std::min_element(sd.begin(), sd.end());
  for (int count = 0; count < 60; ++count) {
    double inside = 0.0, density = 0.0;
    for (std::size_t k = 0; k < sd.size(); ++k) {
      const double share = posterior[k].probability / all;
      const double u = sd[k] > 0.0 ? x / (std::sqrt(2.0) * sd[k]) : kInfinity;
      inside += share * std::erf(u);
      if (sd[k] > 0.0) density += share * std::sqrt(2.0 / kPi) / sd[k] * std::exp(-u * u);
    }
    const double step = (probability - inside) / density;
    if (!(step > 1e-13 * x)) break;
    x += step;
  }
  return x;
}

Discrepancy discrepancy(const Estimator& estimator,
                        const Estimator::Solution& solution,
                        const Eigen::MatrixXd& model_based) {
  const ResidualModel& model = estimator.model();
  const Eigen::VectorXd& z = solution.search.x;
  const Weighting& weighting = solution.weighting;
  Evaluation at;
  model.evaluate(z, ResidualModel::Depth::gradient, at);
  const ErrorShapes shapes = model.error_shapes(z);
  const Eigen::VectorXd root = std::sqrt(weighting.share) * weighting.sd_nm.cwiseInverse();
  const Eigen::VectorXd residual = (model.measured() - at.predicted).cwiseProduct(root);
  const Eigen::MatrixXd every = shapes.shapes_nm * root.asDiagonal();  // S W^1/2
  const auto [gradient, response] =
      given_bounds(estimator.free(), z, {.gradient = at.gradient, .response = model_based});
  Eigen::VectorXd along = every * residual;
  if (weighting.emg_variance.size() > 0)
    along += mean_by_emg_noise(estimator, weighting, shapes, at.channel_torque, root);
  // Keeps the errors alone, in directions of unit weight: from here S stands for D S.
  const Eigen::MatrixXd errors = shapes.weight.asDiagonal() * shapes.contrast;
  const std::vector<Eigen::Index> kept = rows_of_errors(errors);
  const Eigen::MatrixXd s = errors(kept, Eigen::all) * every;
  const Eigen::VectorXd h = errors(kept, Eigen::all) * along;
  const Eigen::MatrixXd sj = s * root.asDiagonal() * gradient.transpose();
  // A = J W J' + P without subtraction.
  const Eigen::MatrixXd rows = gradient * root.asDiagonal();
  const Eigen::MatrixXd a = with_priors_invertible(rows * rows.transpose(), estimator);
  const Eigen::MatrixXd left = s * s.transpose() - sj * a.ldlt().solve(sj.transpose());
  std::vector<bool> of_muscle;
  for (const Eigen::Index b : kept) of_muscle.push_back(shapes.channel[static_cast<std::size_t>(b)] >= 0);
  Discrepancy result;
  result.posterior = posterior_sizes(left, h, of_muscle);
  for (const Discrepancy::Sizes& of : result.posterior) {
    result.relative_size += of.probability * of.muscle * of.muscle;
    result.joint_size += of.probability * of.joint * of.joint;
  }
  result.relative_size = std::sqrt(result.relative_size);
  result.joint_size = std::sqrt(result.joint_size);
  const Eigen::MatrixXd unit = response * sj.transpose();
  result.by_muscle = (unit * sizes_of(of_muscle, 1.0, 0.0).asDiagonal()).rowwise().squaredNorm();
  result.by_joint = (unit * sizes_of(of_muscle, 0.0, 1.0).asDiagonal()).rowwise().squaredNorm();
  const Eigen::MatrixXd moved = unit * sizes_of(of_muscle, result.relative_size, result.joint_size).asDiagonal();
  result.covariance = moved * moved.transpose();
  return result;
}

}  // namespace myoid::identification
