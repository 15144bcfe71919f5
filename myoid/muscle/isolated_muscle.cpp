#include "myoid/muscle/isolated_muscle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/runge_kutta.h"
#include "myoid/ground/math/shape_preserving_curve.h"
#include "myoid/ground/math/stiff_ode.h"

namespace myoid::muscle {
namespace {

using math::OdeStatus;

/// The drive: linear between samples, or, of nothing but 0 and 1, switched at them; constant outside.
class Drive {
 public:
  Drive(const Eigen::VectorXd& time_s, const Eigen::VectorXd& values) : time_(time_s), value_(values) {
    const Eigen::Index n = value_.size();
    if (n == 0 || (time_.size() != n && !(time_.size() == 0 && n == 1))) {
      throw InvalidInput(
          fmt::format("the drive of a muscle: {} times and {} values; expected as many of each, or one value alone",
                      time_.size(), n));
    }
    for (Eigen::Index k = 0; k < n; ++k) {
      if (!(value_(k) >= 0.0 && value_(k) <= 1.0)) {
        throw InvalidInput(fmt::format("the drive of a muscle is {} at sample {}, expected 0 to 1", value_(k), k + 1));
      }
      if (k > 0 && !(time_(k) > time_(k - 1))) {
        throw InvalidInput(
            fmt::format("the drive of a muscle: time {} s follows {} s, expected strictly increasing times", time_(k),
                        time_(k - 1)));
      }
    }
    if (n > 1 && ((value_.array() == 0.0) || (value_.array() == 1.0)).all()) switch_at_samples();
  }

  /// Delays the drive; before its delayed begin, at `begin_s` + `delay_s`, it is `before`.
  void delay(double delay_s, double begin_s, double before) {
    if (delay_s == 0.0) return;
    time_.array() += delay_s;
    begin_ = begin_s + delay_s;
    before_ = before;
  }

  [[nodiscard]] double at(double t) const {
    if (t < begin_) return before_;
    const Eigen::Index n = value_.size();
    if (n == 1 || t <= time_(0)) return value_(0);
    if (t >= time_(n - 1)) return value_(n - 1);
    const Eigen::Index k = std::upper_bound(time_.data(), time_.data() + n, t) - time_.data() - 1;
    const double share = (t - time_(k)) / (time_(k + 1) - time_(k));
    return value_(k) + share * (value_(k + 1) - value_(k));
  }
  /// Returns the times at which the drive bends.
  [[nodiscard]] std::vector<double> corners() const {
    std::vector<double> times;
    if (std::isfinite(begin_)) times.push_back(begin_);
    for (Eigen::Index k = 0; k < time_.size(); ++k) {
      const bool inside = k > 0 && k + 1 < time_.size();
      if (inside && value_(k) == value_(k - 1) && value_(k) == value_(k + 1)) continue;
      times.push_back(time_(k));
    }
    return times;
  }

 private:
  /// Makes each change a ramp that ends at its sample, too short to matter.
  void switch_at_samples() {
    constexpr double kRamp_s = 1e-6;
    std::vector<double> times{time_(0)}, values{value_(0)};
    for (Eigen::Index k = 1; k < time_.size(); ++k) {
      if (value_(k) == value_(k - 1)) continue;
      times.insert(times.end(), {std::max(0.5 * (time_(k - 1) + time_(k)), time_(k) - kRamp_s), time_(k)});
      values.insert(values.end(), {value_(k - 1), value_(k)});
    }
    time_ = Eigen::Map<Eigen::VectorXd>(times.data(), static_cast<Eigen::Index>(times.size()));
    value_ = Eigen::Map<Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
  }

  Eigen::VectorXd time_, value_;
  double begin_ = -std::numeric_limits<double>::infinity(), before_ = 0.0;
};

/// States: first of the activation (0 to 2), then of the unit (0 to 2).
class Experiment {
 public:
  Experiment(const Musculotendon<double>& unit, const IsolatedMuscleInput& input)
      : unit_(unit),
        response_(input.response),
        length_(input.time_s, input.length_m, "the imposed length"),
        drive_(input.drive_time_s, input.drive) {
    if (input.drive_is_excitation) {
      const double begin_s = input.time_s(0);
      drive_.delay(response_.delay_s, begin_s, input.initial_activation.value_or(drive_.at(begin_s)));
    } else {
      response_.activation.law = ActivationLaw::envelope;
      response_.calcium.reset();
    }
    validate(response_);
    activation_states_ = state_size(response_.activation.law);
    unit_states_ = state_size(unit_.laws().mode);
  }

  [[nodiscard]] const Drive& drive() const { return drive_; }
  [[nodiscard]] bool stiff() const { return unit_.laws().mode == TendonMode::mass; }

