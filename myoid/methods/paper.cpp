#include "myoid/methods/paper.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include <Eigen/LU>
#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/identification/muscle_activation.h"
#include "myoid/identification/paper_case.h"
#include "myoid/intervals/identifiability.h"
#include "myoid/intervals/score.h"
#include "myoid/intervals/signatures.h"
#include "myoid/math/covariance.h"
#include "myoid/math/statistics.h"
#include "myoid/methods/basins.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::identification {
namespace {

/// Residual over force below which the data are free of noise and the model is theirs.
constexpr double kExact = 1e-6;

/// l0 and l_sh of one case with their covariance, which is 0 of what is held.
struct CaseShape {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};
constexpr std::array<std::string_view, 2> kShared{"optimal_fiber_length", "force_length_width"};

/// Where full steps find no minimum, damped ones may: no estimate, but it shows the signature of an
/// error that the data carry. Empty where they find none either.
std::optional<Eigen::VectorXd> damped_minimum(const PaperCase& samples) {
  const auto p = static_cast<Eigen::Index>(samples.unknowns.size());
  if (static_cast<Eigen::Index>(samples.samples.size()) < 10 * p) return std::nullopt;
  if (!(samples.largest_force_n() > 0.0)) return std::nullopt;
  try {
    const math::LeastSquaresResult fit = math::minimize(samples.problem(), samples.start_vector());
    // V_sh or P on their way to infinity never arrive, and change nothing any more.
    const std::vector<double>& costs = fit.cost_history;
    constexpr std::size_t kLast = 10;
    const bool settled =
        costs.size() > kLast && costs.back() > (1.0 - 1e-3) * costs[costs.size() - 1 - kLast];
    if (fit.x.allFinite() && (fit.termination == math::Termination::converged || settled))
      return fit.x;
  } catch (const InvalidInput&) {  // not finite at the start
  }
  return std::nullopt;
}

std::optional<CaseShape> fit_case(const StudyData& data,
                                  std::size_t muscle,
                                  bool shortening,
                                  const PaperOptions& options,
                                  IdentificationResult& result,
                                  std::vector<ParameterEstimate>& minima) {
  const MuscleSetup& setup = data.muscles[muscle];
  const PaperCase samples = paper_case(data, muscle, shortening);
  const std::vector<const muscle::HillField*>& list = samples.unknowns;
  const auto p = static_cast<Eigen::Index>(list.size());
  const auto n = static_cast<Eigen::Index>(samples.samples.size());
  result.samples_dropped += samples.dropped;
  result.samples_used += static_cast<int>(n);
  result.muscles[muscle] = samples.start;
  if (p == 0) return std::nullopt;
  const Eigen::VectorXd start = samples.start_vector();
  /// Where an unknown is in x, or -1 if it is held.
  const auto at = [&](std::string_view name) {
    const auto it = std::find_if(list.begin(), list.end(),
                                 [&](const muscle::HillField* u) { return u->name == name; });
    return it == list.end() ? Eigen::Index{-1} : static_cast<Eigen::Index>(it - list.begin());
  };
  const Eigen::Index length = at("optimal_fiber_length");
  const Eigen::Index width = at("force_length_width");
  const Eigen::Index plateau = at("eccentric_plateau");

  math::LeastSquaresResult fit;
  fit.x = start;
  std::string failure = samples.obstacle();
  if (failure.empty()) {
    fit = search_as_published(samples, start);
    if (fit.termination != math::Termination::converged) failure = fit.message;
  }
  result.iterations += fit.iterations;
  if (!failure.empty())
    result.message +=
        fmt::format("{}, {}: {}. ", setup.name, shortening ? "shortening" : "lengthening", failure);
  const std::optional<Eigen::VectorXd> minimum =
      failure.empty() ? std::optional(fit.x) : damped_minimum(samples);

  math::CovarianceResult covariance;
  double widen = 1.0;
  const bool computed =
      fit.residual.size() == n && fit.jacobian.allFinite() && fit.residual.allFinite() && n > p;
  if (computed) {
    covariance = math::covariance(fit.jacobian, fit.residual);
    const double effective = math::effective_sample_size(fit.residual, samples.pieces);
    widen = static_cast<double>(n) / std::max(effective, 1.0);
    result.effective_samples += effective;
  }
  const double quantile = math::normal_quantile(0.975);
  const auto unphysical = [&](Eigen::Index j) {
    const muscle::Range bounds = list[static_cast<std::size_t>(j)]->bounds;
    return fit.x[j] != start[j] && std::isfinite(fit.x[j]) &&
           (fit.x[j] < bounds.lower || fit.x[j] > bounds.upper);
  };
  double r2 = 1.0;
  bool exact = false;
  if (computed) {
    Eigen::VectorXd force(n);
    for (Eigen::Index i = 0; i < n; ++i)
      force[i] = samples.samples[static_cast<std::size_t>(i)].force_n;
    r2 = coefficient_of_determination(force, force + fit.residual);
    exact = fit.residual.norm() <= kExact * force.norm();
    result.r2 = std::min(result.r2, r2);
  }
  std::string bad_company;
  for (Eigen::Index j = 0; j < p; ++j) {
    if (unphysical(j)) bad_company = std::string(list[static_cast<std::size_t>(j)]->name);
  }
  for (Eigen::Index j = 0; j < p; ++j) {
    const muscle::HillField& field = *list[static_cast<std::size_t>(j)];
    ParameterEstimate e;
    e.muscle = setup.name;
    e.parameter = std::string(field.name);
    e.unit = field.unit;
    e.method = "paper";
    e.fit_case = shortening ? "shortening" : "lengthening";
    e.initial = start[j];
    e.estimate = std::abs(fit.x[j]) <= 1e3 * std::abs(start[j])
                     ? fit.x[j]
                     : std::numeric_limits<double>::quiet_NaN();
    VerdictContext context;
    context.bad_company = bad_company;
    context.shared_forces = options.shared_forces;
    context.given_strength = !options.shared_forces && !exact;
    context.r2 = r2;
    if (const auto prior = setup.priors.find(e.parameter);
        prior != setup.priors.end() && !prior->second.logarithmic && options.shared_forces) {
      context.prior_distance = std::abs(e.estimate - prior->second.mean) / prior->second.sd;
    }
    context.converged = failure.empty();
    context.failure = failure;
    context.determined = computed && covariance.determined[static_cast<std::size_t>(j)];
    if (context.determined && context.converged) {
      e.std_error = std::sqrt(covariance.unscaled(j, j) * covariance.residual_variance * widen);
      e.ci_low = e.estimate - quantile * *e.std_error;
      e.ci_high = e.estimate + quantile * *e.std_error;
    }
    context.outside_physical = unphysical(j);
    const double l0 = length >= 0 ? fit.x[length] : samples.start.optimal_fiber_length_m;
    if (j == width && !exact && l0 > 0.0 && fit.x[j] != start[j])
      context.relative_width = std::abs(fit.x[j]) / l0;
    if (plateau >= 0 && std::isfinite(fit.x[plateau])) {
      const double sd = computed ? std::sqrt(covariance.unscaled(plateau, plateau) *
                                             covariance.residual_variance * widen)
                                 : 0.0;
      context.plateau_is_flat = std::abs(fit.x[plateau] - 1.0) < quantile * sd;
    }
    judge(e, context);
    if (minimum) {
      minima.push_back(e);
      minima.back().estimate = j == width ? std::abs((*minimum)[j]) : (*minimum)[j];
    }
    result.estimates.push_back(std::move(e));
  }
  if (!failure.empty() || !computed || covariance.rank < p) return std::nullopt;
  CaseShape shape{{samples.start.optimal_fiber_length_m, samples.start.force_length_width_m}, {}};
  shape.covariance.setZero();
  const std::array<Eigen::Index, 2> where{length, width};
  for (Eigen::Index a = 0; a < 2; ++a) {
    const Eigen::Index i = where[static_cast<std::size_t>(a)];
    if (i < 0) continue;
    shape.value[a] = fit.x[i];
    for (Eigen::Index b = 0; b < 2; ++b) {
      const Eigen::Index j = where[static_cast<std::size_t>(b)];
      if (j >= 0)
        shape.covariance(a, b) = covariance.unscaled(i, j) * covariance.residual_variance * widen;
    }
  }
  return shape;
}

/// Wald test of what both cases share and neither holds; where it rejects, neither case is trusted.
void compare_branches(const std::string& muscle,
                      const CaseShape& shortening,
                      const CaseShape& lengthening,
                      IdentificationResult& result) {
  constexpr double kReject = 0.01;
  const Eigen::Vector2d difference = lengthening.value - shortening.value;
  const Eigen::Matrix2d covariance = shortening.covariance + lengthening.covariance;
  std::vector<Eigen::Index> free;
  for (Eigen::Index j = 0; j < 2; ++j) {
    if (covariance(j, j) > 0.0) free.push_back(j);
  }
  // Data without noise leave differences that only rounding makes: a thousandth refutes nothing.
  constexpr double kRounding = 1e-3;
  Eigen::MatrixXd of_free = covariance(free, free);
  for (std::size_t i = 0; i < free.size(); ++i)
    of_free(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i)) +=
        std::pow(kRounding * shortening.value[free[i]], 2);
  if (free.empty() || !(of_free.determinant() > 0.0)) return;
  const Eigen::VectorXd d = difference(free);
  const double wald = d.dot(of_free.inverse() * d);
  const double p = math::chi_squared_tail(wald, static_cast<double>(free.size()));
  result.branch_tests.push_back({muscle, difference[0], difference[1], wald, p});
  if (!(p < kReject)) return;
  const std::string how = p < 0.001 ? "p < 0.001" : fmt::format("p = {:.3f}", p);
  result.warnings.push_back(fmt::format(
      "{}: shortening and lengthening give different l0 or l_sh (by {:+.1f} and {:+.1f} mm, {}): "
      "one muscle has one of each, so the model or the data are wrong for it, and none of its "
      "numbers is called identified",
      muscle, 1000.0 * difference[0], 1000.0 * difference[1], how));
  for (ParameterEstimate& e : result.estimates) {
    if (e.muscle != muscle || e.verdict != Verdict::identified) continue;
    const bool shared = std::find(kShared.begin(), kShared.end(), e.parameter) != kShared.end();
    e.verdict = Verdict::weak;
    e.reason += fmt::format(", but {} ({}): one muscle has one of each, the model is refuted",
                            shared ? "the other branch gives another value"
                                   : "the two branches give different l0 or l_sh",
                            how);
  }
}

