#include "myoid/identification/paper.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/LU>
#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/identification/identifiability.h"
#include "myoid/identification/muscle_sample.h"
#include "myoid/identification/score.h"
#include "myoid/math/covariance.h"
#include "myoid/math/statistics.h"
#include "myoid/muscle/hill_muscle.h"

namespace myoid::identification {
namespace {

/// Residual over force below which the data are free of noise and the model is theirs.
constexpr double kExact = 1e-6;

/// The samples of one muscle in one case, and the stretches of consecutive ones.
struct CaseData {
  std::vector<MuscleSample> samples;
  std::vector<Eigen::Index> pieces;
  int dropped = 0;
};

CaseData collect(const StudyData& data, std::size_t muscle, bool shortening) {
  CaseData result;
  const MuscleSetup& setup = data.muscles[muscle];
  const auto column = static_cast<Eigen::Index>(muscle);
  for (const TrialData& trial : data.trials) {
    if (!trial.calibration) continue;
    if (trial.force_n.rows() != trial.time_s.size()) {
      throw InvalidInput(fmt::format(
          "method paper: trial '{}' has no muscle forces; share the torque first (myoid so)",
          trial.name));
    }
    const Eigen::MatrixXd activation = muscle_activation(data, trial, trial.time_s, 0.0);
    Eigen::Index run = 0;
    for (const Eigen::Index i : included_rows(trial)) {
      const double v = trial.velocity_mps(i, column);
      const bool here = (v <= 0.0) == shortening;
      const bool informative =
          activation(i, column) > 0.0 && v > -setup.start.max_shortening_speed_mps;
      if (here && !informative) ++result.dropped;
      if (here && informative) {
        result.samples.push_back({trial.time_s[i], activation(i, column),
                                  trial.length_m(i, column) - setup.start.tendon_slack_length_m, v,
                                  trial.force_n(i, column)});
        ++run;
      } else if (run > 0) {
        result.pieces.push_back(run);
        run = 0;
      }
    }
    if (run > 0) result.pieces.push_back(run);
  }
  return result;
}

struct Unknown {
  const muscle::HillField* field;
  double muscle::HillForce::*derivative;
};

std::vector<Unknown> unknowns(bool shortening) {
  std::vector<Unknown> list{
      {&muscle::hill_field("optimal_fiber_length"), &muscle::HillForce::by_optimal_fiber_length},
      {&muscle::hill_field("force_length_width"), &muscle::HillForce::by_force_length_width}};
  if (shortening) {
    list.push_back(
        {&muscle::hill_field("concentric_curvature"), &muscle::HillForce::by_concentric_curvature});
  } else {
    list.push_back({&muscle::hill_field("eccentric_curvature_product"),
                    &muscle::HillForce::by_eccentric_curvature_product});
    list.push_back(
        {&muscle::hill_field("eccentric_plateau"), &muscle::HillForce::by_eccentric_plateau});
  }
  return list;
}

/// l0 and l_sh of one case with their covariance.
struct CaseShape {
  Eigen::Vector2d value = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
};

std::optional<CaseShape> fit_case(const StudyData& data,
                                  std::size_t muscle,
                                  bool shortening,
                                  const PaperOptions& options,
                                  IdentificationResult& result) {
  const MuscleSetup& setup = data.muscles[muscle];
  const CaseData samples = collect(data, muscle, shortening);
  const std::vector<Unknown> list = unknowns(shortening);
  const auto p = static_cast<Eigen::Index>(list.size());
  const auto n = static_cast<Eigen::Index>(samples.samples.size());
  result.samples_dropped += samples.dropped;
  result.samples_used += static_cast<int>(n);
  Eigen::VectorXd start(p);
  for (Eigen::Index j = 0; j < p; ++j)
    start[j] = setup.start.*list[static_cast<std::size_t>(j)].field->member;

  const double force_scale = std::accumulate(
      samples.samples.begin(), samples.samples.end(), 0.0,
      [](double sum, const MuscleSample& s) { return std::max(sum, std::abs(s.force_n)); });
  math::LeastSquaresResult fit;
  fit.x = start;
  std::string failure;
  if (n < 10 * p) {
    failure = fmt::format("only {} samples in {}", n, shortening ? "shortening" : "lengthening");
  } else if (!(force_scale > 0.0)) {
    failure = "force sharing assigned no force to this muscle here";
  } else {
    math::LeastSquaresProblem problem;
    problem.residual_count = n;
    problem.evaluate = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r,
                           Eigen::MatrixXd* jacobian) {
      muscle::HillParameters<double> parameters = setup.start;
      for (Eigen::Index j = 0; j < p; ++j)
        parameters.*list[static_cast<std::size_t>(j)].field->member = x[j];
      for (Eigen::Index i = 0; i < n; ++i) {
        const MuscleSample& s = samples.samples[static_cast<std::size_t>(i)];
        const muscle::HillForce f = muscle::hill_force_derivatives(
            s.activation, s.fiber_length_m, s.fiber_velocity_mps, parameters);
        r[i] = f.force_n - s.force_n;
        if (jacobian == nullptr) continue;
        for (Eigen::Index j = 0; j < p; ++j)
          (*jacobian)(i, j) = f.*list[static_cast<std::size_t>(j)].derivative;
      }
    };
    try {
      fit = math::minimize(problem, start,
                           {.method = math::LeastSquaresMethod::gauss_newton,
                            .max_iterations = options.max_iterations,
                            .step_tolerance = 1e-10,
                            .gradient_tolerance = 1e-13});
      if (fit.termination != math::Termination::converged) failure = fit.message;
    } catch (const InvalidInput& error) {
      failure = error.what();
    }
  }
  result.iterations += fit.iterations;
  // l_sh enters squared: its sign means nothing.
  fit.x[1] = std::abs(fit.x[1]);
  for (Eigen::Index j = 0; j < p; ++j) {
    if (!(std::abs(fit.x[j]) <= 1e3 * std::abs(start[j])))
      failure = "plain Gauss-Newton steps diverged";
  }
  if (!failure.empty())
    result.message +=
        fmt::format("{}, {}: {}. ", setup.name, shortening ? "shortening" : "lengthening", failure);

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
    const muscle::Range bounds = list[static_cast<std::size_t>(j)].field->bounds;
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
    if (unphysical(j)) bad_company = std::string(list[static_cast<std::size_t>(j)].field->name);
  }
  for (Eigen::Index j = 0; j < p; ++j) {
    const muscle::HillField& field = *list[static_cast<std::size_t>(j)].field;
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
    if (e.parameter == "force_length_width" && !exact && fit.x[0] > 0.0 && fit.x[j] != start[j])
      context.relative_width = std::abs(fit.x[j]) / fit.x[0];
    if (!shortening && p == 4 && std::isfinite(fit.x[3])) {
      const double sd =
          computed ? std::sqrt(covariance.unscaled(3, 3) * covariance.residual_variance * widen)
                   : 0.0;
      context.plateau_is_flat = std::abs(fit.x[3] - 1.0) < quantile * sd;
    }
    judge(e, context);
    result.estimates.push_back(std::move(e));
  }
  if (!failure.empty() || !computed || covariance.rank < p) return std::nullopt;
  return CaseShape{fit.x.head(2),
                   covariance.unscaled.topLeftCorner(2, 2) * covariance.residual_variance * widen};
}