  [[nodiscard]] ActivationPoint<double> activation(double t, const double* y) const {
    switch (activation_states_) {
      case 1:
        return {0.0, y[0]};
      case 2:
        return {y[0], y[1]};
      default:
        return {drive_.at(t), drive_.at(t)};
    }
  }
  /// Returns the unit's input; the fiber's length acts on the active state where calcium binds.
  [[nodiscard]] MusculotendonInput<double> input(double t, double state, double fiber_length_m) const {
    const auto point = length_.at(t);
    if (!response_.calcium) return {state, point.value, point.slope};
    const double l = fiber_length_m / unit_.parameters().hill.optimal_fiber_length_m;
    return {active_state(*response_.calcium, state, l), point.value, point.slope};
  }
  [[nodiscard]] MusculotendonState<double> fiber(const double* y) const {
    const double* own = y + activation_states_;
    return {unit_states_ > 0 ? own[0] : 0.0, unit_states_ > 1 ? own[1] : 0.0};
  }

  [[nodiscard]] std::vector<double> start(double t, std::optional<double> initial) const {
    const double first = drive_.at(t);
    const double a = activation_states_ > 0 ? initial.value_or(first) : first;
    std::vector<double> y(static_cast<std::size_t>(activation_states_), a);
    auto fiber = equilibrium_state(unit_, input(t, a, unit_.parameters().hill.optimal_fiber_length_m));
    // Active state and length of a fiber at rest act on each other; each round leaves some percent of the last one's.
    for (int round = 0; response_.calcium && round < 10; ++round)
      fiber = equilibrium_state(unit_, input(t, a, fiber.fiber_length_m));
    if (unit_states_ > 0) y.push_back(fiber.fiber_length_m);
    if (unit_states_ > 1) y.push_back(fiber.fiber_velocity_mps);
    return y;
  }

  void rate(double t, const double* y, double* ydot) const {
    const ActivationPoint<double> a = activation(t, y);
    if (activation_states_ > 0) {
      const auto r = activation_rate(response_.activation, drive_.at(t), a);
      if (activation_states_ == 2) *ydot++ = r.filtered_excitation;
      *ydot++ = r.activation;
    }
    if (unit_states_ > 0) {
      const MusculotendonState<double> now = fiber(y);
      const auto r = musculotendon_rate(unit_, input(t, a.activation, now.fiber_length_m), now);
      *ydot++ = r.fiber_length_rate_mps;
      if (unit_states_ > 1) *ydot = r.fiber_velocity_rate_mps2;
    }
  }

  [[nodiscard]] Eigen::RowVectorXd row(double t, const double* y) const {
    const MusculotendonState<double> now = fiber(y);
    const MusculotendonInput<double> in = input(t, activation(t, y).activation, now.fiber_length_m);
    const MusculotendonOutput<double> o = musculotendon_output(unit_, in, now);
    Eigen::RowVectorXd row(11);
    row << in.activation, in.length_m, in.velocity_mps, o.fiber_length_m, o.fiber_velocity_mps,
        std::acos(std::min(1.0, o.cos_pennation)), o.tendon_length_m, o.active_force_n,
        o.passive_force_n + o.viscous_force_n, o.fiber_force_n, o.tendon_force_n;
    return row;
  }

  [[nodiscard]] double tendon_force_n(double t, const double* y) const {
    const MusculotendonState<double> now = fiber(y);
    return muscle::tendon_force_n(unit_, input(t, activation(t, y).activation, now.fiber_length_m), now);
  }

