#include "myoid/muscle/fit_isolated.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/decompositions.h"
#include "myoid/ground/math/statistics.h"

namespace myoid::muscle {
namespace {

struct Field {
  double* value = nullptr;
  Unit unit = Unit::dimensionless;
};

/// Returns the field of this name; throws InvalidInput with all names if there is none.
Field field_of(IsolatedModel& model, const std::string& wanted) {
  Field found;
  std::string names;
  visit_model(model, [&](std::string_view name, Unit unit, double& field) {
    names += (names.empty() ? "" : ", ") + std::string(name);
    if (name == wanted) found = {&field, unit};
  });
  if (found.value == nullptr) throw InvalidInput(fmt::format("a muscle has no '{}'; there are {}", wanted, names));
  return found;
}

/// Returns the starting value of a parameter: under Millard's curves that of the curve.
double start_of(const IsolatedModel& model, const std::string& name) {
  IsolatedModel copy = model;
  const double value = *field_of(copy, name).value;
  if (name == "eccentric_plateau" && model.laws.velocity == VelocityLaw::millard)
    return model.millard.velocity.max_eccentric_multiplier;
  if (name == "passive_strain" && model.laws.passive == PassiveLaw::millard) return model.millard.passive.strain_at_one;
  return value;
}

Eigen::VectorXd logs_of(const IsolatedModel& model, const std::vector<std::string>& names) {
  Eigen::VectorXd logs(static_cast<Eigen::Index>(names.size()));
  for (std::size_t j = 0; j < names.size(); ++j)
    logs[static_cast<Eigen::Index>(j)] = std::log(start_of(model, names[j]));
  return logs;
}

IsolatedModel with_values(const IsolatedModel& start,
                          const std::vector<std::string>& names,
                          const Eigen::VectorXd& logs) {
  IsolatedModel model = start;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double value = std::exp(logs[static_cast<Eigen::Index>(i)]);
    *field_of(model, names[i]).value = value;
    if (names[i] == "eccentric_plateau" && model.laws.velocity == VelocityLaw::millard)
      model.millard.velocity.max_eccentric_multiplier = value;
    if (names[i] == "passive_strain" && model.laws.passive == PassiveLaw::millard) {
      model.millard.passive.strain_at_one = value;
      model.millard.passive.stiffness_at_one = 2.0 / value;
    }
  }
  HillParameters<double>& hill = model.parameters.hill;
  if (std::ranges::find(names, "force_length_width") == names.end())
    hill.force_length_width_m *= hill.optimal_fiber_length_m / start.parameters.hill.optimal_fiber_length_m;
  return model;
}

/// Returns the force of a unit whose input is given with the model's response.
Eigen::VectorXd force_of(const Musculotendon<double>& unit,
                         const IsolatedMuscleInput& input,
                         const Eigen::VectorXd& time_s,
                         double relative_tolerance,
                         long max_steps) {
  return isolated_tendon_force(unit, input,
                               {.output_time_s = time_s,
                                .relative_tolerance = relative_tolerance,
                                .absolute_tolerance = 1e-3 * relative_tolerance,
                                .max_steps = max_steps,
                                .progress = {}});
}

/// The errors of the forces of all recordings but one, one below the other; then, times `noise_n`, the distances of the
/// common values from the start and of the recordings' own values from the common ones, in their spreads. The unknowns
/// are the logarithms of the common values and, for each recording in turn, those of its own values over them.
class ForceErrors {
 public:
  ForceErrors(const IsolatedModel& start,
              const std::vector<IsolatedRecording>& recordings,
              const IsolatedFitOptions& options)
      : start_(start), recordings_(recordings), options_(options), logs_(logs_of(start, options.parameters)) {
    const double tolerance_m = 5e-5 * start.parameters.hill.optimal_fiber_length_m;
    for (const IsolatedRecording& recording : recordings) {
      inputs_.push_back(thinned(recording.input, tolerance_m));
      samples_.push_back(sparse(recording));
    }
    for (const std::string& name : options.own)
      own_.push_back(std::ranges::find(options.parameters, name) - options.parameters.begin());
    use_all_but({});
  }

