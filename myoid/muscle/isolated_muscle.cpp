#include "myoid/muscle/isolated_muscle.h"

#include <algorithm>
#include <cmath>
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

/// The drive: linear between samples, constant outside.
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
  }

  [[nodiscard]] double at(double t) const {
    const Eigen::Index n = value_.size();
    if (n == 1 || t <= time_(0)) return value_(0);
    if (t >= time_(n - 1)) return value_(n - 1);
    const Eigen::Index k = std::upper_bound(time_.data(), time_.data() + n, t) - time_.data() - 1;
    const double share = (t - time_(k)) / (time_(k + 1) - time_(k));
    return value_(k) + share * (value_(k + 1) - value_(k));
  }
  [[nodiscard]] const Eigen::VectorXd& time_s() const { return time_; }

 private:
  Eigen::VectorXd time_, value_;
};

/// States: first of the activation (0 to 2), then of the unit (0 to 2).
class Experiment {
 public:
  Experiment(const Musculotendon<double>& unit, const IsolatedMuscleInput& input)
      : unit_(unit),
        dynamics_(input.dynamics),
        length_(input.time_s, input.length_m, "the imposed length"),
        drive_(input.drive_time_s, input.drive) {
    if (!input.drive_is_excitation) dynamics_.law = ActivationLaw::envelope;
    validate(dynamics_);
    activation_states_ = state_size(dynamics_.law);
    unit_states_ = state_size(unit_.laws().mode);
  }

  [[nodiscard]] std::size_t state_count() const { return static_cast<std::size_t>(activation_states_ + unit_states_); }
  [[nodiscard]] const Drive& drive() const { return drive_; }

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
  [[nodiscard]] MusculotendonInput<double> input(double t, double activation) const {
    const auto point = length_.at(t);
    return {activation, point.value, point.slope};
  }
  [[nodiscard]] MusculotendonState<double> fiber(const double* y) const {
    const double* own = y + activation_states_;
    return {unit_states_ > 0 ? own[0] : 0.0, unit_states_ > 1 ? own[1] : 0.0};
  }

  [[nodiscard]] std::vector<double> start(double t, std::optional<double> initial) const {
    const double first = drive_.at(t);
    const double a = activation_states_ > 0 ? initial.value_or(first) : first;
    std::vector<double> y(static_cast<std::size_t>(activation_states_), a);
    const auto fiber = equilibrium_state(unit_, input(t, a));
    if (unit_states_ > 0) y.push_back(fiber.fiber_length_m);
    if (unit_states_ > 1) y.push_back(fiber.fiber_velocity_mps);
    return y;
  }

  void rate(double t, const double* y, double* ydot) const {
    const ActivationPoint<double> a = activation(t, y);
    if (activation_states_ > 0) {
      const auto r = activation_rate(dynamics_, drive_.at(t), a);
      if (activation_states_ == 2) *ydot++ = r.filtered_excitation;
      *ydot++ = r.activation;
    }
    if (unit_states_ > 0) {
      const auto r = musculotendon_rate(unit_, input(t, a.activation), fiber(y));
      *ydot++ = r.fiber_length_rate_mps;
      if (unit_states_ > 1) *ydot = r.fiber_velocity_rate_mps2;
    }
  }

  [[nodiscard]] Eigen::RowVectorXd row(double t, const double* y) const {
    const double a = activation(t, y).activation;
    const MusculotendonInput<double> in = input(t, a);
    const MusculotendonOutput<double> o = musculotendon_output(unit_, in, fiber(y));
    Eigen::RowVectorXd row(11);
    row << a, in.length_m, in.velocity_mps, o.fiber_length_m, o.fiber_velocity_mps,
        std::acos(std::min(1.0, o.cos_pennation)), o.tendon_length_m, o.active_force_n,
        o.passive_force_n + o.viscous_force_n, o.fiber_force_n, o.tendon_force_n;
    return row;
  }

 private:
  const Musculotendon<double>& unit_;
  ActivationDynamics<double> dynamics_;
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

}  // namespace

IsolatedMuscleResult simulate_isolated_muscle(const Musculotendon<double>& unit,
                                              const IsolatedMuscleInput& input,
                                              const IsolatedMuscleOptions& options) {
  const Experiment experiment(unit, input);
  const Eigen::VectorXd times = checked_outputs(options.output_time_s, input.time_s);
  const double begin = input.time_s(0);
  const double end = times(times.size() - 1);
  if (input.initial_activation && !(*input.initial_activation >= 0.0 && *input.initial_activation <= 1.0)) {
    throw InvalidInput(fmt::format("the initial activation is {}, expected 0 to 1", *input.initial_activation));
  }

  IsolatedMuscleResult result;
  Eigen::MatrixXd rows(times.size(), static_cast<Eigen::Index>(channels().size()));
  Eigen::Index done = 0;
  const std::vector<double> y0 = experiment.start(begin, input.initial_activation);

  if (y0.empty()) {
    for (; done < times.size(); ++done) rows.row(done) = experiment.row(times(done), nullptr);
  } else {
    // Steps end at corners of length and drive, so that functions are smooth within a step.
    std::vector<double> corners(input.time_s.data(), input.time_s.data() + input.time_s.size());
    const Eigen::VectorXd& drive = experiment.drive().time_s();
    corners.insert(corners.end(), drive.data(), drive.data() + drive.size());
    std::sort(corners.begin(), corners.end());
    auto corner = std::upper_bound(corners.begin(), corners.end(), begin);

    math::OdeOptions ode;
    ode.relative_tolerance = options.relative_tolerance;
    ode.absolute_tolerance = options.absolute_tolerance;
    std::vector<double> y = y0;
    while (done < times.size() && times(done) <= begin) {
      rows.row(done) = experiment.row(times(done), y0.data());
      ++done;
    }
    const auto run = [&](auto& stepper, const auto&... rate) {
      while (result.status == OdeStatus::done && done < times.size()) {
        options.progress.check();
        const double limit = corner == corners.end() ? end : std::min(*corner, end);
        result.status = stepper.step(limit, rate...);
        if (result.status != OdeStatus::done) break;
        while (corner != corners.end() && stepper.time_s() >= *corner) ++corner;
        for (; done < times.size() && times(done) <= stepper.time_s(); ++done) {
          stepper.interpolate(times(done), y);
          rows.row(done) = experiment.row(times(done), y.data());
        }
        options.progress.tell((stepper.time_s() - begin) / (end - begin), "simulating the muscle");
      }
      result.statistics = stepper.statistics();
    };
    if (unit.laws().mode == TendonMode::mass) {
      math::StiffProblem problem;
      problem.state_count = y0.size();
      problem.rate = [&](double t, const double* state, double* ydot) {
        experiment.rate(t, state, ydot);
        return true;
      };
      math::StiffIntegrator stepper(std::move(problem), ode);
      result.status = stepper.start(begin, y0);
      run(stepper);
    } else {
      const auto rate = [&](double t, const double* state, double* ydot) { experiment.rate(t, state, ydot); };
      math::RungeKutta<double> stepper(y0.size(), ode);
      result.status = stepper.start(begin, y0, rate);
      run(stepper, rate);
    }
  }
  result.message = std::string(math::explain(result.status));
  result.series = TimeSeries(times.head(done), channels(), rows.topRows(done));
  return result;
}

}  // namespace myoid::muscle