/// Wald test of what both cases share.
void compare_branches(const std::string& muscle,
                      const CaseShape& shortening,
                      const CaseShape& lengthening,
                      IdentificationResult& result) {
  const Eigen::Vector2d difference = lengthening.value - shortening.value;
  const Eigen::Matrix2d covariance = shortening.covariance + lengthening.covariance;
  if (!(covariance.determinant() > 0.0)) return;
  const double wald = difference.dot(covariance.inverse() * difference);
  result.branch_tests.push_back(
      {muscle, difference[0], difference[1], wald, std::exp(-0.5 * wald)});
  if (wald > 13.8) {  // p < 0.001
    result.warnings.push_back(fmt::format(
        "{}: shortening and lengthening give different l0 or l_sh (by {:+.1f} and {:+.1f} mm, p < "
        "0.001): one muscle has one of each, so the model or the data are wrong for it",
        muscle, 1000.0 * difference[0], 1000.0 * difference[1]));
  }
}

}  // namespace

IdentificationResult identify_paper(const StudyData& data, const PaperOptions& options) {
  validate(data);
  const auto begin = std::chrono::steady_clock::now();
  IdentificationResult result;
  result.method = "paper";
  result.termination = math::Termination::converged;
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    result.muscles.push_back(data.muscles[k].start);
    if (!options.muscles.empty() && std::find(options.muscles.begin(), options.muscles.end(),
                                              data.muscles[k].name) == options.muscles.end())
      continue;
    const auto shortening = fit_case(data, k, true, options, result);
    const auto lengthening = fit_case(data, k, false, options, result);
    if (shortening && lengthening)
      compare_branches(data.muscles[k].name, *shortening, *lengthening, result);
  }
  if (!result.message.empty()) result.termination = math::Termination::no_descent;
  diagnose(result);
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
      muscle::HillParameters<double> by_case[2] = {setup.start, setup.start};
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
