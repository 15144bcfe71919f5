#include "myoid/identification/estimator.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "myoid/identification/loss.h"
#include "myoid/math/decompositions.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {

Estimator::Estimator(const StudyData& data, const EstimatorOptions& options)
    : options_(options), model_(std::make_shared<const ResidualModel>(data, options)) {
  const auto n = static_cast<double>(model_->sample_count());
  const double typical = std::sqrt(model_->measured().squaredNorm() / n);
  floor_nm_ = 1e-9 * std::max(typical, 1e-3);
  const std::vector<std::string>& channels = model_->parameters().channels();
  channel_variance_ = Eigen::VectorXd::Ones(static_cast<Eigen::Index>(channels.size()));
  emg_noise_known_ = true;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (!(options.bandwidth_hz(channels[c]) > 0.0)) {
      emg_noise_known_ = false;
      continue;
    }
    channel_variance_[static_cast<Eigen::Index>(c)] =
        std::pow(envelope_spread(options, channels[c]), 2) * kept_by_residual_filter();
  }
  if (!emg_noise_known_) channel_variance_.setConstant(kept_by_residual_filter());
  const Eigen::Index p = model_->parameters().size();
  lower_.resize(p);
  upper_.resize(p);
  prior_mean_.setZero(p);
  prior_precision_.setZero(p);
  for (Eigen::Index j = 0; j < p; ++j) {
    const Unknown& f = free()[static_cast<std::size_t>(j)];
    lower_[j] = f.bounds.lower;
    upper_[j] = f.bounds.upper;
    if (f.prior.sd > 0.0) prior_mean_[j] = f.prior.mean;
    prior_precision_[j] = f.prior_precision();
  }
}

double Estimator::kept_by_residual_filter() const {
  if (!options_.residual_cutoff_hz) return 1.0;
  return *options_.residual_cutoff_hz / std::hypot(options_.envelope_cutoff_hz, *options_.residual_cutoff_hz);
}

Eigen::VectorXd Estimator::envelope_variance(const NoiseLevel& found) const {
  return channel_variance_ * (found.emg_factor * found.emg_factor / kept_by_residual_filter());
}

Eigen::VectorXd Estimator::exponents(const Eigen::VectorXd& z) const {
  const ModelValues values = model_->parameters().values(z);
  Eigen::VectorXd p(static_cast<Eigen::Index>(values.channels.size()));
  for (Eigen::Index c = 0; c < p.size(); ++c) p[c] = values.channels[static_cast<std::size_t>(c)][kExponent];
  return p;
}

Estimator::ChannelSlope Estimator::channel_slope(Eigen::Index j, const Eigen::VectorXd& exponent) const {
  const int channel = model_->channel_of_variable(j);
  if (channel < 0) return {};
  // The solver's variable is ln p: dp = p d ln p, and p times T_ch / p is T_ch.
  return {channel, exponent[channel], free()[static_cast<std::size_t>(j)].is(Scope::channel, kExponent)};
}

Estimator::RowSums Estimator::weigh(const Weighting& weighting,
                                    const Variant& variant,
                                    Eigen::Index first,
                                    const Eigen::Ref<const Eigen::VectorXd>& predicted,
                                    Eigen::Ref<Eigen::MatrixXd> channel_torque,
                                    Eigen::Ref<Eigen::VectorXd> by_predicted,
                                    Eigen::Ref<Eigen::VectorXd> scale) const {
  RowSums sums{.loss = 0.0, .by_noise = Eigen::VectorXd::Zero(channel_variance_.size())};
  const bool corrected = weighting.emg_variance.size() > 0;
  for (Eigen::Index k = 0; k < predicted.size(); ++k) {
    const Eigen::Index i = first + k;
    const double u = (predicted[k] - model_->measured()[i]) / weighting.sd_nm[i];
    const double count = variant.multiplicity.size() > 0 ? variant.multiplicity[i] : 1.0;
    const LossValue value = loss(options_.loss, u);
    sums.loss += count * value.rho;
    const double root = std::sqrt(weighting.share * count * value.weight);
    scale[k] = root / weighting.sd_nm[i];
    by_predicted[k] = scale[k] * root * u;
    if (!corrected) continue;
    auto torque = channel_torque.col(k);
    const double squared = scale[k] * scale[k] * weighting.emg_variance[i];
    sums.by_noise += squared * torque.cwiseAbs2().cwiseProduct(channel_variance_);
    torque = squared * torque.cwiseProduct(channel_variance_).cwiseProduct(model_->noise_gain().col(i));
  }
  return sums;
}

