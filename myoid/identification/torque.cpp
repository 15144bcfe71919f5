#include "myoid/identification/torque.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <fmt/format.h>

#include "myoid/identification/identifiability.h"
#include "myoid/identification/torque_model.h"
#include "myoid/math/covariance.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// Two noise levels: torque, and what is multiplied by the EMG.
struct NoiseModel {
  double torque_sd_nm = 1.0;
  double emg_cv = 0.0;
  double share = 1.0;  ///< nu: effective over all samples.

  [[nodiscard]] double sd(double channel_power) const {
    return std::sqrt(torque_sd_nm * torque_sd_nm + emg_cv * emg_cv * channel_power);
  }
};

/// Both variances by weighted regression of the squared residuals on [1, channel power], neither
/// negative.
void estimate_noise(const Eigen::VectorXd& residual,
                    const Eigen::VectorXd& power,
                    double freedom_share,
                    NoiseModel& noise) {
  const Eigen::VectorXd squared = residual.array().square() / freedom_share;
  double a = squared.mean();
  double b = 0.0;
  const double floor = 1e-6 * a + 1e-300;
  for (int pass = 0; pass < 20; ++pass) {
    const Eigen::ArrayXd weight = (a + b * power.array()).max(floor).square().inverse();
    const double s0 = weight.sum();
    const double s1 = (weight * power.array()).sum();
    const double s2 = (weight * power.array().square()).sum();
    const double y0 = (weight * squared.array()).sum();
    const double y1 = (weight * power.array() * squared.array()).sum();
    const double determinant = s0 * s2 - s1 * s1;
    double next_a = determinant > 1e-12 * s0 * s2 ? (s2 * y0 - s1 * y1) / determinant : y0 / s0;
    double next_b = determinant > 1e-12 * s0 * s2 ? (s0 * y1 - s1 * y0) / determinant : 0.0;
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
  noise.torque_sd_nm = std::sqrt(std::max(a, 0.0));
  noise.emg_cv = std::min(std::sqrt(b), 1.0);
}

class Fit {
 public:
  Fit(const StudyData& data, const TorqueOptions& options)
      : options_(options), model_(data, options) {
    const double typical =
        std::sqrt(model_.torque().squaredNorm() / static_cast<double>(model_.sample_count()));
    floor_nm_ = 1e-9 * std::max(typical, 1e-3);
    for (const FreeParameter& p : model_.free()) {
      if (p.prior_sd > 0.0) ++prior_count_;
    }
  }

  [[nodiscard]] const TorqueModel& model() const { return model_; }
  [[nodiscard]] const NoiseModel& noise() const { return noise_; }
  [[nodiscard]] const Eigen::VectorXd& standard_deviation() const { return sd_; }

  math::LeastSquaresResult run(const Eigen::VectorXd& start) {
    const Eigen::Index n = model_.sample_count();
    sd_ = Eigen::VectorXd::Ones(n);
    noise_ = {};
    Eigen::VectorXd predicted;
    Eigen::VectorXd power;
    math::LeastSquaresResult fit;
    Eigen::VectorXd x = start;
    if (options_.weights) {
      // First guess of the noise: a tenth of the torque.
      noise_.torque_sd_nm = std::max(
          0.1 * std::sqrt(model_.torque().squaredNorm() / static_cast<double>(n)), floor_nm_);
      noise_.share = 0.25;
      sd_.setConstant(noise_.torque_sd_nm);
    }
    if (!options_.weights) return minimize(x, 200, 1e-13, 1e-15);
    for (int pass = 0; pass < options_.passes; ++pass) {
      // Only the last pass needs all digits: the weights still move before.
      const bool last = pass + 1 == options_.passes;
      fit = minimize(x, 200, last ? 1e-8 : 1e-5, last ? 1e-10 : 1e-5);
      x = fit.x;
      model_.evaluate(x, predicted, nullptr, &power);
      const Eigen::VectorXd residual = predicted - model_.torque();
      const double freedom =
          std::max(0.2, 1.0 - static_cast<double>(model_.free().size()) /
                                  std::max(10.0, noise_.share * static_cast<double>(n)));
      estimate_noise(residual, power, freedom, noise_);
      noise_.torque_sd_nm = std::max(noise_.torque_sd_nm, floor_nm_);
      for (Eigen::Index i = 0; i < n; ++i) sd_[i] = noise_.sd(power[i]);
      const Eigen::VectorXd standardized = residual.cwiseQuotient(sd_);
      noise_.share =
          math::effective_sample_size(standardized, model_.pieces()) / static_cast<double>(n);
    }
    return fit;
  }

  /// A short search from another start with the weights as they stand after `run`.
  [[nodiscard]] math::LeastSquaresResult glance(const Eigen::VectorXd& start) {
    return minimize(start, 40, 1e-4, 1e-4);
  }

  /// Covariance of z: A^-1 B A^-1.
  [[nodiscard]] Eigen::MatrixXd covariance(const Eigen::VectorXd& z) const {
    Eigen::VectorXd predicted;
    Eigen::MatrixXd jacobian;
    model_.evaluate(z, predicted, &jacobian, nullptr);
    const Eigen::MatrixXd weighted = sd_.cwiseInverse().asDiagonal() * jacobian;
    const Eigen::VectorXd residual = (predicted - model_.torque()).cwiseQuotient(sd_);
    const double nu = noise_.share;
    Eigen::MatrixXd a = nu * weighted.transpose() * weighted;
    const Eigen::MatrixXd scores = residual.asDiagonal() * weighted;
    const auto lag = static_cast<Eigen::Index>(std::lround(0.4 * model_.rate_hz()));
    Eigen::MatrixXd b = nu * nu * math::newey_west(scores, model_.pieces(), lag);
    for (Eigen::Index j = 0; j < a.rows(); ++j) {
      const double sd = model_.free()[static_cast<std::size_t>(j)].prior_sd;
      if (sd > 0.0) {
        a(j, j) += 1.0 / (sd * sd);
        b(j, j) += 1.0 / (sd * sd);
      }
    }
    // Scaled to unit diagonal before inverting; near-zero directions stay near-infinite.
    const Eigen::VectorXd scale = a.diagonal().cwiseMax(1e-300).cwiseSqrt().cwiseInverse();
    const Eigen::MatrixXd inverse = scale.asDiagonal() *
                                    (scale.asDiagonal() * a * scale.asDiagonal())
                                        .eval()
                                        .completeOrthogonalDecomposition()
                                        .pseudoInverse() *
                                    scale.asDiagonal();
    const Eigen::MatrixXd sandwich = inverse * b * inverse;
    // Few effective samples make B itself unsure: never below the model-based covariance.
    Eigen::MatrixXd result = sandwich;
    for (Eigen::Index j = 0; j < a.rows(); ++j) {
      const double factor =
          std::sqrt(std::max(1.0, inverse(j, j) / std::max(sandwich(j, j), 1e-300)));
      if (options_.weights && factor > 1.0) {
        result.row(j) *= factor;
        result.col(j) *= factor;
      }
    }
    return result;
  }

  [[nodiscard]] math::CovarianceResult rank(const Eigen::VectorXd& z) const {
    Eigen::VectorXd predicted;
    Eigen::MatrixXd jacobian;
    model_.evaluate(z, predicted, &jacobian, nullptr);
    return math::covariance(sd_.cwiseInverse().asDiagonal() * jacobian,
                            (predicted - model_.torque()).cwiseQuotient(sd_),
                            {.rank_tolerance = 1e-7});
  }

 private:
  [[nodiscard]] math::LeastSquaresResult minimize(const Eigen::VectorXd& start,
                                                  int iterations,
                                                  double step,
                                                  double cost) const {
    return math::minimize(problem(), start,
                          {.max_iterations = iterations,
                           .step_tolerance = step,
                           .cost_tolerance = cost,
                           .progress = options_.progress});
  }

  [[nodiscard]] math::LeastSquaresProblem problem() const {
    math::LeastSquaresProblem p;
    const Eigen::Index n = model_.sample_count();
    const auto count = static_cast<Eigen::Index>(model_.free().size());
    p.residual_count = n + prior_count_;
    p.lower.resize(count);
    p.upper.resize(count);
    for (Eigen::Index j = 0; j < count; ++j) {
      p.lower[j] = model_.free()[static_cast<std::size_t>(j)].lower;
      p.upper[j] = model_.free()[static_cast<std::size_t>(j)].upper;
    }
    p.evaluate = [this, n, count](const Eigen::VectorXd& z, Eigen::VectorXd& r,
                                  Eigen::MatrixXd* jacobian) {
      Eigen::VectorXd predicted;
      Eigen::MatrixXd derivative;
      model_.evaluate(z, predicted, jacobian != nullptr ? &derivative : nullptr, nullptr);
      const Eigen::VectorXd weight = std::sqrt(noise_.share) * sd_.cwiseInverse();
      r.head(n) = weight.cwiseProduct(predicted - model_.torque());
      if (jacobian != nullptr) {
        jacobian->topRows(n) = weight.asDiagonal() * derivative;
        jacobian->bottomRows(prior_count_).setZero();
      }
      Eigen::Index row = n;
      for (Eigen::Index j = 0; j < count; ++j) {
        const FreeParameter& f = model_.free()[static_cast<std::size_t>(j)];
        if (!(f.prior_sd > 0.0)) continue;
        r[row] = (z[j] - f.prior_mean) / f.prior_sd;
        if (jacobian != nullptr) (*jacobian)(row, j) = 1.0 / f.prior_sd;
        ++row;
      }
    };
    return p;
  }

  const TorqueOptions& options_;
  TorqueModel model_;
  NoiseModel noise_;
  Eigen::VectorXd sd_;
  double floor_nm_ = 0.0;
  Eigen::Index prior_count_ = 0;
};

/// Cost with everything in it that changes between starts: -2 log posterior up to a constant.
double misfit(const math::LeastSquaresResult& fit, const Fit& search, bool weights) {
  if (!weights) return fit.cost;
  return 2.0 * fit.cost +
         2.0 * search.noise().share * search.standard_deviation().array().log().sum();
}

void report_parameters(const Fit& search,
                       const math::LeastSquaresResult& fit,
                       const StudyData& data,
                       const TorqueOptions& options,
                       IdentificationResult& result) {
  const std::vector<FreeParameter>& free = search.model().free();
  const math::CovarianceResult rank = search.rank(fit.x);
  result.condition = rank.condition;
  const double quantile = math::normal_quantile(0.975);
  std::vector<bool> flat(data.muscles.size(), false);
  for (std::size_t j = 0; j < free.size(); ++j) {
    if (free[j].kind == FreeParameter::Kind::muscle && free[j].field->name == "eccentric_plateau") {
      const auto at = static_cast<Eigen::Index>(j);
      flat[static_cast<std::size_t>(free[j].muscle)] =
          fit.x[at] - quantile * std::sqrt(std::max(0.0, result.covariance(at, at))) <
          VerdictRules{}.flat_plateau;
    }
  }
  for (std::size_t j = 0; j < free.size(); ++j) {
    const FreeParameter& p = free[j];
    const auto at = static_cast<Eigen::Index>(j);
    ParameterEstimate e;
    e.method = "torque";
    e.fit_case = "both";
    e.muscle = p.label.substr(0, p.label.find('.'));
    e.parameter = p.label.substr(p.label.find('.') + 1);
    e.unit = p.kind == FreeParameter::Kind::muscle  ? p.field->unit
             : p.kind == FreeParameter::Kind::delay ? Unit::second
                                                    : Unit::dimensionless;
    e.initial = p.to_value(p.start);
    e.estimate = p.to_value(fit.x[at]);
    e.at_bound = fit.at_bound[j];
    const double sd = std::sqrt(std::max(0.0, result.covariance(at, at)));
    const bool by_data_or_prior = rank.determined[j] || p.prior_sd > 0.0;
    if (by_data_or_prior && std::isfinite(sd)) {
      e.std_error = p.logarithmic ? e.estimate * sd : sd;
      e.ci_low = p.to_value(fit.x[at] - quantile * sd);
      e.ci_high = p.to_value(fit.x[at] + quantile * sd);
      // A bound is knowledge, too: no interval reaches where no muscle lives.
      e.ci_low = std::max(*e.ci_low, p.to_value(p.lower));
      e.ci_high = std::min(*e.ci_high, p.to_value(p.upper));
    }
    if (p.prior_sd > 0.0) {
      e.prior_mean = p.to_value(p.prior_mean);
      e.prior_sd = p.logarithmic ? *e.prior_mean * p.prior_sd : p.prior_sd;
      e.shrinkage = 1.0 - sd * sd / (p.prior_sd * p.prior_sd);
    }
    VerdictContext context;
    if (p.prior_sd > 0.0) context.prior_distance = std::abs(fit.x[at] - p.prior_mean) / p.prior_sd;
    context.determined = by_data_or_prior;
    context.converged = fit.termination == math::Termination::converged;
    context.failure = fit.message;
    context.from_mvc = options.from_mvc;
    context.plateau_is_flat =
        p.kind == FreeParameter::Kind::muscle && flat[static_cast<std::size_t>(p.muscle)];
    judge(e, context);
    if (p.kind == FreeParameter::Kind::gain) {
      e.verdict = Verdict::prior_dominated;
      e.reason =
          "carries the uncertainty of the EMG normalisation into the intervals of F_max; the "
          "recording cannot tell it from F_max";
    }
    result.free_parameters.push_back(p.label);
    result.estimates.push_back(std::move(e));
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto a = static_cast<Eigen::Index>(i);
      const auto b = static_cast<Eigen::Index>(j);
      const double correlation =
          result.covariance(a, b) / std::sqrt(result.covariance(a, a) * result.covariance(b, b));
      if (std::abs(correlation) > 0.9 && free[i].kind != FreeParameter::Kind::gain &&
          free[j].kind != FreeParameter::Kind::gain) {
        result.collinear.push_back(fmt::format("{} and {} (correlation {:.2f})", free[j].label,
                                               free[i].label, correlation));
      }
    }
  }
}

}  // namespace

