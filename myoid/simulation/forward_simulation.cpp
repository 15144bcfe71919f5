#include "myoid/simulation/forward_simulation.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/math/ode_events.h"
#include "myoid/math/runge_kutta.h"
#include "myoid/math/stiff_ode.h"
#include "myoid/simulation/activation_signal.h"

namespace myoid::simulation {
namespace {

using muscle::MusculotendonOutput;

/// Works per muscle that are integrated, then those of the joint.
constexpr std::size_t kMuscleWorks = 6;
constexpr const char* kMuscleWorkNames[] = {"active", "passive",       "viscous",
                                            "tendon", "musculotendon", "kinetic"};
constexpr std::size_t kJointWorks = 4;
constexpr const char* kJointWorkNames[] = {"gravity_work", "joint_elastic_work",
                                           "joint_viscous_work", "external_work"};

std::vector<Channel> per_muscle(const Arm<double>& arm, Unit unit) {
  std::vector<Channel> channels;
  for (const ArmMuscle<double>& m : arm.muscles) channels.push_back({m.name, unit});
  return channels;
}

std::vector<double> output_times(const ArmStart& start, const SimulationOptions& o) {
  if (!o.output_times_s.empty()) {
    for (std::size_t k = 0; k < o.output_times_s.size(); ++k) {
      const double t = o.output_times_s[k];
      if (!(t >= start.time_s && t <= o.end_s) || (k > 0 && t <= o.output_times_s[k - 1])) {
        throw InvalidInput(
            fmt::format("output time {} is {} s, expected rising times in {} .. {} s", k, t,
                        start.time_s, o.end_s));
      }
    }
    return o.output_times_s;
  }
  if (!(o.output_rate_hz > 0.0) || !(o.output_rate_hz <= 1e6)) {
    throw InvalidInput(
        fmt::format("output rate {} Hz, expected more than 0 and at most 1e6", o.output_rate_hz));
  }
  const double duration = o.end_s - start.time_s;
  if (duration * o.output_rate_hz > 5e7) {
    throw InvalidInput(fmt::format("{} s at {} Hz are more samples than 50 million; lower the rate",
                                   duration, o.output_rate_hz));
  }
  const auto count = static_cast<std::size_t>(std::floor(duration * o.output_rate_hz + 1e-9)) + 1;
  std::vector<double> times(count);
  for (std::size_t k = 0; k < count; ++k)
    times[k] = std::min(start.time_s + static_cast<double>(k) / o.output_rate_hz, o.end_s);
  return times;
}

void check(const Arm<double>& arm,
           const ArmInput& input,
           const ArmStart& start,
           const SimulationOptions& o) {
  validate(arm);
  const std::size_t n = arm.muscles.size();
  if (!o.controller.excite && input.excitation.size() != n) {
    throw InvalidInput(fmt::format("{} excitations for {} muscles", input.excitation.size(), n));
  }
  for (std::size_t i = 0; i < input.excitation.size() && i < n; ++i)
    validate_excitation(input.excitation[i], "excitation of " + arm.muscles[i].name);
  validate(input.external_torque_nm, "external torque");
  if (!std::isfinite(start.time_s) || !std::isfinite(o.end_s) || !(o.end_s > start.time_s)) {
    throw InvalidInput(fmt::format("the simulation goes from {} to {} s, expected a later end",
                                   start.time_s, o.end_s));
  }
  if (!std::isfinite(start.angle_rad) || !std::isfinite(start.velocity_radps))
    throw InvalidInput("the angle and its speed at the start must be finite");
  if (!start.activation.empty() && start.activation.size() != n)
    throw InvalidInput(
        fmt::format("{} activations at the start for {} muscles", start.activation.size(), n));
  if (!start.fiber.empty() && start.fiber.size() != n)
    throw InvalidInput(
        fmt::format("{} fiber states at the start for {} muscles", start.fiber.size(), n));
  if (o.controller.excite && !(o.controller.interval_s > 0.0))
    throw InvalidInput(fmt::format("the controller's interval is {} s, expected more than 0",
                                   o.controller.interval_s));
}

/// One simulation under way.
class Run {
 public:
  Run(const Arm<double>& arm,
      const ArmInput& input,
      const ArmStart& start,
      const SimulationOptions& options)
      : dynamics_(arm),
        input_(input),
        options_(options),
        n_(arm.muscles.size()),
        states_(dynamics_.state_count()),
        works_(options.energy ? kMuscleWorks * n_ + kJointWorks : 0),
        times_(output_times(start, options)),
        hints_(n_, 0),
        activation_(n_, 0.0),
        excitation_(n_, 0.0),
        now_(start.time_s),
        limit_(start.time_s),
        y_(states_, 0.0) {
    std::vector<muscle::ActivationPoint<double>> first(n_);
    if (controlled()) {
      options_.controller.excite(now_, start.angle_rad, start.velocity_radps, excitation_);
      check_control(now_);
    }
    for (std::size_t i = 0; i < n_; ++i) {
      if (!controlled()) excitation_[i] = value_at(input_.excitation[i], now_);
      first[i] = start.activation.empty() ? muscle::settled_activation(excitation_[i])
                                          : start.activation[i];
      signals_.emplace_back(arm.muscles[i].activation, now_, first[i]);
      if (!controlled()) signals_.back().extend(input_.excitation[i], options.end_s);
    }
    begin(start, first);
    for (std::size_t i = 0; i < n_ && !controlled(); ++i)
      append(breaks_, jumps(input_.excitation[i], now_, options.end_s));
    append(breaks_, jumps(input_.external_torque_nm, now_, options.end_s));
    breaks_.push_back(options.end_s);
    std::sort(breaks_.begin(), breaks_.end());
    breaks_.erase(std::unique(breaks_.begin(), breaks_.end()), breaks_.end());
    make_result();
  }

