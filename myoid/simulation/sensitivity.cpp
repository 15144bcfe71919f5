#include "myoid/simulation/sensitivity.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>

#include <ceres/jet.h>
#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/core/error.h"
#include "myoid/math/ode_events.h"
#include "myoid/math/stiff_ode.h"
#include "myoid/simulation/activation_signal.h"
#include "myoid/simulation/arm_dynamics.h"
#include "myoid/simulation/arm_parameters.h"
#include "myoid/simulation/simulation_run.h"

namespace myoid::simulation {
namespace {

constexpr int kChunk = 8;
using Jet = ceres::Jet<double, kChunk>;

/// Returns the factor of the derivatives by a parameter during integration, which makes them as
/// large as the states: the parameter's size, or 1 for zero.
double scale_of(double value) { return value != 0.0 ? std::abs(value) : 1.0; }

constexpr std::string_view kStart[] = {"start_angle", "start_speed"};

/// Returns the arm in dual numbers, with the derivatives by (scaled) parameters begin, begin + 1, ....
Arm<Jet> seeded(const Arm<double>& arm, std::span<const std::string> chunk) {
  Arm<Jet> dual = lifted_arm<Jet>(arm);
  visit_arm_parameters(dual, [&](const auto& name, Unit, Jet& field) {
    const auto at = std::find(chunk.begin(), chunk.end(), name);
    if (at != chunk.end()) field.v[static_cast<int>(at - chunk.begin())] = scale_of(field.a);
  });
  return dual;
}

/// One integration with the derivatives by at most kChunk parameters.
class Chunk {
 public:
  Chunk(const Arm<double>& arm,
        const SimulationInput& input,
        const SimulationStart& start,
        const SimulationOptions& options,
        std::span<const std::string> parameters,
        const std::vector<double>& times)
      : plain_(arm),
        dual_(seeded(arm, parameters)),
        input_(input),
        options_(options),
        times_(times),
        count_(parameters.size()),
        n_(arm.muscles.size()),
        states_(plain_.state_count()),
        prescribed_(!input.device.empty() && input.device[0].acceleration),
        activation_(n_),
        dual_activation_(n_),
        hints_(n_, 0),
        dual_hints_(n_, 0),
        y_(states_, 0.0),
        s_(states_ * count_, 0.0),
        dual_y_(states_),
        dual_ydot_(states_),
        now_(start.time_s) {
    for (std::size_t i = 0; i < n_; ++i) {
      const double u = value_at(input.excitation[i], now_);
      muscle::ActivationPoint<double> first = muscle::settled_activation(u);
      if (!start.activation.empty()) first = start.activation[i];
      signals_.emplace_back(arm.muscles[i].activation, now_, first);
      signals_.back().extend(input.excitation[i], options.end_s);
      dual_signals_.emplace_back(dual_.arm().muscles[i].activation, now_,
                                 muscle::ActivationPoint<Jet>{Jet(first.filtered_excitation), Jet(first.activation)});
      dual_signals_.back().extend(input.excitation[i], options.end_s);
    }
    begin(start, parameters);
    breaks_ = break_times(input, start.time_s, options);
  }

  math::OdeStatus run(Sensitivities& result, Eigen::Index first_column) {
    math::StiffProblem problem;
    problem.state_count = states_;
    problem.rate = [this](double t, const double* y, double* ydot) {
      const double inside = std::min(t, limit_left_);
      for (std::size_t i = 0; i < n_; ++i) activation_[i] = signals_[i].at(inside, hints_[i]);
      plain_.rate(activation_.data(), external(inside), y, ydot);
      if (prescribed_) ydot[1] = input_.device[0].acceleration(inside);
      return true;
    };
    problem.sensitivity_count = count_;
    problem.sensitivity = [this](double t, const double* y, const double* const* s, double* const* sdot) {
      dual_rate(t, y, [&](std::size_t k, std::size_t i) { return s[k][i]; });
      for (std::size_t k = 0; k < count_; ++k) {
        for (std::size_t i = 0; i < states_; ++i) sdot[k][i] = dual_ydot_[i].v[static_cast<int>(k)];
      }
      return true;
    };
    math::StiffIntegrator stepper(std::move(problem), options_.ode);
    math::EventSigns signs(options_.locate_kinks ? n_ * muscle::kMusculotendonEventCount : 0);
    const auto events = [this](double t, const double* y, double* g) {
      const double inside = std::min(t, limit_left_);
      for (std::size_t i = 0; i < n_; ++i) {
        double arm_m = 0.0;
        const auto in = plain_.input(i, signals_[i].at(inside, hints_[i]), y, arm_m);
        const auto values = muscle::musculotendon_events(plain_.unit(i), in, plain_.fiber(i, y));
        std::copy(values.begin(), values.end(), g + i * values.size());
      }
    };
    const auto on_step = [&](const math::StiffIntegrator& stepped) {
      while (row_ < times_.size() && times_[row_] <= stepped.time_s()) {
        stepped.interpolate(times_[row_], y_);
        stepped.interpolate_sensitivity(times_[row_], s_);
        record(times_[row_], result, static_cast<Eigen::Index>(row_), first_column);
        ++row_;
      }
      return !options_.progress.stop.stop_requested();
    };
    std::vector<double> g(signs.size());
    stepper.start(now_, y_, s_);
    math::OdeStatus status = math::OdeStatus::done;
    bool first = true;
    for (const double limit : breaks_) {
      set_limit(limit);
      const std::vector<double> y(stepper.state().begin(), stepper.state().end());
      if (signs.size() > 0) {
        events(now_, y.data(), g.data());
        signs.start(g);
      }
      if (first && !on_step(stepper)) return math::OdeStatus::stopped;
      if (!first) stepper.renew();
      first = false;
      status = math::integrate(stepper, limit, signs, events, on_step);
      now_ = stepper.time_s();
      if (status != math::OdeStatus::done) break;
    }
    statistics = stepper.statistics();
    return status;
  }

