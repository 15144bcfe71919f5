#pragma once

// Integrates a skeleton with muscles and records the result; included by the sources that simulate.
// HingeSkeleton shows the interface of a skeleton.

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/math/ode_events.h"
#include "myoid/math/runge_kutta.h"
#include "myoid/math/stiff_ode.h"
#include "myoid/simulation/activation_signal.h"
#include "myoid/simulation/simulation.h"
#include "myoid/simulation/simulation_record.h"

namespace myoid::simulation {

/// Throws InvalidInput unless start, input and options fit a skeleton of this size.
void check_simulation(std::span<const std::string> muscles,
                      std::size_t coordinate_count,
                      const SimulationInput& input,
                      const SimulationStart& start,
                      const SimulationOptions& options);

/// Returns the times of the result's rows.
[[nodiscard]] std::vector<double> output_times(const SimulationStart& start, const SimulationOptions& options);

/// Returns the times after `start_s` at which inputs jump, and the end, in order. A controller's
/// excitations are not known beforehand.
[[nodiscard]] std::vector<double> break_times(const SimulationInput& input,
                                              double start_s,
                                              const SimulationOptions& options);

/// One running simulation. States: q, qdot, and for each muscle the states of its tendon mode.
template <typename Skeleton>
class SimulationRun {
 public:
  SimulationRun(Skeleton skeleton,
                const SimulationInput& input,
                const SimulationStart& start,
                const SimulationOptions& options)
      : skeleton_(std::move(skeleton)),
        input_(input),
        options_(options),
        nq_(skeleton_.coordinate_count()),
        n_(skeleton_.muscle_count()),
        now_(start.time_s),
        limit_(start.time_s),
        limit_left_(start.time_s) {
    std::vector<std::string> names;
    offsets_.push_back(2 * nq_);
    for (std::size_t i = 0; i < n_; ++i) {
      names.push_back(skeleton_.muscle_name(i));
      const auto mode = skeleton_.unit(i).laws().mode;
      offsets_.push_back(offsets_.back() + static_cast<std::size_t>(muscle::state_size(mode)));
    }
    check_simulation(names, nq_, input, start, options);
    times_ = output_times(start, options);
    states_ = offsets_.back();
    works_ = options.energy ? SimulationRecord::kMuscleWorks * n_ + SimulationRecord::kJointWorks : 0;
    std::vector<SimulationRecord::Coordinate> coordinates;
    for (std::size_t k = 0; k < nq_; ++k)
      coordinates.push_back({skeleton_.coordinate_name(k), skeleton_.is_rotational(k)});
    record_ = SimulationRecord(std::move(names), std::move(coordinates), times_.size(), options.energy);
    hints_.assign(n_, 0);
    activation_.assign(n_, 0.0);
    excitation_.assign(n_, 0.0);
    tau_.assign(nq_, 0.0);
    qddot_.assign(nq_, 0.0);
    device_.assign(nq_, 0.0);
    prescribed_.assign(nq_, 0);
    for (std::size_t k = 0; k < input.device.size(); ++k) prescribed_[k] = input.device[k].acceleration ? 1 : 0;
    y_.assign(states_, 0.0);
    std::copy(start.q.begin(), start.q.end(), y_.begin());
    std::copy(start.qdot.begin(), start.qdot.end(), y_.begin() + static_cast<std::ptrdiff_t>(nq_));
    begin(start);
    breaks_ = break_times(input, now_, options);
  }

  Simulation go() {
    bool explicit_method = true;
    for (std::size_t i = 0; i < n_; ++i) explicit_method &= skeleton_.unit(i).laws().mode == muscle::TendonMode::rigid;
    result_.status = explicit_method ? go_explicit() : go_implicit();
    if (options_.progress.stop.stop_requested()) throw Interrupted();
    return finish();
  }

 private:
  static constexpr long kMostJumps = 200;

  [[nodiscard]] bool controlled() const { return static_cast<bool>(options_.controller.excite); }

  void ask_controller(double t, const double* y) {
    options_.controller.excite(t, {y, nq_}, {y + nq_, nq_}, excitation_);
    for (std::size_t i = 0; i < n_; ++i) {
      if (!(excitation_[i] >= 0.0 && excitation_[i] <= 1.0)) {
        throw InvalidInput(fmt::format("the controller asks {} for {} at {} s, expected 0 to 1",
                                       skeleton_.muscle_name(i), excitation_[i], t));
      }
    }
  }