  Simulation go() {
    bool explicit_method = true;
    for (std::size_t i = 0; i < n_; ++i)
      explicit_method &= dynamics_.arm().muscles[i].laws.mode == muscle::TendonMode::rigid;
    result_.status = explicit_method ? go_explicit() : go_implicit();
    if (options_.progress.stop.stop_requested()) throw Interrupted();
    return finish();
  }

 private:
  [[nodiscard]] bool controlled() const { return static_cast<bool>(options_.controller.excite); }
  static void append(std::vector<double>& list, const std::vector<double>& more) {
    list.insert(list.end(), more.begin(), more.end());
  }

  void check_control(double t) const {
    for (std::size_t i = 0; i < n_; ++i) {
      if (!(excitation_[i] >= 0.0 && excitation_[i] <= 1.0)) {
        throw InvalidInput(fmt::format("the controller asks {} for {} at {} s, expected 0 to 1",
                                       dynamics_.arm().muscles[i].name, excitation_[i], t));
      }
    }
  }

  void begin(const ArmStart& start, const std::vector<muscle::ActivationPoint<double>>& first) {
    y_[0] = start.angle_rad;
    y_[1] = start.velocity_radps;
    for (std::size_t i = 0; i < n_; ++i) {
      double arm_m = 0.0;
      const auto in = dynamics_.input(i, first[i].activation, y_.data(), arm_m);
      const auto fiber =
          start.fiber.empty() ? muscle::equilibrium_state(dynamics_.unit(i), in) : start.fiber[i];
      const std::size_t count = dynamics_.offset(i + 1) - dynamics_.offset(i);
      if (count > 0) y_[dynamics_.offset(i)] = fiber.fiber_length_m;
      if (count > 1) y_[dynamics_.offset(i) + 1] = fiber.fiber_velocity_mps;
    }
  }

  /// Nothing is asked beyond the present limit, where an input may jump.
  double clamped(double t) const { return std::min(t, limit_left_); }
  void set_limit(double t) {
    limit_ = t;
    limit_left_ = std::nextafter(t, -1e300);
  }

  void activations_at(double t) {
    for (std::size_t i = 0; i < n_; ++i) activation_[i] = signals_[i].at(t, hints_[i]);
  }
  double external_at(double t) const {
    if (input_.external_torque_nm.time_s.size() == 1) return input_.external_torque_nm.value[0];
    return value_at(input_.external_torque_nm, t);
  }