  void use_all_but(std::optional<std::size_t> left_out) {
    used_.clear();
    first_.clear();
    lengths_.clear();
    count_ = 0;
    for (std::size_t i = 0; i < recordings_.size(); ++i) {
      if (left_out == i) continue;
      used_.push_back(i);
      first_.push_back(count_);
      lengths_.push_back(samples_[i].force_n.size());
      count_ += lengths_.back();
    }
  }
  /// Sets the weight of the beliefs: the error of a force, and the spreads of the own values; empty: there are none.
  void believe(double noise_n, const Eigen::VectorXd& scatter) {
    noise_n_ = noise_n;
    scatter_ = scatter;
  }

  [[nodiscard]] const std::vector<Eigen::Index>& lengths() const { return lengths_; }
  [[nodiscard]] Eigen::Index count() const { return count_; }         ///< Number of the forces.
  [[nodiscard]] Eigen::Index common() const { return logs_.size(); }  ///< Number of the common unknowns.
  [[nodiscard]] Eigen::Index uses() const { return static_cast<Eigen::Index>(used_.size()); }
  [[nodiscard]] Eigen::Index unknowns() const { return common() + uses() * scatter_.size(); }
  [[nodiscard]] int evaluations() const { return evaluations_; }
  [[nodiscard]] const Eigen::VectorXd& start_logs() const { return logs_; }
  [[nodiscard]] const std::vector<Eigen::Index>& own() const { return own_; }
  /// Returns the spread of the measured forces [N] times the root of their number.
  [[nodiscard]] double spread() const {
    Eigen::VectorXd all(count_);
    for (std::size_t k = 0; k < used_.size(); ++k) all.segment(first_[k], lengths_[k]) = samples_[used_[k]].force_n;
    return (all.array() - all.mean()).matrix().norm();
  }
  /// Returns the logarithms of the values of one of the used recordings.
  [[nodiscard]] Eigen::VectorXd logs_of_use(const Eigen::VectorXd& x, Eigen::Index use) const {
    Eigen::VectorXd logs = x.head(common());
    for (Eigen::Index q = 0; q < scatter_.size(); ++q)
      logs[own_[static_cast<std::size_t>(q)]] += x[common() + use * scatter_.size() + q];
    return logs;
  }

  void evaluate(const Eigen::VectorXd& x, Eigen::VectorXd& r, Eigen::MatrixXd* jacobian) {
    // Central differences. Relative to the derivative: truncation h^2 = 2e-5, the integrator's noise tolerance / h =
    // 2e-5.
    constexpr double kStep = 5e-3;
    // Simulations of each recording: at x, and with each of its values moved up and down. Its own values move as the
    // common ones do.
    const Eigen::Index moves = jacobian == nullptr ? 1 : 1 + 2 * common();
    Eigen::MatrixXd forces(count_, moves);
    parallel_ranges<Eigen::Index>(uses() * moves, 1, [&](const auto& range) {
      for (Eigen::Index k = range.begin(); k != range.end(); ++k) {
        const Eigen::Index use = k % uses();
        Eigen::VectorXd logs = logs_of_use(x, use);
        if (const Eigen::Index move = k / uses(); move > 0) logs[(move - 1) / 2] += move % 2 == 1 ? kStep : -kStep;
        segment(forces, use).col(k / uses()) = force_at(logs, used_[static_cast<std::size_t>(use)]);
      }
    });
    options_.progress.check();
    evaluations_ += static_cast<int>(uses() * moves);
    const double weight = noise_n_ * 1.96 / std::log(options_.reach);
    r.segment(count_, common()) = weight * (x.head(common()) - logs_);
    for (Eigen::Index use = 0; use < uses(); ++use) {
      const auto i = static_cast<std::size_t>(use);
      r.segment(first_[i], lengths_[i]) = segment(forces, use).col(0) - samples_[used_[i]].force_n;
      for (Eigen::Index q = 0; q < scatter_.size(); ++q) {
        const Eigen::Index at = common() + use * scatter_.size() + q;
        r[count_ + at] = noise_n_ / scatter_[q] * x[at];
      }
    }
    if (jacobian == nullptr) return;
    jacobian->setZero();
    jacobian->block(count_, 0, common(), common()).diagonal().setConstant(weight);
    for (Eigen::Index use = 0; use < uses(); ++use) {
      auto block = segment(*jacobian, use);
      for (Eigen::Index j = 0; j < common(); ++j)
        block.col(j) = (segment(forces, use).col(2 * j + 1) - segment(forces, use).col(2 * j + 2)) / (2.0 * kStep);
      for (Eigen::Index q = 0; q < scatter_.size(); ++q) {
        const Eigen::Index at = common() + use * scatter_.size() + q;
        block.col(at) = block.col(own_[static_cast<std::size_t>(q)]);
        (*jacobian)(count_ + at, at) = noise_n_ / scatter_[q];
      }
    }
  }

