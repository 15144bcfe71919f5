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
#include "myoid/muscle/force_errors.h"
#include "myoid/muscle/isolated_values.h"

namespace myoid::muscle {
namespace {

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

/// Scatter of the recordings' own values before the first fit shows it, and number of fits that show it.
constexpr double kFirstScatter = 0.2;
constexpr int kScatterRounds = 4;

math::LeastSquaresOptions search_settings(const IsolatedFitOptions& options) {
  return {.max_iterations = 60,
          .initial_radius = 0.3,
          .step_tolerance = 1e-5,
          .cost_tolerance = 1e-6,
          .progress = options.progress};
}

/// Searches from the start, and from the best of other points; returns the lower minimum.
math::LeastSquaresResult search(const math::LeastSquaresProblem& problem,
                                const Eigen::VectorXd& logs,
                                const IsolatedFitOptions& options,
                                IsolatedFit& fit) {
  const math::LeastSquaresOptions settings = search_settings(options);
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

/// Returns the error of one force [N] if the residuals were as many independent ones as they are effective.
double noise_of(const math::LeastSquaresResult& found, const ForceErrors& errors) {
  const Eigen::VectorXd forces = found.residual.head(errors.count());
  const auto n = static_cast<double>(errors.count());
  const auto p = static_cast<double>(found.x.size());
  const double effective = std::max(1.0, math::effective_sample_size(forces, errors.lengths()));
  return std::sqrt(forces.squaredNorm() / (n - p) * n / effective);
}

/// Returns J'J of the forces for the common unknowns, with the recordings' own values free within their beliefs.
Eigen::MatrixXd common_squares(const math::LeastSquaresResult& found, const ForceErrors& errors) {
  const Eigen::Index p = errors.common(), own = found.x.size() - p;
  Eigen::MatrixXd rows = found.jacobian;
  rows.block(errors.count(), 0, p, p).setZero();
  const Eigen::MatrixXd squares = rows.transpose() * rows;
  if (own == 0) return squares;
  const Eigen::MatrixXd across = squares.topRightCorner(p, own);
  return squares.topLeftCorner(p, p) -
         across * math::pseudo_inverse(squares.bottomRightCorner(own, own)) * across.transpose();
}

/// Returns the standard errors of the logarithms, infinite where the forces do not tell a parameter.
Eigen::VectorXd log_errors(const math::LeastSquaresResult& found,
                           const ForceErrors& errors,
                           const IsolatedFitOptions& options,
                           double noise_n) {
  const Eigen::Index p = errors.common();
  // An effect below a thousandth of the forces' spread, over the whole reach, is that of the integration's tolerance.
  const double least_effect = 1e-3 * errors.spread() / std::log(options.reach);
  const auto forces = found.jacobian.topLeftCorner(errors.count(), p);
  const math::SymmetricEigen effects = math::symmetric_eigen(forces.transpose() * forces);
  const Eigen::Index untold = (effects.values.array() <= least_effect * least_effect).count();
  if (untold == p) return Eigen::VectorXd::Constant(p, std::numeric_limits<double>::infinity());
  const auto told = effects.vectors.rightCols(p - untold);
  const Eigen::MatrixXd inverse = math::pseudo_inverse(told.transpose() * common_squares(found, errors) * told);
  Eigen::VectorXd errors_of_logs = noise_n * (told * inverse * told.transpose()).diagonal().cwiseSqrt();
  for (Eigen::Index j = 0; j < p; ++j) {
    if (effects.vectors.row(j).head(untold).squaredNorm() > 1e-6)
      errors_of_logs[j] = std::numeric_limits<double>::infinity();
  }
  return errors_of_logs;
}

/// Throws InvalidInput unless the parameters can be fitted to the recordings.
void check(const IsolatedModel& start,
           const std::vector<IsolatedRecording>& recordings,
           const std::vector<std::string>& names,
           const std::vector<std::string>& own) {
  if (names.empty()) throw InvalidInput("a fit needs a parameter to identify");
  std::size_t n = 0;
  for (const IsolatedRecording& recording : recordings) {
    if (recording.time_s.size() != recording.force_n.size() || !recording.force_n.allFinite()) {
      throw InvalidInput(fmt::format("{}: {} times for {} forces, all of which must be numbers", recording.name,
                                     recording.time_s.size(), recording.force_n.size()));
    }
    n += static_cast<std::size_t>(recording.force_n.size());
  }
  if (n <= names.size()) throw InvalidInput(fmt::format("{} samples are too few for {} parameters", n, names.size()));
  for (const std::string& name : own) {
    if (std::ranges::find(names, name) == names.end())
      throw InvalidInput("'{}' shall have an own value in each recording, and is not identified", name);
  }
  for (const std::string& name : names) {
    const double value = start_of(start, name);
    if (std::ranges::count(names, name) > 1) throw InvalidInput(fmt::format("'{}' is to be identified twice", name));
    if (!(value > 0.0)) {
      throw InvalidInput(fmt::format("{} = {}: a parameter to identify must start above 0", name, value));
    }
  }
}

/// Returns the problem of least squares within the reach.
math::LeastSquaresProblem problem_of(ForceErrors& errors, const IsolatedFitOptions& options) {
  const double reach = std::log(options.reach);
  math::LeastSquaresProblem problem;
  problem.residual_count = errors.count() + errors.unknowns();
  problem.lower = Eigen::VectorXd::Constant(errors.unknowns(), -reach);
  problem.upper = -problem.lower;
  problem.lower.head(errors.common()) += errors.start_logs();
  problem.upper.head(errors.common()) += errors.start_logs();
  problem.evaluate = [&errors](const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    errors.evaluate(x, r, jacobian);
  };
  return problem;
}

/// Returns the spreads of the recordings' own values: of the values that the search found, and of their errors.
Eigen::VectorXd scatter_of(const math::LeastSquaresResult& found, const ForceErrors& errors, double noise_n) {
  const auto q = static_cast<Eigen::Index>(errors.own().size());
  const Eigen::MatrixXd inverse = math::pseudo_inverse(found.jacobian.transpose() * found.jacobian);
  Eigen::VectorXd square = Eigen::VectorXd::Zero(q);
  for (Eigen::Index at = errors.common(); at < found.x.size(); ++at)
    square[(at - errors.common()) % q] += found.x[at] * found.x[at] + noise_n * noise_n * inverse(at, at);
  return (square / static_cast<double>(errors.uses())).cwiseSqrt().cwiseMax(1e-3);
}

/// Fills the fit from the end of its search.
void conclude(const IsolatedModel& start,
              const math::LeastSquaresResult& found,
              const ForceErrors& errors,
              const IsolatedFitOptions& options,
              IsolatedFit& fit) {
  fit.termination = found.termination;
  fit.message = found.message;
  fit.model = with_values(start, options.parameters, found.x.head(errors.common()));
  for (Eigen::Index use = 0; use < errors.uses(); ++use)
    fit.of_recordings.push_back(with_values(start, options.parameters, errors.logs_of_use(found.x, use)));
  const Eigen::VectorXd sd = log_errors(found, errors, options, fit.noise_n);
  for (Eigen::Index j = 0; j < errors.common(); ++j) {
    const std::string& name = options.parameters[static_cast<std::size_t>(j)];
    const double value = std::exp(found.x[j]);
    fit.estimates.push_back({.parameter = name,
                             .unit = field_of(fit.model, name).unit,
                             .start = std::exp(errors.start_logs()[j]),
                             .value = value,
                             .std_error = value * sd[j],
                             .at_bound = found.at_bound[static_cast<std::size_t>(j)],
                             .told = std::isfinite(sd[j])});
  }
}

}  // namespace

Eigen::VectorXd isolated_force(const IsolatedModel& model,
                               const IsolatedRecording& recording,
                               double relative_tolerance) {
  return force_of(model, recording.input, recording.time_s, relative_tolerance, IsolatedMuscleOptions{}.max_steps);
}

IsolatedFit fit_isolated_muscle(const IsolatedModel& start,
                                const std::vector<IsolatedRecording>& recordings,
                                const IsolatedFitOptions& options) {
  check(start, recordings, options.parameters, options.own);
  ForceErrors errors(start, recordings, options);
  const math::LeastSquaresProblem problem = problem_of(errors, options);
  IsolatedFit fit{.model = start};
  math::LeastSquaresResult found = search(problem, errors.start_logs(), options, fit);
  fit.noise_n = noise_of(found, errors);
  Eigen::VectorXd scatter = Eigen::VectorXd::Constant(static_cast<Eigen::Index>(options.own.size()), kFirstScatter);
  // The noise and the scatter that a fit shows are those of the next; without own values one more fit suffices.
  for (int round = 0; round < (options.own.empty() ? 1 : kScatterRounds); ++round) {
    errors.believe(fit.noise_n, scatter);
    Eigen::VectorXd x = Eigen::VectorXd::Zero(errors.unknowns());
    x.head(found.x.size()) = found.x;
    found = math::minimize(problem_of(errors, options), x, search_settings(options));
    if (options.own.empty()) continue;
    scatter = scatter_of(found, errors, fit.noise_n);
    fit.noise_n = noise_of(found, errors);
  }
  conclude(start, found, errors, options, fit);
  for (std::size_t q = 0; q < options.own.size(); ++q)
    fit.estimates[static_cast<std::size_t>(errors.own()[q])].scatter = scatter[static_cast<Eigen::Index>(q)];
  fit.evaluations = errors.evaluations();
  return fit;
}

namespace {

/// Returns the unknowns of the fit of all recordings but `left_out`.
Eigen::VectorXd unknowns_of(const IsolatedFit& all,
                            const std::vector<std::string>& names,
                            const ForceErrors& errors,
                            std::optional<std::size_t> left_out) {
  Eigen::VectorXd x(errors.unknowns());
  const Eigen::VectorXd common = logs_of(all.model, names);
  x.head(errors.common()) = common;
  Eigen::Index at = errors.common();
  for (std::size_t k = 0; k < all.of_recordings.size(); ++k) {
    if (k == left_out) continue;
    const Eigen::VectorXd logs = logs_of(all.of_recordings[k], names);
    for (const Eigen::Index j : errors.own()) x[at++] = logs[j] - common[j];
  }
  return x;
}

}  // namespace

std::vector<IsolatedFit> fit_without_each(const IsolatedModel& start,
                                          const std::vector<IsolatedRecording>& recordings,
                                          const IsolatedFitOptions& options,
                                          const IsolatedFit& all) {
  std::vector<IsolatedFit> fits;
  ForceErrors errors(start, recordings, options);
  Eigen::VectorXd scatter(static_cast<Eigen::Index>(options.own.size()));
  for (std::size_t q = 0; q < options.own.size(); ++q)
    scatter[static_cast<Eigen::Index>(q)] = all.estimates[static_cast<std::size_t>(errors.own()[q])].scatter;
  errors.believe(all.noise_n, scatter);
  if (recordings.size() < 2) return fits;
  // Most recordings move the answer so little that the slopes of the fit to all serve.
  constexpr double kNear = 0.05;
  const Eigen::VectorXd at_all = unknowns_of(all, options.parameters, errors, {});
  const math::LeastSquaresOptions settings = search_settings(options);
  errors.hold_slopes(at_all);
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    errors.use_all_but(i);
    errors.use_held_slopes(true);
    IsolatedFit fit{.model = start, .noise_n = all.noise_n};
    const Eigen::VectorXd x = unknowns_of(all, options.parameters, errors, i);
    math::LeastSquaresResult found = math::minimize(problem_of(errors, options), x, settings);
    if (found.termination != math::Termination::converged || (found.x - x).cwiseAbs().maxCoeff() > kNear) {
      errors.use_held_slopes(false);
      found = math::minimize(problem_of(errors, options), found.x, settings);
    }
    conclude(start, found, errors, options, fit);
    fits.push_back(std::move(fit));
  }
  return fits;
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