  math::OdeStatistics statistics;

 private:
  void set_limit(double t) { limit_left_ = std::nextafter(t, -1e300); }
  [[nodiscard]] double external(double t) const {
    return input_.external.empty() ? 0.0 : value_at(input_.external[0], t);
  }

  /// Puts the fibers in equilibrium, with the derivatives of that.
  void begin(const SimulationStart& start, std::span<const std::string> parameters) {
    dual_y_[0] = Jet(start.q[0]);
    dual_y_[1] = Jet(start.qdot.empty() ? 0.0 : start.qdot[0]);
    for (std::size_t k = 0; k < count_; ++k) {
      for (std::size_t i = 0; i < 2; ++i) {
        if (parameters[k] == kStart[i]) dual_y_[i].v[static_cast<int>(k)] = 1.0;
      }
    }
    for (std::size_t i = 0; i < n_; ++i) {
      const std::size_t o = dual_.offset(i);
      const std::size_t size = dual_.offset(i + 1) - o;
      if (size == 0) continue;
      Jet arm_m;
      std::size_t hint = 0;
      const auto in = dual_.input(i, dual_signals_[i].at(now_, hint), dual_y_.data(), arm_m);
      const auto fiber = start.fiber.empty() ? muscle::equilibrium_state(dual_.unit(i), in)
                                             : muscle::MusculotendonState<Jet>{Jet(start.fiber[i].fiber_length_m),
                                                                               Jet(start.fiber[i].fiber_velocity_mps)};
      dual_y_[o] = fiber.fiber_length_m;
      if (size > 1) dual_y_[o + 1] = fiber.fiber_velocity_mps;
    }
    for (std::size_t i = 0; i < states_; ++i) {
      y_[i] = dual_y_[i].a;
      for (std::size_t k = 0; k < count_; ++k) s_[k * states_ + i] = dual_y_[i].v[static_cast<int>(k)];
    }
  }

  template <typename Derivative>
  void dual_rate(double t, const double* y, const Derivative& derivative) {
    const double inside = std::min(t, limit_left_);
    for (std::size_t i = 0; i < n_; ++i) dual_activation_[i] = dual_signals_[i].at(inside, dual_hints_[i]);
    for (std::size_t i = 0; i < states_; ++i) {
      dual_y_[i] = Jet(y[i]);
      for (std::size_t k = 0; k < count_; ++k) dual_y_[i].v[static_cast<int>(k)] = derivative(k, i);
    }
    dual_.rate(dual_activation_.data(), Jet(external(inside)), dual_y_.data(), dual_ydot_.data());
    free_acceleration_ = dual_ydot_[1];
    if (prescribed_) dual_ydot_[1] = Jet(input_.device[0].acceleration(inside));
  }

  void record(double t, Sensitivities& result, Eigen::Index row, Eigen::Index column) {
    dual_rate(t, y_.data(), [&](std::size_t k, std::size_t i) { return s_[k * states_ + i]; });
    Jet torque(0.0);
    const auto put = [&](Eigen::MatrixXd& m, const Jet& value) {
      for (std::size_t k = 0; k < count_; ++k)
        m(row, column + static_cast<Eigen::Index>(k)) = value.v[static_cast<int>(k)];
    };
    for (std::size_t i = 0; i < n_; ++i) {
      Jet arm_m;
      const auto in = dual_.input(i, dual_activation_[i], dual_y_.data(), arm_m);
      const auto o = muscle::musculotendon_output(dual_.unit(i), in, dual_.fiber(i, dual_y_.data()));
      torque += arm_m * o.tendon_force_n;
      put(result.activation[i], dual_activation_[i]);
      put(result.fiber_length[i], o.fiber_length_m);
      put(result.tendon_force[i], o.tendon_force_n);
    }
    put(result.angle, dual_y_[0]);
    put(result.speed, dual_y_[1]);
    put(result.acceleration, dual_ydot_[1]);
    put(result.torque, torque);
    put(result.device, prescribed_ ? dual_.inertia_kgm2() * (dual_ydot_[1] - free_acceleration_) : Jet(0.0));
  }