/// The table, and a word where the given start missed the lowest minimum.
void add_basins(const StudyData& data,
                std::size_t muscle,
                bool shortening,
                const PaperOptions& options,
                IdentificationResult& result) {
  BasinTable table = find_paper_basins(data, muscle, shortening, options.multistart);
  if (table.basins.empty()) return;
  const BasinRow& best = table.basins.front();
  if (!best.given && best.converged > 0)
    result.warnings.push_back(fmt::format(
        "{}: {} of {} starts end at a lower sum of squares than the given one; its numbers are "
        "those of the given start, as published",
        table.fit, best.starts, table.starts));
  result.basins.push_back(std::move(table));
}

}  // namespace

IdentificationResult identify_paper(const StudyData& data, const PaperOptions& options) {
  validate(data);
  const auto begin = std::chrono::steady_clock::now();
  IdentificationResult result;
  result.method = "paper";
  result.termination = math::Termination::converged;
  std::vector<ParameterEstimate> minima;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    result.muscles.push_back(data.muscles[k].start);
    if (!options.muscles.empty() && std::find(options.muscles.begin(), options.muscles.end(),
                                              data.muscles[k].name) == options.muscles.end())
      continue;
    const auto shortening = fit_case(data, k, true, options, result, minima);
    const auto lengthening = fit_case(data, k, false, options, result, minima);
    if (options.multistart > 1) {
      for (const bool branch : {true, false}) add_basins(data, k, branch, options, result);
    }
    if (shortening && lengthening)
      compare_branches(data.muscles[k].name, *shortening, *lengthening, result);
  }
  if (!result.message.empty()) result.termination = math::Termination::no_descent;
  result.diagnoses = signatures(minima);
  for (const TrialData& trial : data.trials) {
    TrialFit fit;
    fit.trial = trial.name;
    fit.calibration = trial.calibration;
    fit.time_s = trial.time_s;
    fit.joint = trial.joint;
    fit.torque_nm = trial.torque_nm;
    const Eigen::MatrixXd activation = muscle_activation(data, trial, trial.time_s, 0.0);
    fit.literature_force_n.resize(trial.time_s.size(), trial.length_m.cols());
    fit.force_fit_n = fit.literature_force_n;
    for (std::size_t k = 0; k < data.muscles.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const MuscleSetup& setup = data.muscles[k];
      muscle::HillParameters<double> by_case[2] = {result.muscles[k], result.muscles[k]};
      for (const ParameterEstimate& e : result.estimates) {
        if (e.muscle != setup.name || !std::isfinite(e.estimate)) continue;
        by_case[e.fit_case == "shortening" ? 0 : 1].*muscle::hill_field(e.parameter).member =
            e.estimate;
      }
      for (Eigen::Index i = 0; i < trial.time_s.size(); ++i) {
        const double l = trial.length_m(i, column) - setup.start.tendon_slack_length_m;
        const double v = trial.velocity_mps(i, column);
        fit.literature_force_n(i, column) =
            muscle::hill_force(activation(i, column), l, v, setup.start);
        fit.force_fit_n(i, column) =
            muscle::hill_force(activation(i, column), l, v, by_case[v <= 0.0 ? 0 : 1]);
      }
    }
    if (trial.moment_arm_m.rows() == trial.time_s.size()) {
      const Eigen::VectorXd resting = resting_torque_nm(trial);
      fit.literature_torque_nm =
          trial.moment_arm_m.cwiseProduct(fit.literature_force_n).rowwise().sum() + resting;
      fit.torque_fit_nm =
          trial.moment_arm_m.cwiseProduct(fit.force_fit_n).rowwise().sum() + resting;
    }
    result.trials.push_back(std::move(fit));
  }
  result.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

}  // namespace myoid::identification