 private:
  const Musculotendon<double>& unit_;
  ExcitationResponse response_;
  math::ShapePreservingCurve length_;
  Drive drive_;
  int activation_states_ = 0;
  int unit_states_ = 0;
};

std::vector<Channel> channels() {
  return {{"activation", Unit::dimensionless},
          {"musculotendon_length", Unit::meter},
          {"musculotendon_velocity", Unit::meter_per_second},
          {"fiber_length", Unit::meter},
          {"fiber_velocity", Unit::meter_per_second},
          {"pennation", Unit::radian},
          {"tendon_length", Unit::meter},
          {"active_fiber_force", Unit::newton},
          {"passive_fiber_force", Unit::newton},
          {"fiber_force", Unit::newton},
          {"tendon_force", Unit::newton}};
}

Eigen::VectorXd checked_outputs(const Eigen::VectorXd& wanted, const Eigen::VectorXd& samples) {
  if (wanted.size() == 0) return samples;
  const double begin = samples(0);
  const double end = samples(samples.size() - 1);
  for (Eigen::Index k = 0; k < wanted.size(); ++k) {
    if (!(wanted(k) >= begin && wanted(k) <= end) || (k > 0 && !(wanted(k) > wanted(k - 1)))) {
      throw InvalidInput(
          fmt::format("output time {} s: expected strictly increasing times from {} to {} s, where the length is known",
                      wanted(k), begin, end));
    }
  }
  return wanted;
}

struct Integration {
  OdeStatus status = OdeStatus::done;
  math::OdeStatistics statistics;
  Eigen::Index done = 0;  ///< Number of outputs.
};

/// Integrates the experiment and calls output(k, t, y) at each of the times, in order, as far as the integration gets.
template <typename Output>
Integration integrate(const Experiment& experiment,
                      const IsolatedMuscleInput& input,
                      const Eigen::VectorXd& times,
                      const IsolatedMuscleOptions& options,
                      const Output& output) {
  const double begin = input.time_s(0);
  const double end = times(times.size() - 1);
  if (input.initial_activation && !(*input.initial_activation >= 0.0 && *input.initial_activation <= 1.0)) {
    throw InvalidInput(fmt::format("the initial activation is {}, expected 0 to 1", *input.initial_activation));
  }
  Integration result;
  const std::vector<double> y0 = experiment.start(begin, input.initial_activation);
  Eigen::Index& done = result.done;
  if (y0.empty()) {
    for (; done < times.size(); ++done) output(done, times(done), nullptr);
    return result;
  }
  // Steps end at corners of length and drive, so that functions are smooth within a step.
  std::vector<double> corners = experiment.drive().corners();
  corners.insert(corners.end(), input.time_s.data(), input.time_s.data() + input.time_s.size());
  std::sort(corners.begin(), corners.end());
  auto corner = std::upper_bound(corners.begin(), corners.end(), begin);

  math::OdeOptions ode;
  ode.relative_tolerance = options.relative_tolerance;
  ode.absolute_tolerance = options.absolute_tolerance;
  ode.max_steps = options.max_steps;
  std::vector<double> y = y0;
  for (; done < times.size() && times(done) <= begin; ++done) output(done, times(done), y0.data());
  const auto run = [&](auto& stepper, const auto&... rate) {
    while (result.status == OdeStatus::done && done < times.size()) {
      options.progress.check();
      const double limit = corner == corners.end() ? end : std::min(*corner, end);
      result.status = stepper.step(limit, rate...);
      if (result.status != OdeStatus::done) break;
      while (corner != corners.end() && stepper.time_s() >= *corner) ++corner;
      for (; done < times.size() && times(done) <= stepper.time_s(); ++done) {
        stepper.interpolate(times(done), y);
        output(done, times(done), y.data());
      }
      options.progress.tell((stepper.time_s() - begin) / (end - begin), "simulating the muscle");
    }
    result.statistics = stepper.statistics();
  };
  const auto rate = [&](double t, const double* state, double* ydot) { experiment.rate(t, state, ydot); };
  if (experiment.stiff()) {
    math::StiffProblem problem;
    problem.state_count = y0.size();
    problem.rate = [&](double t, const double* state, double* ydot) {
      rate(t, state, ydot);
      return true;
    };
    math::StiffIntegrator stepper(std::move(problem), ode);
    result.status = stepper.start(begin, y0);
    run(stepper);
  } else {
    math::RungeKutta<double> stepper(y0.size(), ode);
    result.status = stepper.start(begin, y0, rate);
    run(stepper, rate);
  }
  return result;
}

}  // namespace

IsolatedMuscleResult simulate_isolated_muscle(const Musculotendon<double>& unit,
                                              const IsolatedMuscleInput& input,
                                              const IsolatedMuscleOptions& options) {
  const Experiment experiment(unit, input);
  const Eigen::VectorXd times = checked_outputs(options.output_time_s, input.time_s);
  Eigen::MatrixXd rows(times.size(), static_cast<Eigen::Index>(channels().size()));
  const Integration found =
      integrate(experiment, input, times, options,
                [&](Eigen::Index k, double t, const double* y) { rows.row(k) = experiment.row(t, y); });
  return {.status = found.status,
          .message = std::string(math::explain(found.status)),
          .statistics = found.statistics,
          .series = TimeSeries(times.head(found.done), channels(), rows.topRows(found.done))};
}

Eigen::VectorXd isolated_tendon_force(const Musculotendon<double>& unit,
                                      const IsolatedMuscleInput& input,
                                      const IsolatedMuscleOptions& options) {
  const Experiment experiment(unit, input);
  const Eigen::VectorXd times = checked_outputs(options.output_time_s, input.time_s);
  Eigen::VectorXd force_n = Eigen::VectorXd::Constant(times.size(), std::numeric_limits<double>::quiet_NaN());
  integrate(experiment, input, times, options,
            [&](Eigen::Index k, double t, const double* y) { force_n[k] = experiment.tendon_force_n(t, y); });
  return force_n;
}

IsolatedMuscleInput thinned(const IsolatedMuscleInput& input, double tolerance_m) {
  const Eigen::Index n = input.time_s.size();
  std::vector<Eigen::Index> kept{0, n - 1};
  IsolatedMuscleInput thin = input;
  // Each round adds the worst sample of every interval that misses one.
  while (true) {
    thin.time_s = input.time_s(kept);
    thin.length_m = input.length_m(kept);
    const math::ShapePreservingCurve curve(thin.time_s, thin.length_m, "the imposed length");
    std::vector<Eigen::Index> next{0};
    for (std::size_t i = 0; i + 1 < kept.size(); ++i) {
      double worst = tolerance_m;
      Eigen::Index at = kept[i];
      for (Eigen::Index k = kept[i] + 1; k < kept[i + 1]; ++k) {
        const double miss = std::abs(curve.at(input.time_s[k]).value - input.length_m[k]);
        if (miss <= worst) continue;
        worst = miss;
        at = k;
      }
      if (at != kept[i]) next.push_back(at);
      next.push_back(kept[i + 1]);
    }
    if (next.size() == kept.size()) return thin;
    kept = std::move(next);
  }
}

}  // namespace myoid::muscle
