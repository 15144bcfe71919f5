#include "myoid/identification/estimator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Eigenvalues>

#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

constexpr double kHuber = 1.345;
constexpr double kCauchy = 2.385;

/// rho(u) and psi(u) / u of a standardized residual.
struct LossValue {
  double rho = 0.0;
  double weight = 1.0;
};

LossValue loss(Loss kind, double u) {
  if (kind == Loss::huber) {
    const double size = std::abs(u);
    if (size <= kHuber) return {u * u, 1.0};
    return {kHuber * (2.0 * size - kHuber), kHuber / size};
  }
  if (kind == Loss::cauchy) {
    const double x = u / kCauchy;
    return {kCauchy * kCauchy * std::log1p(x * x), 1.0 / (1.0 + x * x)};
  }
  return {u * u, 1.0};
}

/// Both variances by weighted regression of the squared residuals on [1, EMG power], neither
/// negative.
NoiseLevel fit_noise(const Eigen::ArrayXd& squared, const Eigen::ArrayXd& power) {
  double a = squared.mean();
  double b = 0.0;
  const double floor = 1e-6 * a + 1e-300;
  for (int pass = 0; pass < 20; ++pass) {
    const Eigen::ArrayXd weight = (a + b * power).max(floor).square().inverse();
    const double s0 = weight.sum();
    const double s1 = (weight * power).sum();
    const double s2 = (weight * power.square()).sum();
    const double y0 = (weight * squared).sum();
    const double y1 = (weight * power * squared).sum();
    const double determinant = s0 * s2 - s1 * s1;
    const bool regular = determinant > 1e-12 * s0 * s2;
    double next_a = regular ? (s2 * y0 - s1 * y1) / determinant : y0 / s0;
    double next_b = regular ? (s0 * y1 - s1 * y0) / determinant : 0.0;
    if (next_b < 0.0) {
      next_b = 0.0;
      next_a = y0 / s0;
    } else if (next_a < 0.05 * squared.mean()) {
      // Torque is never without noise: at least a share of the whole.
      next_a = 0.05 * squared.mean();
      next_b = std::max(0.0, (y1 - next_a * s1) / std::max(s2, 1e-300));
    }
    a = next_a;
    b = next_b;
  }
  return {std::sqrt(std::max(a, 0.0)), std::min(std::sqrt(b), 1.0)};
}

}  // namespace

Estimator::Estimator(const StudyData& data, const EstimatorOptions& options)
    : options_(options), model_(std::make_shared<const ResidualModel>(data, options)) {
  const auto n = static_cast<double>(model_->sample_count());
  const double typical = std::sqrt(model_->measured().squaredNorm() / n);
  floor_nm_ = 1e-9 * std::max(typical, 1e-3);
  const Eigen::Index p = model_->parameters().size();
  lower_.resize(p);
  upper_.resize(p);
  prior_mean_.setZero(p);
  prior_precision_.setZero(p);
  for (Eigen::Index j = 0; j < p; ++j) {
    const FreeParameter& f = free()[static_cast<std::size_t>(j)];
    lower_[j] = f.lower;
    upper_[j] = f.upper;
    if (f.prior_sd > 0.0) {
      prior_mean_[j] = f.prior_mean;
      prior_precision_[j] = 1.0 / (f.prior_sd * f.prior_sd);
    }
  }
}

