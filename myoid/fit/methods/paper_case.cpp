#include "myoid/fit/methods/paper_case.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "myoid/fit/measurement/muscle_activation.h"
#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/math/halved_steps.h"

namespace myoid::fit {
namespace {

/// Speed below which a muscle is at rest: the sign of a computed speed there is that of rounding. Both laws agree at 0.
constexpr double kStill_mps = 1e-9;

void add_samples(const StudyData& data, std::size_t muscle, PaperCase& result) {
  const auto column = static_cast<Eigen::Index>(muscle);
  for (const TrialData& trial : data.trials) {
    if (!trial.calibration || trial.reference) continue;
    if (trial.force_n.rows() != trial.time_s.size()) {
      throw InvalidInput(
          fmt::format("method paper: trial '{}' has no muscle forces; share the torque first (myoid so)", trial.name));
    }
    const Eigen::MatrixXd activation = muscle_activation(data, trial, 0.0);
    Eigen::Index run = 0;
    for (const Eigen::Index i : included_rows(trial)) {
      const double v = trial.velocity_mps(i, column);
      const bool here = (v <= kStill_mps) == result.shortening;
      const bool informative = activation(i, column) > 0.0 && v > -result.start.max_shortening_speed_mps;
      if (here && !informative) ++result.dropped;
      if (here && informative) {
        result.samples.push_back({trial.time_s[i], activation(i, column),
                                  trial.length_m(i, column) - result.start.tendon_slack_length_m, v,
                                  trial.force_n(i, column)});
        ++run;
      } else if (run > 0) {
        result.pieces.push_back(run);
        run = 0;
      }
    }
    if (run > 0) result.pieces.push_back(run);
  }
}

using CriterionSearch = std::function<math::LeastSquaresResult(const math::LeastSquaresProblem&)>;

/// Searches; an end where an unknown is beyond a thousand times its start is none, for the reason `away`.
math::LeastSquaresResult criterion_end(const PaperCase& samples,
                                       const Eigen::VectorXd& start,
                                       const CriterionSearch& search,
                                       std::string_view away) {
  constexpr double kAway = 1e3;
  math::LeastSquaresResult found;
  try {
    found = search(samples.problem());
  } catch (const InvalidInput& error) {
    found.x = start;
    found.cost = std::numeric_limits<double>::infinity();
    found.termination = math::Termination::not_finite;
    found.message = error.what();
    return found;
  }
  for (Eigen::Index j = 0; j < start.size(); ++j) {
    const muscle::HillField& unknown = *samples.unknowns[static_cast<std::size_t>(j)];
    if (unknown.name == "force_length_width") found.x[j] = std::abs(found.x[j]);
    if (std::abs(found.x[j]) <= kAway * std::abs(start[j])) continue;
    found.termination = math::Termination::no_descent;
    found.message = fmt::format(fmt::runtime(away), unknown.name);
  }
  return found;
}

}  // namespace

PaperCase paper_case(const StudyData& data, std::size_t muscle, bool shortening) {
  const MuscleSetup& setup = data.muscles[muscle];
  PaperCase result;
  result.muscle = setup.name;
  result.shortening = shortening;
  result.start = setup.start;
  std::vector<std::string> held = setup.fixed;
  for (const ParameterRule& rule : data.rules) {
    if (!covers(rule.owners, setup.name)) continue;
    for (const muscle::HillField& field : muscle::kHillFields) {
      if (field.name == rule.parameter && rule.value) result.start.*field.member = *rule.value;
    }
    if (rule.free) std::erase(held, rule.parameter);
    if (rule.free == std::optional(false)) held.push_back(rule.parameter);
  }
  const auto add = [&](std::string_view name) {
    if (!contains(held, name)) result.unknowns.push_back(&muscle::hill_field(name));
  };
  add("optimal_fiber_length");
  add("force_length_width");
  if (shortening) {
    add("concentric_curvature");
  } else {
    add("eccentric_curvature_product");
    add("eccentric_plateau");
  }
  add_samples(data, muscle, result);
  return result;
}

std::string PaperCase::name() const { return muscle + (shortening ? " shortening" : " lengthening"); }

Eigen::VectorXd PaperCase::start_vector() const {
  Eigen::VectorXd x(static_cast<Eigen::Index>(unknowns.size()));
  for (std::size_t j = 0; j < unknowns.size(); ++j) x[static_cast<Eigen::Index>(j)] = start.*unknowns[j]->member;
  return x;
}

std::string PaperCase::obstacle() const {
  if (samples.size() < 10 * unknowns.size())
    return fmt::format("only {} samples in {}", samples.size(), shortening ? "shortening" : "lengthening");
  if (std::ranges::none_of(samples, [](const MuscleSample& s) { return std::abs(s.force_n) > 0.0; }))
    return "force sharing assigned no force to this muscle here";
  return {};
}

math::LeastSquaresProblem PaperCase::problem() const {
  math::LeastSquaresProblem problem;
  problem.residual_count = static_cast<Eigen::Index>(samples.size());
  problem.evaluate = [this](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    muscle::HillParameters<double> parameters = start;
    for (std::size_t j = 0; j < unknowns.size(); ++j) parameters.*unknowns[j]->member = x[static_cast<Eigen::Index>(j)];
    parameters.tendon_slack_length_m = 0.0;  // the samples hold fiber lengths
    const MuscleValues values = muscle_values(parameters);
    Tension t;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const MuscleSample& s = samples[i];
      const auto row = static_cast<Eigen::Index>(i);
      plain_tension(s.activation, s.fiber_length_m, s.fiber_velocity_mps, values, t);
      r[row] = t.force_n - s.force_n;
      if (jacobian == nullptr) continue;
      for (std::size_t j = 0; j < unknowns.size(); ++j) {
        const auto field = static_cast<std::size_t>(unknowns[j] - muscle::kHillFields.data());
        (*jacobian)(row, static_cast<Eigen::Index>(j)) = t.by_field[field];
      }
    }
  };
  return problem;
}