double Estimator::cost_of(const Weighting& weighting, const RowSums& sums, const PriorTerm& prior) const {
  const double of_data = weighting.share * (weighting.offset + sums.loss) - sums.by_noise.sum();
  return 0.5 * of_data + 0.5 * prior.off.dot(prior.slope);
}

Eigen::VectorXd Estimator::gradient_of(const Eigen::VectorXd& z,
                                       const Weighting& weighting,
                                       const RowSums& sums,
                                       const RowSlopes& slopes,
                                       const PriorTerm& prior) const {
  Eigen::VectorXd gradient = slopes.by_prediction + prior.slope;
  if (weighting.emg_variance.size() == 0) return gradient;
  const Eigen::VectorXd exponent = exponents(z);
  for (Eigen::Index j = 0; j < z.size(); ++j) {
    const ChannelSlope s = channel_slope(j, exponent);
    if (s.channel < 0) continue;
    gradient[j] -= s.slope * slopes.by_channel[j];
    if (s.adds) gradient[j] -= sums.by_noise[s.channel];
  }
  return gradient;
}

NormalEquations Estimator::cost_and_gradient(const Eigen::VectorXd& z,
                                             const Weighting& weighting,
                                             const PriorTerm& prior,
                                             const Variant& variant) const {
  std::vector<RowSums> of_piece(model_->pieces().size());
  RowSlopes slopes;
  model_->pull_back(
      z,
      [&](std::size_t piece, PullBack& rows) {
        const auto [trial, joint, first, count] = model_->pieces()[piece];
        Eigen::VectorXd scale(count);
        of_piece[piece] =
            weigh(weighting, variant, first, rows.predicted.segment(first, count),
                  rows.channel_torque.middleCols(first, count), rows.by_predicted.segment(first, count), scale);
      },
      slopes.by_prediction, slopes.by_channel);
  RowSums sums = of_piece.front();
  for (std::size_t piece = 1; piece < of_piece.size(); ++piece) {
    sums.loss += of_piece[piece].loss;
    sums.by_noise += of_piece[piece].by_noise;
  }
  NormalEquations result;
  result.cost = cost_of(weighting, sums, prior);
  result.gradient = gradient_of(z, weighting, sums, slopes, prior);
  return result;
}

NormalEquations Estimator::normal_equations(const Eigen::VectorXd& z,
                                            const Weighting& weighting,
                                            Derivatives derivatives,
                                            const Variant& variant) const {
  PriorTerm prior;
  prior.off = z - (variant.prior_mean.size() > 0 ? variant.prior_mean : prior_mean_);
  prior.slope = prior_precision_.cwiseProduct(prior.off);
  if (derivatives == Derivatives::gradient) return cost_and_gradient(z, weighting, prior, variant);
  // Reuses this thread's workspace: the gradient matrix is large, and a new allocation costs more
  // than a pass over the matrix.
  thread_local Evaluation at;
  Evaluation local;
  std::swap(local, at);  // a task that this thread starts meanwhile finds an empty one
  const bool curved = derivatives == Derivatives::curvature;
  model_->evaluate(z, curved ? ResidualModel::Depth::gradient : ResidualModel::Depth::value, local);
  const Eigen::Index n = model_->sample_count();
  Eigen::VectorXd by_predicted(n), scale(n);
  const RowSums sums = weigh(weighting, variant, 0, local.predicted, local.channel_torque, by_predicted, scale);
  NormalEquations result;
  result.cost = cost_of(weighting, sums, prior);
  if (curved) {
    const Eigen::Index p = z.size();
    const Eigen::MatrixXd by_all_channels = local.unfiltered * local.channel_torque.transpose();
    RowSlopes slopes{.by_prediction = local.gradient * by_predicted, .by_channel = Eigen::VectorXd::Zero(p)};
    for (Eigen::Index j = 0; j < p; ++j) {
      if (const int c = model_->channel_of_variable(j); c >= 0) slopes.by_channel[j] = by_all_channels(j, c);
    }
    result.gradient = gradient_of(z, weighting, sums, slopes, prior);
    for (Eigen::Index i = 0; i < n; ++i) local.gradient.col(i) *= scale[i];
    result.curvature.setZero(p, p);
    result.curvature.selfadjointView<Eigen::Lower>().rankUpdate(local.gradient);
    result.curvature.triangularView<Eigen::StrictlyUpper>() = result.curvature.transpose();
    if (weighting.emg_variance.size() > 0) correct_curvature(weighting, result.curvature);
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
      [&](const Eigen::VectorXd& z) { return normal_equations(z, weighting, Derivatives::curvature, variant); }, lower_,
      upper_, start,
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
        unit(i, j) /= 1.0 + variance * channel_variance_[channel] * weighting.noise_gain[channel] *
                                std::pow(weighting.exponent[channel], 2);
    }
  }
  const math::SymmetricEigen eigen = math::symmetric_eigen(unit);
  if (eigen.values[0] < 0.0) {
    unit = eigen.vectors * eigen.values.cwiseMax(0.0).asDiagonal() * eigen.vectors.transpose();
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
  result.attenuation.setZero(p);
  result.residual = (at.predicted - model_->measured()).cwiseQuotient(sd);
  Eigen::MatrixXd weighted(p, sd.size());
  const Eigen::VectorXd exponent = exponents(solution.search.x);
  for (Eigen::Index i = 0; i < sd.size(); ++i) {
    const double u = result.residual[i];
    const double weight = loss(options_.loss, u).weight;
    weighted.col(i) = at.gradient.col(i) * (std::sqrt(weight) / sd[i]);
    result.scores.col(i) = at.gradient.col(i) * (weight * u / sd[i]);
    if (weighting.emg_variance.size() == 0) continue;
    for (Eigen::Index j = 0; j < p; ++j) {
      const ChannelSlope s = channel_slope(j, exponent);
      if (s.channel < 0) continue;
      const double torque = at.channel_torque(s.channel, i);
      const double by_noise =
          weight * weighting.emg_variance[i] * channel_variance_[s.channel] * torque *
          (s.slope * model_->noise_gain()(s.channel, i) * at.unfiltered(j, i) + (s.adds ? torque : 0.0)) /
          (sd[i] * sd[i]);
      result.scores(j, i) -= by_noise;
      result.attenuation[j] += by_noise;
    }
  }
  result.scores *= weighting.share;
  result.attenuation *= weighting.share;
  result.rows = std::sqrt(weighting.share) * weighted;
  result.information = result.rows * result.rows.transpose();
  if (weighting.emg_variance.size() > 0) correct_curvature(weighting, result.information);
  return result;
}