  void rate(double t, const double* y, double* ydot) {
    activations_at(clamped(t));
    dynamics_.rate(activation_.data(), external_at(clamped(t)), y, ydot);
  }

  /// Powers that the elements give, in the order of the energy's columns.
  void powers(double t, const double* y, double* p) {
    activations_at(clamped(t));
    for (std::size_t i = 0; i < n_; ++i) {
      double arm_m = 0.0;
      const auto in = dynamics_.input(i, activation_[i], y, arm_m);
      const auto o = muscle::musculotendon_output(dynamics_.unit(i), in, dynamics_.fiber(i, y));
      double* w = p + kMuscleWorks * i;
      w[0] = o.active_power_w;
      w[1] = o.passive_power_w;
      w[2] = o.viscous_power_w;
      w[3] = o.tendon_power_w;
      w[4] = o.musculotendon_power_w;
      w[5] = o.kinetic_power_w;
    }
    const auto joint = muscle::joint_passive(dynamics_.arm().joint, y[0], y[1]);
    double* w = p + kMuscleWorks * n_;
    w[0] = dynamics_.gravity_torque_nm(y[0]) * y[1];
    w[1] = joint.elastic_torque_nm * y[1];
    w[2] = joint.viscous_power_w;
    w[3] = external_at(clamped(t)) * y[1];
  }

  void events(double t, const double* y, double* g) {
    activations_at(clamped(t));
    for (std::size_t i = 0; i < n_; ++i) {
      double arm_m = 0.0;
      const auto in = dynamics_.input(i, activation_[i], y, arm_m);
      const auto values =
          muscle::musculotendon_events(dynamics_.unit(i), in, dynamics_.fiber(i, y));
      std::copy(values.begin(), values.end(), g + i * values.size());
    }
  }
  [[nodiscard]] std::size_t event_count() const {
    return options_.locate_kinks ? n_ * muscle::kMusculotendonEventCount : 0;
  }

  /// The next time up to which inputs are smooth, with the activations known so far.
  double next_limit(std::span<const double> y) {
    double next = *std::upper_bound(breaks_.begin(), breaks_.end(), now_);
    if (controlled()) {
      if (ticks_ > 0) {  // the first answer was asked for before the start
        options_.controller.excite(now_, y[0], y[1], excitation_);
        check_control(now_);
      }
      ++ticks_;
      const double tick =
          times_.front() + static_cast<double>(ticks_) * options_.controller.interval_s;
      next = std::min(next, std::max(tick, std::nextafter(now_, 1e300)));
      for (std::size_t i = 0; i < n_; ++i) signals_[i].extend(next, excitation_[i], excitation_[i]);
    }
    return next;
  }

  /// Rows of the result within the last step; `sample(t)` fills y_ and work_.
  template <typename Sample>
  bool emit(double until, Sample&& sample) {
    while (row_ < times_.size() && times_[row_] <= until) {
      sample(times_[row_]);
      record(times_[row_], row_);
      ++row_;
    }
    result_.reached_s = until;
    if (++calls_ % 256 == 0) {
      options_.progress.tell((until - times_.front()) / (options_.end_s - times_.front()),
                             "simulating");
    }
    return !options_.progress.stop.stop_requested();
  }

  math::OdeStatus go_explicit() {
    const std::size_t total = states_ + works_;
    math::OdeOptions ode = options_.ode;
    if (!ode.absolute_tolerances.empty())
      ode.absolute_tolerances.resize(total, ode.absolute_tolerance);
    math::RungeKutta<double> stepper(total, ode);
    const auto f = [this](double t, const double* y, double* ydot) {
      rate(t, y, ydot);
      if (works_ > 0) powers(t, y, ydot + states_);
    };
    const auto g = [this](double t, const double* y, double* out) { events(t, y, out); };
    std::vector<double> y = y_;
    y.resize(total, 0.0);
    const auto on_step = [&](const math::RungeKutta<double>& s) {
      return emit(s.time_s(), [&](double t) {
        s.interpolate(t, y);
        std::copy_n(y.begin(), states_, y_.begin());
        work_.assign(y.begin() + static_cast<std::ptrdiff_t>(states_), y.end());
      });
    };
    return drive(stepper, y, g, on_step, f);
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
    work_.resize(works_, 0.0);
    const auto on_step = [&](const math::StiffIntegrator& s) {
      return emit(s.time_s(), [&](double t) {
        s.interpolate(t, y_);
        if (works_ > 0) s.interpolate_quadrature(t, work_);
      });
    };
    return drive(stepper, y_, g, on_step);
  }

