#include "myoid/body/simulation/moving_model.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/body/simulation/simulation_run.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {

MovingModel::MovingModel(const SimulationModel& model,
                         const SimulationInput& input,
                         const SimulationStart& start,
                         const SimulationOptions& options)
    : model_(model),
      input_(input),
      options_(options),
      skeleton_(model),
      nq_(skeleton_.coordinate_count()),
      n_(skeleton_.muscle_count()),
      limit_left_(start.time_s) {
  check_simulation(model, input, start, options);
  works_ = options.energy ? SimulationRecord::kMuscleWorks * n_ + SimulationRecord::kJointWorks : 0;
  offsets_.push_back(2 * nq_);
  for (std::size_t i = 0; i < n_; ++i)
    offsets_.push_back(offsets_.back() + static_cast<std::size_t>(muscle::state_size(skeleton_.unit(i).laws().mode)));
  hints_.assign(n_, 0);
  activation_.assign(n_, 0.0);
  tau_.assign(nq_, 0.0);
  qddot_.assign(nq_, 0.0);
  device_.assign(nq_, 0.0);
  prescribed_.assign(nq_, 0);
  for (std::size_t k = 0; k < input.device.size(); ++k) prescribed_[k] = input.device[k].acceleration ? 1 : 0;
  start_.assign(state_count(), 0.0);
  std::copy(start.q.begin(), start.q.end(), start_.begin());
  std::copy(start.qdot.begin(), start.qdot.end(), start_.begin() + static_cast<std::ptrdiff_t>(nq_));
  begin_muscles(start);
}

void MovingModel::begin_muscles(const SimulationStart& start) {
  skeleton_.set(start_.data(), start_.data() + nq_);
  for (std::size_t i = 0; i < n_; ++i) {
    const double excitation = value_at(input_.excitation[i], start.time_s);
    const auto first = start.activation.empty() ? muscle::settled_activation(excitation) : start.activation[i];
    signals_.emplace_back(model_.muscles[i].activation, start.time_s, first);
    signals_.back().extend(input_.excitation[i], options_.end_s);
    const auto fiber = start.fiber.empty()
                           ? muscle::equilibrium_state(skeleton_.unit(i), {first.activation, skeleton_.length_m(i),
                                                                           skeleton_.velocity_mps(i)})
                           : start.fiber[i];
    if (size(i) > 0) start_[offsets_[i]] = fiber.fiber_length_m;
    if (size(i) > 1) start_[offsets_[i] + 1] = fiber.fiber_velocity_mps;
  }
}

std::size_t MovingModel::event_count() const { return n_ * muscle::kMusculotendonEventCount; }

muscle::MusculotendonState<double> MovingModel::fiber(std::size_t i, const double* y) const {
  const double* s = y + offsets_[i];
  return {size(i) > 0 ? s[0] : 0.0, size(i) > 1 ? s[1] : 0.0};
}

muscle::MusculotendonInput<double> MovingModel::input_of(std::size_t i) const {
  return {activation_[i], skeleton_.length_m(i), skeleton_.velocity_mps(i)};
}

double MovingModel::external(std::size_t k, double t) const {
  if (input_.external.empty()) return 0.0;
  const Signal& s = input_.external[k];
  return s.time_s.size() == 1 ? s.value[0] : value_at(s, t);
}

void MovingModel::set(double t, const double* y) {
  const double inside = clamped(t);
  for (std::size_t i = 0; i < n_; ++i) activation_[i] = signals_[i].at(inside, hints_[i]);
  skeleton_.set(y, y + nq_);
  for (std::size_t k = 0; k < nq_; ++k) {
    tau_[k] = external(k, inside);
    if (prescribed_[k] != 0) qddot_[k] = input_.device[k].acceleration(inside);
  }
}

void MovingModel::pull(std::size_t i, double tendon_force_n) {
  for (std::size_t k = 0; k < nq_; ++k) tau_[k] += skeleton_.moment_arm_m(i, k) * tendon_force_n;
}

void MovingModel::rate(double t, const double* y, double* ydot) {
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

void MovingModel::powers(double t, const double* y, double* p) {
  set(t, y);
  for (std::size_t i = 0; i < n_; ++i) {
    const auto o = muscle::musculotendon_output(skeleton_.unit(i), input_of(i), fiber(i, y));
    pull(i, o.tendon_force_n);
    double* w = p + SimulationRecord::kMuscleWorks * i;
    w[0] = o.power_w.active;
    w[1] = o.power_w.passive;
    w[2] = o.power_w.viscous;
    w[3] = o.power_w.tendon;
    w[4] = o.power_w.musculotendon;
    w[5] = o.power_w.kinetic;
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

void MovingModel::events(double t, const double* y, double* g) {
  set(t, y);
  for (std::size_t i = 0; i < n_; ++i) {
    const auto values = muscle::musculotendon_events(skeleton_.unit(i), input_of(i), fiber(i, y));
    std::copy(values.begin(), values.end(), g + i * values.size());
  }
}

SimulationRecord MovingModel::make_record(std::size_t rows) const {
  std::vector<std::string> muscles;
  for (const ModelMuscle& m : model_.muscles) muscles.push_back(m.name);
  std::vector<SimulationRecord::Coordinate> coordinates;
  for (const body::Coordinate& c : model_.body.coordinates)
    coordinates.push_back({c.name, c.motion != body::MotionType::translational});
  return {std::move(muscles), std::move(coordinates), rows, options_.energy};
}

void MovingModel::record(double t, const double* y, const double* work, Eigen::Index row, SimulationRecord& r) {
  set(t, y);
  const auto nq = static_cast<Eigen::Index>(nq_);
  for (Eigen::Index k = 0; k < nq; ++k) r.torque(row, 5 * k) = -tau_[static_cast<std::size_t>(k)];
  for (std::size_t i = 0; i < n_; ++i) {
    const auto c = static_cast<Eigen::Index>(i);
    const auto in = input_of(i);
    const auto o = muscle::musculotendon_output(skeleton_.unit(i), in, fiber(i, y));
    pull(i, o.tendon_force_n);
    r.excitation(row, c) = value_at(input_.excitation[i], t);
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
      r.energy(row, w) = o.energy_j.passive;
      r.energy(row, w + 1) = o.energy_j.tendon;
      r.energy(row, w + 2) = o.energy_j.kinetic;
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
    r.motion(row, 3 * c) = y[k];
    r.motion(row, 3 * c + 1) = y[nq_ + k];
    r.motion(row, 3 * c + 2) = qddot_[k];
  }
  if (works_ == 0) return;
  for (std::size_t k = 0; k < works_; ++k) r.energy(row, static_cast<Eigen::Index>(k)) = work[k];
  const auto w = static_cast<Eigen::Index>(works_) + 3 * static_cast<Eigen::Index>(n_);
  r.energy(row, w) = skeleton_.kinetic_energy_j();
  r.energy(row, w + 1) = skeleton_.gravity_energy_j();
  r.energy(row, w + 2) = skeleton_.joint_elastic_energy_j();
}

}  // namespace myoid::body