  void begin(const SimulationStart& start) {
    if (controlled()) ask_controller(now_, y_.data());
    skeleton_.set(y_.data(), y_.data() + nq_);
    for (std::size_t i = 0; i < n_; ++i) {
      if (!controlled()) excitation_[i] = value_at(input_.excitation[i], now_);
      const auto first = start.activation.empty() ? muscle::settled_activation(excitation_[i]) : start.activation[i];
      signals_.emplace_back(skeleton_.activation(i), now_, first);
      if (!controlled()) signals_.back().extend(input_.excitation[i], options_.end_s);
      const auto fiber = start.fiber.empty()
                             ? muscle::equilibrium_state(skeleton_.unit(i), {first.activation, skeleton_.length_m(i),
                                                                             skeleton_.velocity_mps(i)})
                             : start.fiber[i];
      if (size(i) > 0) y_[offsets_[i]] = fiber.fiber_length_m;
      if (size(i) > 1) y_[offsets_[i] + 1] = fiber.fiber_velocity_mps;
    }
  }

  [[nodiscard]] std::size_t size(std::size_t i) const { return offsets_[i + 1] - offsets_[i]; }
  [[nodiscard]] muscle::MusculotendonState<double> fiber(std::size_t i, const double* y) const {
    const double* s = y + offsets_[i];
    return {size(i) > 0 ? s[0] : 0.0, size(i) > 1 ? s[1] : 0.0};
  }
  [[nodiscard]] muscle::MusculotendonInput<double> input_of(std::size_t i) const {
    return {activation_[i], skeleton_.length_m(i), skeleton_.velocity_mps(i)};
  }

  /// Inputs may jump at the present limit: they are taken from the stretch before it.
  [[nodiscard]] double clamped(double t) const { return std::min(t, limit_left_); }
  void set_limit(double t) {
    limit_ = t;
    limit_left_ = std::nextafter(t, -1e300);
  }

  void set(double t, const double* y) {
    const double inside = clamped(t);
    for (std::size_t i = 0; i < n_; ++i) activation_[i] = signals_[i].at(inside, hints_[i]);
    skeleton_.set(y, y + nq_);
    for (std::size_t k = 0; k < nq_; ++k) {
      tau_[k] = external(k, inside);
      if (prescribed_[k] != 0) qddot_[k] = input_.device[k].acceleration(inside);
    }
  }
  [[nodiscard]] double external(std::size_t k, double t) const {
    if (input_.external.empty()) return 0.0;
    const Signal& s = input_.external[k];
    return s.time_s.size() == 1 ? s.value[0] : value_at(s, t);
  }
  void pull(std::size_t i, double tendon_force_n) {
    for (std::size_t k = 0; k < nq_; ++k) tau_[k] += skeleton_.moment_arm_m(i, k) * tendon_force_n;
  }

  void rate(double t, const double* y, double* ydot) {
    set(t, y);
    for (std::size_t i = 0; i < n_; ++i) {
      const auto r = muscle::musculotendon_rate(skeleton_.unit(i), input_of(i), fiber(i, y));
      pull(i, r.tendon_force_n);
      if (size(i) > 0) ydot[offsets_[i]] = r.fiber_length_rate_mps;
      if (size(i) > 1) ydot[offsets_[i] + 1] = r.fiber_velocity_rate_mps2;
    }
    skeleton_.accelerate(tau_.data(), prescribed_.data(), qddot_.data(), device_.data());
    for (std::size_t k = 0; k < nq_; ++k) {
      ydot[k] = y[nq_ + k];
      ydot[nq_ + k] = qddot_[k];
    }
  }

  /// Computes the powers of the elements, in the order of the energy's columns.
  void powers(double t, const double* y, double* p) {
    set(t, y);
    for (std::size_t i = 0; i < n_; ++i) {
      const auto o = muscle::musculotendon_output(skeleton_.unit(i), input_of(i), fiber(i, y));
      pull(i, o.tendon_force_n);
      double* w = p + SimulationRecord::kMuscleWorks * i;
      w[0] = o.active_power_w;
      w[1] = o.passive_power_w;
      w[2] = o.viscous_power_w;
      w[3] = o.tendon_power_w;
      w[4] = o.musculotendon_power_w;
      w[5] = o.kinetic_power_w;
    }
    skeleton_.accelerate(tau_.data(), prescribed_.data(), qddot_.data(), device_.data());
    double* w = p + SimulationRecord::kMuscleWorks * n_;
    std::fill(w, w + SimulationRecord::kJointWorks, 0.0);
    for (std::size_t k = 0; k < nq_; ++k) {
      const double speed = y[nq_ + k];
      w[0] += skeleton_.gravity(k) * speed;
      w[1] += skeleton_.joint_elastic(k) * speed;
      w[2] += skeleton_.joint_viscous(k) * speed;
      w[3] += (external(k, clamped(t)) + device_[k]) * speed;
    }
  }

  void events(double t, const double* y, double* g) {
    set(t, y);
    for (std::size_t i = 0; i < n_; ++i) {
      const auto values = muscle::musculotendon_events(skeleton_.unit(i), input_of(i), fiber(i, y));
      std::copy(values.begin(), values.end(), g + i * values.size());
    }
  }
  [[nodiscard]] std::size_t event_count() const {
    return options_.locate_kinks ? n_ * muscle::kMusculotendonEventCount : 0;
  }