  template <typename Stepper, typename Events, typename OnStep, typename... Rate>
  math::OdeStatus drive(Stepper& stepper,
                        const std::vector<double>& y0,
                        const Events& g,
                        const OnStep& on_step,
                        const Rate&... rate) {
    math::EventSigns signs(event_count());
    std::vector<double> values(event_count());
    std::vector<double> y = y0;
    set_limit(next_limit(y));
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
      if (status != math::OdeStatus::done || !(now_ < options_.end_s)) break;
      const bool jumped = std::binary_search(breaks_.begin(), breaks_.end(), now_);
      std::copy(stepper.state().begin(), stepper.state().end(), y.begin());
      set_limit(next_limit(y));
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

  void make_result() {
    const auto rows = static_cast<Eigen::Index>(times_.size());
    const auto n = static_cast<Eigen::Index>(n_);
    motion_.resize(rows, 3);
    torque_.resize(rows, 4);
    for (auto* m : {&excitations_, &activations_, &length_, &velocity_, &arm_m_, &fiber_length_,
                    &fiber_velocity_, &tendon_length_, &fiber_force_, &tendon_force_})
      m->resize(rows, n);
    if (works_ > 0) energy_.resize(rows, static_cast<Eigen::Index>(works_) + 3 * n + 3);
  }

  void record(double t, std::size_t index) {
    const auto row = static_cast<Eigen::Index>(index);
    activations_at(std::min(t, limit_left_));
    double muscles_nm = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      const auto c = static_cast<Eigen::Index>(i);
      double arm_m = 0.0;
      const auto in = dynamics_.input(i, activation_[i], y_.data(), arm_m);
      const MusculotendonOutput<double> o =
          muscle::musculotendon_output(dynamics_.unit(i), in, dynamics_.fiber(i, y_.data()));
      muscles_nm += arm_m * o.tendon_force_n;
      excitations_(row, c) = controlled() ? excitation_[i] : value_at(input_.excitation[i], t);
      activations_(row, c) = activation_[i];
      length_(row, c) = in.length_m;
      velocity_(row, c) = in.velocity_mps;
      arm_m_(row, c) = arm_m;
      fiber_length_(row, c) = o.fiber_length_m;
      fiber_velocity_(row, c) = o.fiber_velocity_mps;
      tendon_length_(row, c) = o.tendon_length_m;
      fiber_force_(row, c) = o.fiber_force_n;
      tendon_force_(row, c) = o.tendon_force_n;
      if (works_ > 0) {
        const auto w = static_cast<Eigen::Index>(works_) + 3 * c;
        energy_(row, w) = o.passive_energy_j;
        energy_(row, w + 1) = o.tendon_energy_j;
        energy_(row, w + 2) = o.kinetic_energy_j;
      }
    }
    const auto joint = muscle::joint_passive(dynamics_.arm().joint, y_[0], y_[1]);
    const double gravity_nm = dynamics_.gravity_torque_nm(y_[0]);
    const double external_nm = external_at(std::min(t, limit_left_));
    torque_.row(row) << muscles_nm, gravity_nm, joint.torque_nm, external_nm;
    motion_.row(row) << y_[0], y_[1],
        (muscles_nm + gravity_nm + joint.torque_nm + external_nm) / dynamics_.inertia_kgm2();
    if (works_ > 0) {
      for (std::size_t k = 0; k < works_; ++k)
        energy_(row, static_cast<Eigen::Index>(k)) = work_.empty() ? 0.0 : work_[k];
      const auto w = static_cast<Eigen::Index>(works_) + 3 * static_cast<Eigen::Index>(n_);
      energy_(row, w) = 0.5 * dynamics_.inertia_kgm2() * y_[1] * y_[1];
      energy_(row, w + 1) = dynamics_.gravity_energy_j(y_[0]);
      energy_(row, w + 2) = joint.stored_energy_j;
    }
  }