NormalEquations Estimator::normal_equations(const Eigen::VectorXd& z,
                                            const Weighting& weighting,
                                            bool derivatives,
                                            const Variant& variant) const {
  // Workspace of this thread: the gradient matrix is large, and allocating it anew costs more than
  // a pass over it.
  thread_local Evaluation at;
  Evaluation local;
  std::swap(local, at);  // a task that this thread takes on meanwhile finds the shared one empty
  model_->evaluate(z, derivatives ? ResidualModel::Depth::gradient : ResidualModel::Depth::value,
                   local);
  NormalEquations result;
  const Eigen::Index n = model_->sample_count();
  const bool corrected = weighting.emg_variance.size() > 0;
  Eigen::VectorXd scores(n);
  double sum = weighting.offset;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double u = (local.predicted[i] - model_->measured()[i]) / weighting.sd_nm[i];
    const double count = variant.multiplicity.size() > 0 ? variant.multiplicity[i] : 1.0;
    const LossValue value = loss(options_.loss, u);
    sum += count * value.rho;
    const double root = std::sqrt(weighting.share * count * value.weight);
    scores[i] = root * u;
    const double scale = root / weighting.sd_nm[i];
    if (derivatives) local.gradient.col(i) *= scale;
    if (corrected) {
      local.channel_torque.col(i) *= scale * std::sqrt(weighting.emg_variance[i]);
      sum -= local.channel_torque.col(i).squaredNorm() / weighting.share;
      local.channel_torque.col(i) *= std::sqrt(weighting.emg_variance[i]);
    }
  }
  const Eigen::VectorXd& mean = variant.prior_mean.size() > 0 ? variant.prior_mean : prior_mean_;
  const Eigen::VectorXd off = z - mean;
  result.cost = 0.5 * weighting.share * sum + 0.5 * off.dot(prior_precision_.cwiseProduct(off));
  if (derivatives) {
    const Eigen::Index p = z.size();
    result.gradient = local.gradient * scores + prior_precision_.cwiseProduct(off);
    result.curvature.setZero(p, p);
    result.curvature.selfadjointView<Eigen::Lower>().rankUpdate(local.gradient);
    result.curvature.triangularView<Eigen::StrictlyUpper>() = result.curvature.transpose();
    if (corrected) {
      for (Eigen::Index j = 0; j < p; ++j) {
        const int channel = model_->channel_of_variable(j);
        if (channel >= 0)
          result.gradient[j] -= local.gradient.row(j).dot(local.channel_torque.row(channel));
      }
      correct_curvature(weighting, result.curvature);
    }
    result.curvature.diagonal() += prior_precision_;
  }
  std::swap(local, at);
  return result;
}

NormalSearchResult Estimator::search(const Eigen::VectorXd& start,
                                     const Weighting& weighting,
                                     double step_tolerance,
                                     double cost_tolerance,
                                     int iterations,
                                     const Variant& variant,
                                     const std::vector<bool>& held) const {
  return minimize_normal(
      [&](const Eigen::VectorXd& z, bool derivatives, NormalEquations& out) {
        out = normal_equations(z, weighting, derivatives, variant);
      },
      lower_, upper_, start,
      {.gauss_newton = options_.gauss_newton,
       .max_iterations = iterations,
       .step_tolerance = step_tolerance,
       .cost_tolerance = cost_tolerance,
       .progress = options_.progress},
      held);
}