  /// Returns the next time up to which inputs are smooth, with the activations known so far.
  double next_limit(const double* y) {
    double next = *std::upper_bound(breaks_.begin(), breaks_.end(), now_);
    if (controlled()) {
      const double interval = options_.controller.interval_s;
      const double tick = times_.front() + static_cast<double>(ticks_) * interval;
      if (ticks_ > 0 && now_ >= tick) ask_controller(now_, y);  // the first answer exists already
      if (now_ >= tick) ++ticks_;
      next = std::min(next, times_.front() + static_cast<double>(ticks_) * interval);
      for (std::size_t i = 0; i < n_; ++i) signals_[i].extend(next, excitation_[i], excitation_[i]);
    }
    return next;
  }

  /// Records the rows of the result within the last step; `sample(t)` fills y_ and work_.
  template <typename Sample>
  bool emit(double until, Sample&& sample) {
    while (row_ < times_.size() && times_[row_] <= until) {
      sample(times_[row_]);
      record(times_[row_], static_cast<Eigen::Index>(row_));
      ++row_;
    }
    result_.reached_s = until;
    if (++calls_ % 256 == 0) {
      options_.progress.tell((until - times_.front()) / (options_.end_s - times_.front()), "simulating");
    }
    return !options_.progress.stop.stop_requested();
  }

  math::OdeStatus go_explicit() {
    const std::size_t total = states_ + works_;
    math::OdeOptions ode = options_.ode;
    if (!ode.absolute_tolerances.empty()) ode.absolute_tolerances.resize(total, ode.absolute_tolerance);
    math::RungeKutta<double> stepper(total, ode);
    const auto f = [this](double t, const double* y, double* ydot) {
      rate(t, y, ydot);
      if (works_ > 0) powers(t, y, ydot + states_);
    };
    const auto g = [this](double t, const double* y, double* out) { events(t, y, out); };
    std::vector<double> y = y_;
    y.resize(total, 0.0);
    work_.assign(works_, 0.0);
    std::vector<double> at = y;
    const auto on_step = [&](const math::RungeKutta<double>& s) {
      return emit(s.time_s(), [&](double t) {
        s.interpolate(t, at);
        std::copy_n(at.begin(), states_, y_.begin());
        std::copy(at.begin() + static_cast<std::ptrdiff_t>(states_), at.end(), work_.begin());
      });
    };
    return drive(stepper, std::move(y), g, on_step, f);
  }

  math::OdeStatus go_implicit() {
    math::StiffProblem problem;
    problem.state_count = states_;
    problem.rate = [this](double t, const double* y, double* ydot) {
      rate(t, y, ydot);
      return true;
    };
    problem.quadrature_count = works_;
    problem.quadrature = [this](double t, const double* y, double* p) {
      powers(t, y, p);
      return true;
    };
    math::StiffIntegrator stepper(std::move(problem), options_.ode);
    const auto g = [this](double t, const double* y, double* out) { events(t, y, out); };
    work_.assign(works_, 0.0);
    const auto on_step = [&](const math::StiffIntegrator& s) {
      return emit(s.time_s(), [&](double t) {
        const double known = std::max(t, s.previous_time_s());  // t may be within a hop
        s.interpolate(known, y_);
        if (works_ > 0) s.interpolate_quadrature(known, work_);
      });
    };
    return drive(stepper, y_, g, on_step);
  }

  template <typename Stepper, typename Events, typename OnStep, typename... Rate>
  math::OdeStatus drive(
      Stepper& stepper, std::vector<double> y, const Events& g, const OnStep& on_step, const Rate&... rate) {
    math::EventSigns signs(event_count());
    std::vector<double> values(event_count());
    set_limit(next_limit(y.data()));
    math::OdeStatus status = stepper.start(now_, std::span<const double>(y), rate...);
    const auto look = [&] {
      if (signs.size() == 0) return;
      g(now_, y.data(), values.data());
      signs.start(values);
    };
    look();
    if (status == math::OdeStatus::done && !on_step(stepper)) status = math::OdeStatus::stopped;
    while (status == math::OdeStatus::done) {
      status = math::integrate(stepper, limit_, signs, g, on_step, rate...);
      now_ = stepper.time_s();
      if constexpr (sizeof...(Rate) == 0) {
        if (status == math::OdeStatus::step_too_small && result_.jumps_passed < kMostJumps) {
          ++result_.jumps_passed;
          status = stepper.hop(std::min(1e-9, 0.5 * (limit_ - now_)));
          now_ = stepper.time_s();
          std::copy(stepper.state().begin(), stepper.state().end(), y.begin());
          look();
          continue;
        }
      }
      if (status != math::OdeStatus::done || !(now_ < options_.end_s)) break;
      const bool jumped = std::binary_search(breaks_.begin(), breaks_.end(), now_);
      std::copy(stepper.state().begin(), stepper.state().end(), y.begin());
      set_limit(next_limit(y.data()));
      if (jumped) {
        if constexpr (sizeof...(Rate) > 0) {
          status = stepper.renew(rate...);
        } else {
          stepper.renew();
        }
        look();
      }
    }
    result_.statistics = stepper.statistics();
    return status;
  }