 private:
  struct Samples {
    Eigen::VectorXd time_s, force_n;
  };
  /// Returns samples of the force at least 2 ms apart, evenly: denser ones cost time and tell nothing more.
  [[nodiscard]] static Samples sparse(const IsolatedRecording& recording) {
    constexpr double kApart_s = 0.002;
    const Eigen::Index n = recording.time_s.size();
    if (n < 2) return {recording.time_s, recording.force_n};
    const double step_s = (recording.time_s[n - 1] - recording.time_s[0]) / static_cast<double>(n - 1);
    const auto stride = std::max<Eigen::Index>(1, std::llround(kApart_s / step_s));
    const auto kept = Eigen::seq(0, n - 1, stride);
    return {recording.time_s(kept), recording.force_n(kept)};
  }
  /// Returns the rows of a used recording.
  [[nodiscard]] Eigen::Block<Eigen::MatrixXd> segment(Eigen::MatrixXd& rows, Eigen::Index use) const {
    const auto i = static_cast<std::size_t>(use);
    return rows.middleRows(first_[i], lengths_[i]);
  }
  /// Returns the forces; NaN for values of which no curve or muscle can be made.
  [[nodiscard]] Eigen::VectorXd force_at(const Eigen::VectorXd& logs, std::size_t recording) const {
    const Eigen::VectorXd& time_s = samples_[recording].time_s;
    try {
      const IsolatedModel model = with_values(start_, options_.parameters, logs);
      IsolatedMuscleInput input = inputs_[recording];
      input.response = model.response;
      // Values at which the equilibrium is stiff, such as a muscle without strength, are no answer: they may fail.
      const long max_steps = 20000 + 10 * input.time_s.size();
      return force_of(Musculotendon<double>(model.parameters, model.laws, model.millard), input, time_s,
                      options_.relative_tolerance, max_steps);
    } catch (const InvalidInput&) {
      if (logs == logs_) throw;
      return Eigen::VectorXd::Constant(time_s.size(), std::numeric_limits<double>::quiet_NaN());
    }
  }

  const IsolatedModel& start_;
  const std::vector<IsolatedRecording>& recordings_;
  const IsolatedFitOptions& options_;
  Eigen::VectorXd logs_;
  std::vector<IsolatedMuscleInput> inputs_;
  std::vector<Samples> samples_;
  std::vector<Eigen::Index> own_;
  std::vector<std::size_t> used_;
  std::vector<Eigen::Index> first_, lengths_;
  Eigen::Index count_ = 0;
  double noise_n_ = 0.0;
  Eigen::VectorXd scatter_;
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
           const std::vector<std::string>& names) {
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
  IsolatedMuscleInput input = recording.input;
  input.response = model.response;
  return force_of(Musculotendon<double>(model.parameters, model.laws, model.millard), input, recording.time_s,
                  relative_tolerance, IsolatedMuscleOptions{}.max_steps);
}

IsolatedFit fit_isolated_muscle(const IsolatedModel& start,
                                const std::vector<IsolatedRecording>& recordings,
                                const IsolatedFitOptions& options) {
  check(start, recordings, options.parameters);
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
  const Eigen::VectorXd common = logs_of(all.model, options.parameters);
  for (std::size_t i = 0; recordings.size() > 1 && i < recordings.size(); ++i) {
    errors.use_all_but(i);
    IsolatedFit fit{.model = start, .noise_n = all.noise_n};
    Eigen::VectorXd x(errors.unknowns());
    x.head(errors.common()) = common;
    Eigen::Index at = errors.common();
    for (std::size_t k = 0; k < recordings.size(); ++k) {
      if (k == i) continue;
      const Eigen::VectorXd logs = logs_of(all.of_recordings[k], options.parameters);
      for (const Eigen::Index j : errors.own()) x[at++] = logs[j] - common[j];
    }
    conclude(start, math::minimize(problem_of(errors, options), x, search_settings(options)), errors, options, fit);
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