void Estimator::correct_curvature(const Weighting& weighting, Eigen::MatrixXd& information) const {
  const double variance = weighting.emg_variance.maxCoeff();
  const Eigen::Index p = information.rows();
  const Eigen::VectorXd scale = information.diagonal().cwiseMax(1e-300).cwiseSqrt();
  const Eigen::VectorXd inverse = scale.cwiseInverse();
  Eigen::MatrixXd unit = inverse.asDiagonal() * information * inverse.asDiagonal();
  for (Eigen::Index i = 0; i < p; ++i) {
    for (Eigen::Index j = 0; j < p; ++j) {
      const int channel = model_->channel_of_variable(i);
      if (channel >= 0 && channel == model_->channel_of_variable(j))
        unit(i, j) *= 1.0 - variance / (1.0 + variance);
    }
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(unit);
  if (eigen.eigenvalues()[0] < 0.0) {
    unit = eigen.eigenvectors() * eigen.eigenvalues().cwiseMax(0.0).asDiagonal() *
           eigen.eigenvectors().transpose();
  }
  information = scale.asDiagonal() * unit * scale.asDiagonal();
}

Estimator::Scores Estimator::scores(const Solution& solution) const {
  const Weighting& weighting = solution.weighting;
  Evaluation at;
  model_->evaluate(solution.search.x, ResidualModel::Depth::gradient, at);
  Eigen::VectorXd sd = weighting.sd_nm;
  if (!options_.weights) sd.setConstant(std::max(weighting.noise[0].torque_sd_nm, 1e-300));
  const Eigen::Index p = solution.search.x.size();
  Scores result;
  result.scores.resize(p, sd.size());
  Eigen::MatrixXd weighted(p, sd.size());
  for (Eigen::Index i = 0; i < sd.size(); ++i) {
    const double u = (at.predicted[i] - model_->measured()[i]) / sd[i];
    const double weight = loss(options_.loss, u).weight;
    weighted.col(i) = at.gradient.col(i) * (std::sqrt(weight) / sd[i]);
    result.scores.col(i) = at.gradient.col(i) * (weight * u / sd[i]);
    if (weighting.emg_variance.size() == 0) continue;
    for (Eigen::Index j = 0; j < p; ++j) {
      const int channel = model_->channel_of_variable(j);
      if (channel >= 0)
        result.scores(j, i) -= weight * weighting.emg_variance[i] * at.channel_torque(channel, i) *
                               at.gradient(j, i) / (sd[i] * sd[i]);
    }
  }
  result.scores *= weighting.share;
  result.information = weighting.share * weighted * weighted.transpose();
  if (weighting.emg_variance.size() > 0) correct_curvature(weighting, result.information);
  return result;
}

void Estimator::find_noise(const Evaluation& at, Weighting& weighting) const {
  const Eigen::VectorXd residual = at.predicted - model_->measured();
  const auto n = static_cast<double>(residual.size());
  const double freedom =
      std::max(0.2, 1.0 - static_cast<double>(free().size()) / std::max(10.0, weighting.share * n));
  // The power is averaged over a second: a weight that follows the noise of the EMG itself would
  // favor the samples in which it happens to be small.
  Eigen::VectorXd power = at.channel_torque.colwise().squaredNorm().transpose();
  const auto half = static_cast<Eigen::Index>(std::lround(0.5 * model_->rate_hz()));
  for (const Piece& piece : model_->pieces()) {
    auto segment = power.segment(piece.first, piece.count);
    for (int pass = 0; pass < 2; ++pass) {
      Eigen::VectorXd sum(piece.count + 1);
      sum[0] = 0.0;
      for (Eigen::Index i = 0; i < piece.count; ++i) sum[i + 1] = sum[i] + segment[i];
      for (Eigen::Index i = 0; i < piece.count; ++i) {
        const Eigen::Index reach = std::min({half, i, piece.count - 1 - i});
        segment[i] = (sum[i + reach + 1] - sum[i - reach]) / static_cast<double>(2 * reach + 1);
      }
    }
  }
  if (options_.correct_attenuation) weighting.emg_variance.setZero(residual.size());
  for (int joint = 0; joint < model_->joint_count(); ++joint) {
    std::vector<Eigen::Index> rows;
    for (const Piece& piece : model_->pieces()) {
      if (piece.joint != joint) continue;
      for (Eigen::Index i = 0; i < piece.count; ++i) rows.push_back(piece.first + i);
    }
    if (rows.empty()) continue;
    Eigen::ArrayXd squared = residual(rows).array().square();
    if (options_.loss != Loss::square) {
      for (Eigen::Index i = 0; i < squared.size(); ++i) {
        const Eigen::Index row = rows[static_cast<std::size_t>(i)];
        squared[i] *= loss(options_.loss, residual[row] / weighting.sd_nm[row]).weight;
      }
    }
    // What motion is known to contribute is not torque noise.
    squared = (squared / freedom - at.motion_variance(rows).array()).max(0.0);
    NoiseLevel level = fit_noise(squared, power(rows).array());
    level.torque_sd_nm = std::max(level.torque_sd_nm, floor_nm_);
    weighting.noise[static_cast<std::size_t>(joint)] = level;
    const double variance = level.emg_cv * level.emg_cv;
    for (const Eigen::Index row : rows) {
      weighting.sd_nm[row] = std::sqrt(level.torque_sd_nm * level.torque_sd_nm +
                                       variance * power[row] + at.motion_variance[row]);
      if (options_.correct_attenuation) weighting.emg_variance[row] = variance;
    }
  }
  weighting.share = math::effective_sample_size(residual.cwiseQuotient(weighting.sd_nm),
                                                model_->piece_lengths()) /
                    n;
  if (options_.correct_attenuation) {
    weighting.offset =
        weighting.emg_variance.cwiseProduct(power).cwiseQuotient(weighting.sd_nm.cwiseAbs2()).sum();
  }
}

Estimator::Solution Estimator::solve(const Eigen::VectorXd& start) const {
  const Eigen::Index n = model_->sample_count();
  Solution solution;
  Weighting& weighting = solution.weighting;
  weighting.sd_nm = Eigen::VectorXd::Ones(n);
  weighting.noise.resize(static_cast<std::size_t>(model_->joint_count()));
  if (!options_.weights) {
    solution.search = search(start, weighting, 1e-13, 1e-15);
    // Plain least squares: the residuals' own variance.
    const double freedom =
        std::max(1.0, static_cast<double>(n) - static_cast<double>(free().size()));
    const double sd = std::sqrt(2.0 * solution.search.cost / freedom);
    for (NoiseLevel& level : weighting.noise) level = {sd, 0.0};
    solution.misfit = solution.search.cost;
    return solution;
  }
  // First guess of the noise: a tenth of the torque.
  const double first = std::max(
      0.1 * std::sqrt(model_->measured().squaredNorm() / static_cast<double>(n)), floor_nm_);
  weighting.sd_nm.setConstant(first);
  weighting.share = 0.25;
  Eigen::VectorXd x = start;
  Evaluation at;
  int iterations = 0;
  for (int pass = 0; pass < options_.passes; ++pass) {
    // Only the last pass needs all digits: the weights still move before.
    const bool last = pass + 1 == options_.passes;
    solution.search = search(x, weighting, last ? 1e-9 : 1e-4, last ? 1e-11 : 1e-4);
    iterations += solution.search.iterations;
    x = solution.search.x;
    if (last) break;
    model_->evaluate(x, ResidualModel::Depth::noise, at);
    find_noise(at, weighting);
  }
  solution.search.iterations = iterations;
  solution.misfit =
      2.0 * solution.search.cost + 2.0 * weighting.share * weighting.sd_nm.array().log().sum();
  return solution;
}

Eigen::VectorXd Estimator::moved_start(const Eigen::VectorXd& start, int s) const {
  Eigen::VectorXd x = start;
  for (std::size_t j = 0; j < free().size(); ++j) {
    const FreeParameter& f = free()[j];
    const auto at = static_cast<Eigen::Index>(j);
    const double step = f.prior_sd > 0.0       ? f.prior_sd
                        : f.field->logarithmic ? 0.3
                                               : 0.1 * std::abs(f.start);
    // Start s turns sign by the bits of a fixed mixing of its number and the parameter's: the same
    // on every machine.
    const std::uint64_t mixed =
        (static_cast<std::uint64_t>(s) * 0x9E3779B97F4A7C15ULL) ^ ((j + 1) * 0xD1B54A32D192ED03ULL);
    const double sign = ((mixed >> 33) & 1U) == 0 ? 1.0 : -1.0;
    x[at] = std::clamp(x[at] + sign * step, f.lower, f.upper);
  }
  return x;
}

Estimator::Solution Estimator::solve_from_all_starts(const Eigen::VectorXd& start) const {
  Solution best = solve(start);
  const double first_cost = best.search.cost_history.front();
  // Without priors there are more false minima, and nothing but the cost to tell them by.
  const int starts = options_.weights ? options_.starts : 4 * options_.starts;
  for (int s = 1; s < starts && !(best.search.cost <= 1e-18 * first_cost); ++s) {
    Eigen::VectorXd x = moved_start(start, s);
    if (options_.weights) {
      // Most starts lead to the same minimum: a glance tells, at the same weights.
      const NormalSearchResult look = search(x, best.weighting, 1e-4, 1e-4, 40);
      if (!(look.cost < (1.0 - 1e-3) * best.search.cost)) continue;
      x = look.x;
    }
    Solution attempt = solve(x);
    if (attempt.misfit < best.misfit) best = std::move(attempt);
  }
  return best;
}

}  // namespace myoid::identification