  void record(double t, Eigen::Index row) {
    SimulationRecord& r = record_;
    set(t, y_.data());
    const auto nq = static_cast<Eigen::Index>(nq_);
    for (Eigen::Index k = 0; k < nq; ++k) r.torque(row, 5 * k) = -tau_[static_cast<std::size_t>(k)];
    for (std::size_t i = 0; i < n_; ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      const auto in = input_of(i);
      const auto o = muscle::musculotendon_output(skeleton_.unit(i), in, fiber(i, y_.data()));
      pull(i, o.tendon_force_n);
      r.excitation(row, c) = controlled() ? excitation_[i] : value_at(input_.excitation[i], t);
      r.activation(row, c) = activation_[i];
      r.length(row, c) = in.length_m;
      r.velocity(row, c) = in.velocity_mps;
      for (std::size_t k = 0; k < nq_; ++k)
        r.moment_arm(row, static_cast<Eigen::Index>(k * n_ + i)) = skeleton_.moment_arm_m(i, k);
      r.fiber_length(row, c) = o.fiber_length_m;
      r.fiber_velocity(row, c) = o.fiber_velocity_mps;
      r.tendon_length(row, c) = o.tendon_length_m;
      r.fiber_force(row, c) = o.fiber_force_n;
      r.tendon_force(row, c) = o.tendon_force_n;
      if (works_ > 0) {
        const auto w = static_cast<Eigen::Index>(works_) + 3 * c;
        r.energy(row, w) = o.passive_energy_j;
        r.energy(row, w + 1) = o.tendon_energy_j;
        r.energy(row, w + 2) = o.kinetic_energy_j;
      }
    }
    skeleton_.accelerate(tau_.data(), prescribed_.data(), qddot_.data(), device_.data());
    for (Eigen::Index c = 0; c < nq; ++c) {
      const auto k = static_cast<std::size_t>(c);
      r.torque(row, 5 * c) += tau_[k];
      r.torque(row, 5 * c + 1) = skeleton_.gravity(k);
      r.torque(row, 5 * c + 2) = skeleton_.joint_elastic(k) + skeleton_.joint_viscous(k);
      r.torque(row, 5 * c + 3) = external(k, clamped(t));
      r.torque(row, 5 * c + 4) = device_[k];
      r.motion(row, 3 * c) = y_[k];
      r.motion(row, 3 * c + 1) = y_[nq_ + k];
      r.motion(row, 3 * c + 2) = qddot_[k];
    }
    if (works_ > 0) {
      for (std::size_t k = 0; k < works_; ++k) r.energy(row, static_cast<Eigen::Index>(k)) = work_[k];
      const auto w = static_cast<Eigen::Index>(works_) + 3 * static_cast<Eigen::Index>(n_);
      r.energy(row, w) = skeleton_.kinetic_energy_j();
      r.energy(row, w + 1) = skeleton_.gravity_energy_j();
      r.energy(row, w + 2) = skeleton_.joint_elastic_energy_j();
    }
  }

  Simulation finish() {
    result_.message = std::string(math::explain(result_.status));
    if (result_.jumps_passed > 0)
      result_.message += fmt::format(", past {} jumps of the equations", result_.jumps_passed);
    if (result_.status != math::OdeStatus::done) result_.message += fmt::format(" (at {:.6g} s)", result_.reached_s);
    record_.write_to(result_, Eigen::Map<const Eigen::VectorXd>(times_.data(), static_cast<Eigen::Index>(row_)));
    return std::move(result_);
  }

  Skeleton skeleton_;
  const SimulationInput& input_;
  const SimulationOptions& options_;
  std::size_t nq_, n_, states_ = 0, works_ = 0;
  std::vector<std::size_t> offsets_;
  std::vector<double> times_;
  std::vector<ActivationSignal<double>> signals_;
  std::vector<std::size_t> hints_;
  std::vector<double> activation_, excitation_, tau_, qddot_, device_;
  std::vector<char> prescribed_;
  double now_, limit_, limit_left_;
  std::vector<double> y_, work_, breaks_;
  std::size_t row_ = 0;
  long calls_ = 0, ticks_ = 0;
  SimulationRecord record_;
  Simulation result_;
};

}  // namespace myoid::simulation