NoiseLevel Estimator::noise_of_joint(const std::vector<Eigen::Index>& rows,
                                     const Eigen::VectorXd& residual,
                                     const Eigen::VectorXd& power,
                                     const Evaluation& at,
                                     const Weighting& weighting) const {
  const auto n = static_cast<double>(residual.size());
  const double freedom = std::max(0.2, 1.0 - static_cast<double>(free().size()) / std::max(10.0, weighting.share * n));
  Eigen::ArrayXd squared = residual(rows).array().square();
  if (options_.loss != Loss::square) {
    for (Eigen::Index i = 0; i < squared.size(); ++i) {
      const Eigen::Index row = rows[static_cast<std::size_t>(i)];
      squared[i] *= loss(options_.loss, residual[row] / weighting.sd_nm[row]).weight;
    }
  }
  // The errors of the motion explain this part, so it is not torque noise.
  squared = (squared / freedom - at.motion_variance(rows).array()).max(0.0);
  NoiseLevel level = emg_noise_known_ ? fit_known_noise(squared, power(rows).array(), weighting.share)
                                      : fit_unknown_noise(squared, power(rows).array());
  // Muscles that start far too strong leave residuals larger than the torque itself. Taken for
  // noise, these residuals would give the data no weight and the search would stay at its start.
  const double most = std::sqrt(model_->measured()(rows).squaredNorm() / static_cast<double>(rows.size()));
  level.torque_sd_nm = std::max(std::min(level.torque_sd_nm, most), floor_nm_);
  level.emg_cv = level.emg_factor * std::sqrt(channel_variance_.mean());
  return level;
}