double coefficient_of_determination(const Eigen::VectorXd& reference,
                                    const Eigen::VectorXd& predicted) {
  const double total = (reference.array() - reference.mean()).square().sum();
  return total > 0.0 ? 1.0 - (reference - predicted).squaredNorm() / total : 0.0;
}

Prediction predict(const StudyData& data,
                   const TrialData& trial,
                   const std::vector<muscle::HillParameters<double>>& muscles,
                   double delay_s) {
  const Eigen::MatrixXd activation = muscle_activation(data, trial, trial.time_s, delay_s);
  Prediction p;
  p.force_n.resize(trial.time_s.size(), trial.length_m.cols());
  for (Eigen::Index k = 0; k < p.force_n.cols(); ++k) {
    const auto& parameters = muscles[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < p.force_n.rows(); ++i) {
      p.force_n(i, k) = muscle::hill_force(activation(i, k),
                                           trial.length_m(i, k) - parameters.tendon_slack_length_m,
                                           trial.velocity_mps(i, k), parameters);
    }
  }
  if (trial.moment_arm_m.rows() == trial.time_s.size())
    p.torque_nm = trial.moment_arm_m.cwiseProduct(p.force_n).rowwise().sum();
  return p;
}

IdentificationResult identify_torque(const StudyData& data, const TorqueOptions& options) {
  validate(data);
  const auto begin = std::chrono::steady_clock::now();
  Fit search(data, options);
  const std::vector<FreeParameter>& free = search.model().free();
  Eigen::VectorXd start(static_cast<Eigen::Index>(free.size()));
  for (std::size_t j = 0; j < free.size(); ++j) start[static_cast<Eigen::Index>(j)] = free[j].start;

  if (options.warm_start.size() == start.size()) start = options.warm_start;

  // The given start, and starts moved by a spread of the prior (or a part of the value) in
  // alternating directions.
  math::LeastSquaresResult best = search.run(start);
  std::optional<Fit> best_search(search);
  const double start_cost = best.cost_history.empty() ? 0.0 : best.cost_history.front();
  // Without priors there are more false minima, and nothing but the cost to tell them by.
  const int starts = options.weights ? options.starts : 3 * options.starts;
  for (int s = 1; s < starts && !(best.cost <= 1e-18 * start_cost); ++s) {
    Eigen::VectorXd x = start;
    for (std::size_t j = 0; j < free.size(); ++j) {
      const auto at = static_cast<Eigen::Index>(j);
      const double step = free[j].prior_sd > 0.0 ? free[j].prior_sd
                          : free[j].logarithmic  ? 0.3
                                                 : 0.1 * std::abs(free[j].start);
      // Start s turns sign by the bits of a fixed mixing of its number and the parameter's: the
      // same on every machine.
      const std::uint64_t mixed = (static_cast<std::uint64_t>(s) * 0x9E3779B97F4A7C15ULL) ^
                                  ((j + 1) * 0xD1B54A32D192ED03ULL);
      const double sign = ((mixed >> 33) & 1U) == 0 ? 1.0 : -1.0;
      x[at] = std::clamp(x[at] + sign * step, free[j].lower, free[j].upper);
    }
    if (options.weights) {
      // Most starts lead to the same minimum: a glance tells, at the same weights.
      const math::LeastSquaresResult look = search.glance(x);
      if (!(look.cost < (1.0 - 1e-3) * best.cost)) continue;
      x = look.x;
    }
    Fit attempt(search);
    const math::LeastSquaresResult fit = attempt.run(x);
    if (misfit(fit, attempt, options.weights) < misfit(best, *best_search, options.weights)) {
      best = fit;
      best_search.emplace(attempt);
    }
  }
  const Fit& chosen = *best_search;

  IdentificationResult result;
  result.method = "torque";
  result.termination = best.termination;
  result.message = best.message;
  result.iterations = best.iterations;
  result.samples_used = static_cast<int>(chosen.model().sample_count());
  result.samples_dropped = chosen.model().dropped();
  result.effective_samples =
      chosen.noise().share * static_cast<double>(chosen.model().sample_count());
  result.torque_sd_nm = chosen.noise().torque_sd_nm;
  result.emg_cv = chosen.noise().emg_cv;
  result.solution = best.x;
  result.muscles = chosen.model().muscles(best.x);
  result.delay_s = chosen.model().delay_s(best.x);
  result.covariance = chosen.covariance(best.x);
  if (!options.weights) {
    // Plain least squares: the residuals' own variance.
    const double freedom = std::max(
        1.0, static_cast<double>(chosen.model().sample_count()) - static_cast<double>(free.size()));
    result.torque_sd_nm = std::sqrt(2.0 * best.cost / freedom);
  }
  report_parameters(chosen, best, data, options, result);

  std::vector<muscle::HillParameters<double>> literature;
  for (const MuscleSetup& setup : data.muscles) literature.push_back(setup.start);
  const double literature_delay = options.delay_s.value_or(options.delay_prior_mean_s);
  for (const TrialData& trial : data.trials) {
    TrialFit fit;
    fit.trial = trial.name;
    fit.calibration = trial.calibration;
    fit.time_s = trial.time_s;
    fit.torque_nm = trial.torque_nm;
    Prediction before = predict(data, trial, literature, literature_delay);
    Prediction after = predict(data, trial, result.muscles, result.delay_s);
    fit.rmse_nm = std::sqrt((after.torque_nm - trial.torque_nm).squaredNorm() /
                            static_cast<double>(trial.time_s.size()));
    fit.r2 = coefficient_of_determination(trial.torque_nm, after.torque_nm);
    fit.literature_force_n = std::move(before.force_n);
    fit.literature_torque_nm = std::move(before.torque_nm);
    fit.force_fit_n = std::move(after.force_n);
    fit.torque_fit_nm = std::move(after.torque_nm);
    result.trials.push_back(std::move(fit));
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace myoid::identification