  Simulation finish() {
    const auto rows = static_cast<Eigen::Index>(row_);
    const Eigen::VectorXd t = Eigen::Map<const Eigen::VectorXd>(times_.data(), rows);
    const auto series = [&](std::vector<Channel> channels, const Eigen::MatrixXd& values) {
      return TimeSeries(t, std::move(channels), values.topRows(rows));
    };
    const Arm<double>& arm = dynamics_.arm();
    result_.message = std::string(math::explain(result_.status));
    if (result_.status != math::OdeStatus::done)
      result_.message += fmt::format(" (at {:.6g} s)", result_.reached_s);
    result_.motion = series({{"elbow_flexion", Unit::radian},
                             {"elbow_flexion_speed", Unit::radian_per_second},
                             {"elbow_flexion_acceleration", Unit::radian_per_second2}},
                            motion_);
    result_.excitation = series(per_muscle(arm, Unit::dimensionless), excitations_);
    result_.activation = series(per_muscle(arm, Unit::dimensionless), activations_);
    result_.musculotendon_length = series(per_muscle(arm, Unit::meter), length_);
    result_.musculotendon_velocity = series(per_muscle(arm, Unit::meter_per_second), velocity_);
    result_.moment_arm = series(per_muscle(arm, Unit::meter), arm_m_);
    result_.fiber_length = series(per_muscle(arm, Unit::meter), fiber_length_);
    result_.fiber_velocity = series(per_muscle(arm, Unit::meter_per_second), fiber_velocity_);
    result_.tendon_length = series(per_muscle(arm, Unit::meter), tendon_length_);
    result_.fiber_force = series(per_muscle(arm, Unit::newton), fiber_force_);
    result_.tendon_force = series(per_muscle(arm, Unit::newton), tendon_force_);
    result_.torque = series({{"muscles", Unit::newton_meter},
                             {"gravity", Unit::newton_meter},
                             {"joint", Unit::newton_meter},
                             {"external", Unit::newton_meter}},
                            torque_);
    if (works_ > 0) {
      std::vector<Channel> channels;
      for (const ArmMuscle<double>& m : arm.muscles) {
        for (const char* name : kMuscleWorkNames)
          channels.push_back({fmt::format("{}_{}_work", m.name, name), Unit::newton_meter});
      }
      for (const char* name : kJointWorkNames) channels.push_back({name, Unit::newton_meter});
      for (const ArmMuscle<double>& m : arm.muscles) {
        for (const char* name : {"passive", "tendon", "kinetic"})
          channels.push_back({fmt::format("{}_{}_energy", m.name, name), Unit::newton_meter});
      }
      for (const char* name : {"forearm_kinetic_energy", "gravity_energy", "joint_elastic_energy"})
        channels.push_back({name, Unit::newton_meter});
      result_.energy = series(std::move(channels), energy_);
    }
    return std::move(result_);
  }

  ArmDynamics<double> dynamics_;
  const ArmInput& input_;
  const SimulationOptions& options_;
  std::size_t n_, states_, works_;
  std::vector<double> times_;
  std::vector<ActivationSignal<double>> signals_;
  std::vector<std::size_t> hints_;
  std::vector<double> activation_, excitation_;
  double now_, limit_, limit_left_ = 0.0;
  std::vector<double> y_, work_, breaks_;
  std::size_t row_ = 0;
  long calls_ = 0, ticks_ = 0;
  Simulation result_;
  Eigen::MatrixXd motion_, torque_, energy_;
  Eigen::MatrixXd excitations_, activations_, length_, velocity_, arm_m_, fiber_length_;
  Eigen::MatrixXd fiber_velocity_, tendon_length_, fiber_force_, tendon_force_;
};

}  // namespace

Simulation simulate(const Arm<double>& arm,
                    const ArmInput& input,
                    const ArmStart& start,
                    const SimulationOptions& options) {
  check(arm, input, start, options);
  Run run(arm, input, start, options);
  return run.go();
}

}  // namespace myoid::simulation