  ArmDynamics<double> plain_;
  ArmDynamics<Jet> dual_;
  const SimulationInput& input_;
  const SimulationOptions& options_;
  const std::vector<double>& times_;
  std::size_t count_, n_, states_;
  bool prescribed_;
  std::vector<ActivationSignal<double>> signals_;
  std::vector<ActivationSignal<Jet>> dual_signals_;
  std::vector<double> activation_;
  std::vector<Jet> dual_activation_;
  std::vector<std::size_t> hints_, dual_hints_;
  std::vector<double> y_, s_;
  std::vector<Jet> dual_y_, dual_ydot_;
  Jet free_acceleration_;
  std::vector<double> breaks_;
  double now_, limit_left_ = 0.0;
  std::size_t row_ = 0;
};

}  // namespace

Sensitivities simulate_sensitivities(const Arm<double>& arm,
                                     const SimulationInput& input,
                                     const SimulationStart& start,
                                     const SimulationOptions& options,
                                     std::span<const std::string> parameters) {
  validate(arm);
  if (options.controller.excite) throw InvalidInput("sensitivities: the answers of a controller have no derivatives");
  std::vector<std::string> names;
  for (const ArmMuscle<double>& m : arm.muscles) names.push_back(m.name);
  check_simulation(names, 1, input, start, options);
  const std::vector<double> times = output_times(start, options);
  Arm<double> copy = arm;
  Sensitivities result;
  std::vector<double> scales;
  for (const std::string& name : parameters) {
    const bool of_start = std::find(std::begin(kStart), std::end(kStart), name) != std::end(kStart);
    scales.push_back(of_start ? 1.0 : scale_of(arm_parameter(copy, name)));
    result.parameters.push_back(name);
  }
  const auto rows = static_cast<Eigen::Index>(times.size());
  const auto columns = static_cast<Eigen::Index>(parameters.size());
  result.time_s = Eigen::Map<const Eigen::VectorXd>(times.data(), rows);
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(rows, columns);
  for (auto* m : {&result.angle, &result.speed, &result.acceleration, &result.torque, &result.device}) *m = zero;
  for (auto* list : {&result.activation, &result.fiber_length, &result.tendon_force})
    list->assign(arm.muscles.size(), zero);

  const std::size_t chunks = (parameters.size() + kChunk - 1) / kChunk;
  std::vector<math::OdeStatus> status(chunks, math::OdeStatus::done);
  std::vector<math::OdeStatistics> statistics(chunks);
  oneapi::tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    const std::size_t begin = c * kChunk;
    Chunk chunk(arm, input, start, options,
                parameters.subspan(begin, std::min<std::size_t>(kChunk, parameters.size() - begin)), times);
    status[c] = chunk.run(result, static_cast<Eigen::Index>(begin));
    statistics[c] = chunk.statistics;
  });
  if (options.progress.stop.stop_requested()) throw Interrupted();
  for (std::size_t c = 0; c < chunks; ++c) {
    if (status[c] != math::OdeStatus::done) result.status = status[c];
    result.statistics.steps += statistics[c].steps;
    result.statistics.rate_evaluations += statistics[c].rate_evaluations;
    result.statistics.rejected += statistics[c].rejected;
    result.statistics.jacobians += statistics[c].jacobians;
    result.statistics.events += statistics[c].events;
  }
  result.message = std::string(math::explain(result.status));
  const auto unscale = [&](Eigen::MatrixXd& m) {
    for (Eigen::Index k = 0; k < columns; ++k) m.col(k) /= scales[static_cast<std::size_t>(k)];
  };
  for (auto* m : {&result.angle, &result.speed, &result.acceleration, &result.torque, &result.device}) unscale(*m);
  for (auto* list : {&result.activation, &result.fiber_length, &result.tendon_force}) {
    for (Eigen::MatrixXd& m : *list) unscale(m);
  }
  return result;
}

Eigen::MatrixXd information(const Sensitivities& s, const MeasurementSpread& spread) {
  const auto n = static_cast<Eigen::Index>(s.parameters.size());
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
  bool measured = false;
  const auto add = [&](const Eigen::MatrixXd& jacobian, double sd, std::string_view what) {
    if (!(sd >= 0.0)) throw InvalidInput(fmt::format("information: the spread of {} is {}", what, sd));
    if (sd == 0.0) return;
    measured = true;
    result.noalias() += jacobian.transpose() * jacobian / (sd * sd);
  };
  add(s.angle, spread.angle_rad, "the angle");
  add(s.torque, spread.torque_nm, "the torque");
  add(s.device, spread.device_nm, "the device's torque");
  for (const Eigen::MatrixXd& force : s.tendon_force) add(force, spread.tendon_force_n, "the tendon force");
  for (const Eigen::MatrixXd& length : s.fiber_length) add(length, spread.fiber_length_m, "the fiber length");
  if (!measured) throw InvalidInput("information: nothing is measured");
  return result;
}

}  // namespace myoid::simulation