void Estimator::find_noise(const Eigen::VectorXd& z, const Evaluation& at, Weighting& weighting) const {
  weighting.exponent = exponents(z);
  const Eigen::ArrayXXd part = (at.channel_torque * weighting.sd_nm.cwiseInverse().asDiagonal()).array().square();
  weighting.noise_gain =
      (part.rowwise().sum() + 1e-300) / ((part / model_->noise_gain().array().square()).rowwise().sum() + 1e-300);
  const bool correct = options_.correct_attenuation && weighting.corrected;
  const Eigen::VectorXd residual = at.predicted - model_->measured();
  // Averages the power over a second: a weight that follows the EMG's noise itself would favor
  // samples in which the noise happens to be small.
  const Eigen::VectorXd power =
      averaged_twice(at.channel_torque.cwiseAbs2().transpose() * channel_variance_, model_->piece_lengths(),
                     static_cast<Eigen::Index>(std::lround(0.5 * model_->rate_hz())));
  if (correct) weighting.emg_variance.setZero(residual.size());
  for (int joint = 0; joint < model_->joint_count(); ++joint) {
    const std::vector<Eigen::Index> rows = model_->rows_of_joint(joint);
    if (rows.empty()) continue;
    const NoiseLevel level = noise_of_joint(rows, residual, power, at, weighting);
    weighting.noise[static_cast<std::size_t>(joint)] = level;
    const double variance = level.emg_factor * level.emg_factor;
    for (const Eigen::Index row : rows) {
      weighting.sd_nm[row] =
          std::sqrt(level.torque_sd_nm * level.torque_sd_nm + variance * power[row] + at.motion_variance[row]);
      if (correct) weighting.emg_variance[row] = level.emg_share * variance;
    }
  }
  weighting.share = math::effective_sample_size(residual.cwiseQuotient(weighting.sd_nm), model_->piece_lengths()) /
                    static_cast<double>(residual.size());
  if (correct) {
    weighting.offset = weighting.emg_variance.cwiseProduct(power).cwiseQuotient(weighting.sd_nm.cwiseAbs2()).sum();
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
    const double freedom = std::max(1.0, static_cast<double>(n) - static_cast<double>(free().size()));
    const double sd = std::sqrt(2.0 * solution.search.cost / freedom);
    for (NoiseLevel& level : weighting.noise) level = {.torque_sd_nm = sd};
    solution.misfit = solution.search.cost;
    return solution;
  }
  // First guess of the noise: a tenth of the torque.
  const double first = std::max(0.1 * std::sqrt(model_->measured().squaredNorm() / static_cast<double>(n)), floor_nm_);
  const auto begin_anew = [&] {
    weighting.sd_nm.setConstant(first);
    weighting.share = 0.25;
    weighting.emg_variance.resize(0);
    weighting.offset = 0.0;
    return start;
  };
  Eigen::VectorXd x = begin_anew();
  Evaluation at;
  int iterations = 0;
  for (int pass = 0; pass < options_.passes; ++pass) {
    // Only the last pass needs full precision, because the weights still change in earlier passes.
    const bool last = pass + 1 == options_.passes;
    solution.search = search(x, weighting, last ? 1e-9 : 1e-4, last ? 1e-11 : 1e-4);
    iterations += solution.search.iterations;
    if (last && weighting.emg_variance.size() > 0) {
      // Residuals of ten standard deviations or three times the torque: fits anew, uncorrected.
      model_->evaluate(solution.search.x, ResidualModel::Depth::value, at);
      const Eigen::VectorXd residual = at.predicted - model_->measured();
      const double misfit = residual.cwiseQuotient(weighting.sd_nm).squaredNorm() / static_cast<double>(n);
      const double share = residual.squaredNorm() / model_->measured().squaredNorm();
      if (!(misfit < 100.0 && share < 9.0)) {
        weighting.corrected = false;
        x = begin_anew();
        pass = -1;
        continue;
      }
    }
    x = solution.search.x;
    if (last) break;
    model_->evaluate(x, ResidualModel::Depth::noise, at);
    find_noise(x, at, weighting);
  }
  solution.search.iterations = iterations;
  solution.misfit = 2.0 * solution.search.cost + 2.0 * weighting.share * weighting.sd_nm.array().log().sum();
  return solution;
}

Eigen::VectorXd Estimator::moved_start(const Eigen::VectorXd& start, int s) const {
  Eigen::VectorXd x = start;
  for (std::size_t j = 0; j < free().size(); ++j) {
    const Unknown& f = free()[j];
    const auto at = static_cast<Eigen::Index>(j);
    const double step = f.prior.sd > 0.0 ? f.prior.sd : f.field->logarithmic ? 0.3 : 0.1 * std::abs(f.start);
    // A fixed mixing of the numbers of start and parameter chooses the sign, the same on every machine.
    const std::uint64_t mixed =
        (static_cast<std::uint64_t>(s) * 0x9E3779B97F4A7C15ULL) ^ ((j + 1) * 0xD1B54A32D192ED03ULL);
    const double sign = ((mixed >> 33) & 1U) == 0 ? 1.0 : -1.0;
    x[at] = std::clamp(x[at] + sign * step, f.bounds.lower, f.bounds.upper);
  }
  return x;
}

Estimator::Solution Estimator::solve_from_all_starts(const Eigen::VectorXd& start) const {
  Solution best = solve(start);
  const double first_cost = best.search.cost_history.front();
  // Without priors the cost has more false minima, and only its value tells them apart.
  const int starts = options_.weights ? options_.starts : 4 * options_.starts;
  for (int s = 1; s < starts && !(best.search.cost <= 1e-18 * first_cost); ++s) {
    Eigen::VectorXd x = moved_start(start, s);
    if (options_.weights) {
      // Most starts lead to the same minimum, which a short search at the same weights shows.
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