math::LeastSquaresResult search_as_published(const PaperCase& samples,
                                             const Eigen::VectorXd& start,
                                             const Progress& progress) {
  const auto full_steps = [&](const math::LeastSquaresProblem& problem) {
    return math::minimize(problem, start,
                          {.method = math::LeastSquaresMethod::gauss_newton,
                           .max_iterations = 100,
                           .step_tolerance = 1e-10,
                           .gradient_tolerance = 1e-13,
                           .progress = progress});
  };
  return criterion_end(samples, start, full_steps, "plain Gauss-Newton steps diverged");
}

MinimumSearch search_for_minimum(const PaperCase& samples, const Eigen::VectorXd& start) {
  const auto found_by = [&](const CriterionSearch& search) {
    math::LeastSquaresResult found =
        criterion_end(samples, start, search, "the criterion falls as {} grows without limit");
    double idle = 0.0;  // cost of a muscle that makes no force
    for (const MuscleSample& s : samples.samples) idle += 0.5 * s.force_n * s.force_n;
    if (std::isfinite(found.cost) && found.cost > 0.999 * idle) {
      found.termination = math::Termination::no_descent;
      found.message = "the steps ended where the muscle makes no force, or one that is no better than none";
    }
    return found;
  };
  MinimumSearch halved{.found = found_by([&](const math::LeastSquaresProblem& problem) {
                         return math::minimize_by_halved_steps(problem, start);
                       })};
  if (halved.found.termination == math::Termination::converged) return halved;
  MinimumSearch damped{.found = found_by([&](const math::LeastSquaresProblem& problem) {
                         return math::minimize(problem, start, {.max_iterations = 500});
                       }),
                       .damped = true};
  const bool better = damped.found.termination == math::Termination::converged || damped.found.cost < halved.found.cost;
  return better ? damped : halved;
}

}  // namespace myoid::fit
