#include "myoid/muscle/fit_isolated.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/statistics.h"

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

/// Returns the starting value of a parameter: under Millard's curves that of the curve.
double start_of(const IsolatedModel& model, const std::string& name) {
  IsolatedModel copy = model;
  const double value = *field_of(copy.parameters, name).value;
  if (name == "eccentric_plateau" && model.laws.velocity == VelocityLaw::millard)
    return model.millard.velocity.max_eccentric_multiplier;
  if (name == "passive_strain" && model.laws.passive == PassiveLaw::millard) return model.millard.passive.strain_at_one;
  return value;
}

IsolatedModel with_values(const IsolatedModel& start,
                          const std::vector<std::string>& names,
                          const Eigen::VectorXd& logs) {
  IsolatedModel model = start;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double value = std::exp(logs[static_cast<Eigen::Index>(i)]);
    *field_of(model.parameters, names[i]).value = value;
    if (names[i] == "eccentric_plateau" && model.laws.velocity == VelocityLaw::millard)
      model.millard.velocity.max_eccentric_multiplier = value;
    if (names[i] == "passive_strain" && model.laws.passive == PassiveLaw::millard) {
      model.millard.passive.strain_at_one = value;
      model.millard.passive.stiffness_at_one = 2.0 / value;
    }
  }
  return model;
}

/// The forces of all recordings, one below the other, and their derivatives.
class ForceErrors {
 public:
  ForceErrors(const IsolatedModel& start,
              const std::vector<IsolatedRecording>& recordings,
              const IsolatedFitOptions& options)
      : start_(start), recordings_(recordings), options_(options) {
    for (const IsolatedRecording& recording : recordings) lengths_.push_back(recording.force_n.size());
  }

  [[nodiscard]] const std::vector<Eigen::Index>& lengths() const { return lengths_; }
  [[nodiscard]] Eigen::Index count() const {
    Eigen::Index n = 0;
    for (const Eigen::Index length : lengths_) n += length;
    return n;
  }
  [[nodiscard]] int evaluations() const { return evaluations_; }
  /// Returns the spread of the measured forces [N] times the root of their number.
  [[nodiscard]] double spread() const {
    Eigen::VectorXd all(count());
    Eigen::Index at = 0;
    for (const IsolatedRecording& recording : recordings_) {
      all.segment(at, recording.force_n.size()) = recording.force_n;
      at += recording.force_n.size();
    }
    return (all.array() - all.mean()).matrix().norm();
  }

  void residual(const Eigen::VectorXd& x, Eigen::VectorXd& r) {
    Eigen::Index at = 0;
    try {
      const IsolatedModel model = with_values(start_, options_.parameters, x);
      for (const IsolatedRecording& recording : recordings_) {
        const Eigen::Index size = recording.force_n.size();
        r.segment(at, size) =
            isolated_force(model, recording, options_.relative_tolerance, options_.progress) - recording.force_n;
        at += size;
        ++evaluations_;
      }
    } catch (const InvalidInput&) {  // values of which no curve or muscle can be made
      if (x == start_logs()) throw;
      r.setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }

  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    residual(x, r);
    if (jacobian == nullptr) return;
    // Relative to the derivative: truncation h^2 = 1e-6, the integrator's noise tolerance / h = 1e-4.
    constexpr double kStep = 1e-3;
    Eigen::VectorXd up(r.size()), down(r.size());
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      Eigen::VectorXd moved = x;
      moved[j] = x[j] + kStep;
      residual(moved, up);
      moved[j] = x[j] - kStep;
      residual(moved, down);
      jacobian->col(j) = (up - down) / (2.0 * kStep);
    }
  }

  [[nodiscard]] Eigen::VectorXd start_logs() const {
    Eigen::VectorXd logs(static_cast<Eigen::Index>(options_.parameters.size()));
    for (std::size_t j = 0; j < options_.parameters.size(); ++j)
      logs[static_cast<Eigen::Index>(j)] = std::log(start_of(start_, options_.parameters[j]));
    return logs;
  }

 private:
  const IsolatedModel& start_;
  const std::vector<IsolatedRecording>& recordings_;
  const IsolatedFitOptions& options_;
  std::vector<Eigen::Index> lengths_;
  int evaluations_ = 0;
};

/// Returns number `index` of Halton's sequence of this base, in 0..1: evenly spread whatever their count.
double halton(int index, int base) {
  double share = 1.0, value = 0.0;
  for (int i = index; i > 0; i /= base) {
    share /= base;
    value += share * (i % base);
  }
  return value;
}

/// Returns the best of points spread over the bounds; empty if no point has a finite cost.
std::optional<Eigen::VectorXd> best_of_points(const math::LeastSquaresProblem& problem, int points) {
  constexpr std::array kBases{2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37};
  std::optional<Eigen::VectorXd> best;
  double least = std::numeric_limits<double>::infinity();
  Eigen::VectorXd r(problem.residual_count);
  for (int i = 1; i <= points; ++i) {
    Eigen::VectorXd x(problem.lower.size());
    for (Eigen::Index j = 0; j < x.size(); ++j) {
      const double share = halton(i, kBases[static_cast<std::size_t>(j) % kBases.size()]);
      x[j] = problem.lower[j] + share * (problem.upper[j] - problem.lower[j]);
    }
    problem.evaluate(x, r, nullptr);
    const double cost = r.squaredNorm();
    if (!std::isfinite(cost) || cost >= least) continue;
    least = cost;
    best = x;
  }
  return best;
}

