#include "myoid/muscle/fit_isolated.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/math/statistics.h"

namespace myoid::muscle {
namespace {

struct Field {
  double* value = nullptr;
  Unit unit = Unit::dimensionless;
};

/// Returns the field of this name; throws InvalidInput with all names if there is none.
Field field_of(MusculotendonParameters<double>& parameters, const std::string& wanted) {
  Field found;
  std::string names;
  visit_parameters(parameters, [&](std::string_view name, Unit unit, double& field) {
    names += (names.empty() ? "" : ", ") + std::string(name);
    if (name == wanted) found = {&field, unit};
  });
  if (found.value == nullptr) throw InvalidInput(fmt::format("a muscle has no '{}'; there are {}", wanted, names));
  return found;
}

IsolatedModel with_values(const IsolatedModel& start,
                          const std::vector<std::string>& names,
                          const Eigen::VectorXd& logs) {
  IsolatedModel model = start;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double value = std::exp(logs[static_cast<Eigen::Index>(i)]);
    *field_of(model.parameters, names[i]).value = value;
    if (names[i] == "eccentric_plateau" && model.laws.velocity == VelocityLaw::millard)
      model.millard.max_eccentric_multiplier = value;
  }
  return model;
}

}  // namespace

Eigen::VectorXd isolated_force(const IsolatedModel& model,
                               const IsolatedRecording& recording,
                               double relative_tolerance,
                               const Progress& progress) {
  const Musculotendon<double> unit(model.parameters, model.laws, model.millard);
  const IsolatedMuscleResult result = simulate_isolated_muscle(unit, recording.input,
                                                               {.output_time_s = recording.time_s,
                                                                .relative_tolerance = relative_tolerance,
                                                                .absolute_tolerance = 1e-3 * relative_tolerance,
                                                                .progress = progress});
  Eigen::VectorXd force_n =
      Eigen::VectorXd::Constant(recording.time_s.size(), std::numeric_limits<double>::quiet_NaN());
  if (result.series.sample_count() > 0)
    force_n.head(result.series.sample_count()) = result.series.column("tendon_force");
  return force_n;
}

IsolatedFit fit_isolated_muscle(const IsolatedModel& start,
                                const std::vector<IsolatedRecording>& recordings,
                                const IsolatedFitOptions& options) {
  const std::vector<std::string>& names = options.parameters;
  const auto p = static_cast<Eigen::Index>(names.size());
  if (p == 0) throw InvalidInput("a fit needs a parameter to identify");
  std::vector<Eigen::Index> lengths;
  Eigen::Index n = 0;
  for (const IsolatedRecording& recording : recordings) {
    if (recording.time_s.size() != recording.force_n.size() || !recording.force_n.allFinite()) {
      throw InvalidInput(fmt::format("{}: {} times for {} forces, all of which must be numbers", recording.name,
                                     recording.time_s.size(), recording.force_n.size()));
    }
    lengths.push_back(recording.force_n.size());
    n += recording.force_n.size();
  }
  if (n <= p) throw InvalidInput(fmt::format("{} samples are too few for {} parameters", n, names.size()));
  IsolatedFit fit{.model = start};
  Eigen::VectorXd logs(p);
  for (Eigen::Index j = 0; j < p; ++j) {
    const std::string& name = names[static_cast<std::size_t>(j)];
    const double value = *field_of(fit.model.parameters, name).value;
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InvalidInput(fmt::format("'{}' is to be identified twice", name));
    if (!(value > 0.0)) {
      throw InvalidInput(fmt::format("{} = {}: a parameter to identify must start above 0", name, value));
    }
    logs[j] = std::log(value);
  }
  const auto residual = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r) {
    const IsolatedModel model = with_values(start, names, x);
    Eigen::Index at = 0;
    for (const IsolatedRecording& recording : recordings) {
      const Eigen::Index count = recording.force_n.size();
      r.segment(at, count) =
          isolated_force(model, recording, options.relative_tolerance, options.progress) - recording.force_n;
      at += count;
      ++fit.evaluations;
    }
  };
  math::LeastSquaresProblem problem;
  problem.residual_count = n;
  problem.lower = logs.array() - std::log(options.reach);
  problem.upper = logs.array() + std::log(options.reach);
  problem.evaluate = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    residual(x, r);
    if (jacobian == nullptr) return;
    // Relative to the derivative: truncation h^2 = 1e-6, the integrator's noise tolerance / h = 1e-4.
    constexpr double kStep = 1e-3;
    Eigen::VectorXd up(n), down(n);
    for (Eigen::Index j = 0; j < p; ++j) {
      Eigen::VectorXd moved = x;
      moved[j] = x[j] + kStep;
      residual(moved, up);
      moved[j] = x[j] - kStep;
      residual(moved, down);
      jacobian->col(j) = (up - down) / (2.0 * kStep);
    }
  };
  const math::LeastSquaresResult found = math::minimize(problem, logs,
                                                        {.max_iterations = 60,
                                                         .initial_radius = 0.3,
                                                         .step_tolerance = 1e-5,
                                                         .cost_tolerance = 1e-6,
                                                         .progress = options.progress});
  fit.termination = found.termination;
  fit.message = found.message;
  fit.model = with_values(start, names, found.x);
  const double effective = std::max(1.0, math::effective_sample_size(found.residual, lengths));
  const double variance = 2.0 * found.cost / static_cast<double>(n - p);
  const Eigen::MatrixXd covariance =
      variance * static_cast<double>(n) / effective *
      (found.jacobian.transpose() * found.jacobian).ldlt().solve(Eigen::MatrixXd::Identity(p, p));
  for (Eigen::Index j = 0; j < p; ++j) {
    const std::string& name = names[static_cast<std::size_t>(j)];
    const double value = std::exp(found.x[j]);
    fit.estimates.push_back({.parameter = name,
                             .unit = field_of(fit.model.parameters, name).unit,
                             .start = std::exp(logs[j]),
                             .value = value,
                             .std_error = value * std::sqrt(std::max(0.0, covariance(j, j))),
                             .at_bound = found.at_bound[static_cast<std::size_t>(j)]});
  }
  return fit;
}

std::vector<DecidedByOne> widen_to_jackknife(IsolatedFit& all, const std::vector<IsolatedFit>& without) {
  constexpr double kFar = 2.0;
  std::vector<DecidedByOne> found;
  if (without.size() < 2) return found;
  const auto n = static_cast<Eigen::Index>(without.size());
  for (std::size_t p = 0; p < all.estimates.size(); ++p) {
    IsolatedEstimate& e = all.estimates[p];
    Eigen::VectorXd x(n);
    for (Eigen::Index i = 0; i < n; ++i) x[i] = without[static_cast<std::size_t>(i)].estimates[p].value;
    Eigen::Index which = 0;
    const double farthest = (x.array() - e.value).abs().maxCoeff(&which);
    if (farthest > kFar * e.std_error)
      found.push_back({.parameter = p,
                       .recording = static_cast<std::size_t>(which),
                       .without = x[which],
                       .std_errors = farthest / std::max(e.std_error, 1e-300)});
    const double jackknife =
        std::sqrt(static_cast<double>(n - 1) / static_cast<double>(n) * (x.array() - x.mean()).square().sum());
    e.std_error = std::max(e.std_error, jackknife);
  }
  return found;
}

}  // namespace myoid::muscle