/// Searches from the start, and from the best of other points; returns the lower minimum.
math::LeastSquaresResult search(const math::LeastSquaresProblem& problem,
                                const Eigen::VectorXd& logs,
                                const IsolatedFitOptions& options,
                                IsolatedFit& fit) {
  const math::LeastSquaresOptions settings{.max_iterations = 60,
                                           .initial_radius = 0.3,
                                           .step_tolerance = 1e-5,
                                           .cost_tolerance = 1e-6,
                                           .progress = options.progress};
  math::LeastSquaresResult found = math::minimize(problem, logs, settings);
  const std::optional<Eigen::VectorXd> other = best_of_points(problem, options.other_starts);
  if (other) {
    try {
      math::LeastSquaresResult elsewhere = math::minimize(problem, *other, settings);
      fit.from_elsewhere = elsewhere.cost < 0.99 * found.cost;
      if (fit.from_elsewhere) found = std::move(elsewhere);
    } catch (const InvalidInput&) {  // no derivative there: that point is no start
    }
  }
  fit.moved = (found.x - logs).cwiseAbs().maxCoeff() > 1e-9;
  return found;
}

/// Returns the standard errors of the logarithms, infinite where the forces do not tell a parameter.
Eigen::VectorXd log_errors(const math::LeastSquaresResult& found,
                           const ForceErrors& errors,
                           const IsolatedFitOptions& options) {
  const Eigen::Index p = found.x.size();
  const auto n = static_cast<double>(errors.count());
  const double effective = std::max(1.0, math::effective_sample_size(found.residual, errors.lengths()));
  const double variance = 2.0 * found.cost / (n - static_cast<double>(p)) * n / effective;
  // An effect below a thousandth of the forces' spread, over the whole reach, is that of the integration's tolerance.
  const double least_effect = 1e-3 * errors.spread() / std::log(options.reach);
  const math::SymmetricEigen squares = math::symmetric_eigen(found.jacobian.transpose() * found.jacobian);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(p);
  for (Eigen::Index k = 0; k < p; ++k) {
    const double effect = std::sqrt(std::max(0.0, squares.values[k]));
    for (Eigen::Index j = 0; j < p; ++j) {
      const double part = squares.vectors(j, k) * squares.vectors(j, k);
      if (effect > least_effect)
        square[j] += part * variance / (effect * effect);
      else if (part > 1e-6)
        square[j] = std::numeric_limits<double>::infinity();
    }
  }
  return square.cwiseSqrt();
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
  for (const IsolatedRecording& recording : recordings) {
    if (recording.time_s.size() != recording.force_n.size() || !recording.force_n.allFinite()) {
      throw InvalidInput(fmt::format("{}: {} times for {} forces, all of which must be numbers", recording.name,
                                     recording.time_s.size(), recording.force_n.size()));
    }
  }
  ForceErrors errors(start, recordings, options);
  const Eigen::Index n = errors.count();
  if (n <= p) throw InvalidInput(fmt::format("{} samples are too few for {} parameters", n, names.size()));
  for (const std::string& name : names) {
    const double value = start_of(start, name);
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InvalidInput(fmt::format("'{}' is to be identified twice", name));
    if (!(value > 0.0)) {
      throw InvalidInput(fmt::format("{} = {}: a parameter to identify must start above 0", name, value));
    }
  }
  const Eigen::VectorXd logs = errors.start_logs();
  math::LeastSquaresProblem problem;
  problem.residual_count = n;
  problem.lower = logs.array() - std::log(options.reach);
  problem.upper = logs.array() + std::log(options.reach);
  problem.evaluate = [&](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    errors.evaluate(x, r, jacobian);
  };
  IsolatedFit fit{.model = start};
  const math::LeastSquaresResult found = search(problem, logs, options, fit);
  fit.termination = found.termination;
  fit.message = found.message;
  fit.evaluations = errors.evaluations();
  fit.model = with_values(start, names, found.x);
  const Eigen::VectorXd sd = log_errors(found, errors, options);
  for (Eigen::Index j = 0; j < p; ++j) {
    const std::string& name = names[static_cast<std::size_t>(j)];
    const double value = std::exp(found.x[j]);
    fit.estimates.push_back({.parameter = name,
                             .unit = field_of(fit.model.parameters, name).unit,
                             .start = std::exp(logs[j]),
                             .value = value,
                             .std_error = value * sd[j],
                             .at_bound = found.at_bound[static_cast<std::size_t>(j)],
                             .told = std::isfinite(sd[j])});
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
    if (!e.told) continue;
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
