#include "myoid/lab/virtual_person/performance.h"

#include <algorithm>
#include <cmath>

namespace myoid::lab {

constexpr double kFatigueStep_s = 0.05;

PerMuscle interpolated(const std::vector<PerMuscle>& values, double step_s, double time_s) {
  const double s = std::clamp(time_s / step_s, 0.0, static_cast<double>(values.size() - 1));
  const std::size_t before = std::min(static_cast<std::size_t>(s), values.size() - 1);
  const std::size_t after = std::min(before + 1, values.size() - 1);
  return lerp(values[before], values[after], s - static_cast<double>(before));
}

ExactPerformance::ExactPerformance(const VirtualArm& arm,
                                   const HillSet& muscles,
                                   TrialScript script,
                                   double delay_s,
                                   Tiredness<4>& tiredness,
                                   const BesideMuscles& beside,
                                   const Departures& departures)
    : Performance(std::move(script)),
      arm_(&arm),
      muscles_(&muscles),
      beside_(beside),
      body_(departures, arm, muscles),
      elastic_(departures.elastic()),
      delay_s_(delay_s) {
  if (!tiredness.rates) return;
  const auto count = static_cast<std::size_t>(std::ceil(this->script().duration_s / kFatigueStep_s)) + 1;
  strength_.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    strength_.push_back(tiredness.strength());
    tiredness.work(at(static_cast<double>(k) * kFatigueStep_s).activation, kFatigueStep_s);
  }
}

PerMuscle ExactPerformance::strength(double time_s) const {
  if (strength_.empty()) return {1.0, 1.0, 1.0, 1.0};
  return interpolated(strength_, kFatigueStep_s, time_s);
}

PerMuscle ExactPerformance::fatigued(double time_s) const {
  PerMuscle share = strength(time_s);
  for (double& value : share) value = 1.0 - value;
  return share;
}

Instant ExactPerformance::at(double time_s) const {
  const TrialScript& script = this->script();
  Instant now;
  now.q = script.motion(time_s);
  const MuscleGeometry geometry = body_.geometry(now.q);
  const PerMuscle left = strength(time_s);
  now.passive_torque_nm = beside_.joint_torque_nm - beside_.joint_stiffness_nm_per_rad * now.q.value -
                          beside_.joint_viscosity_nms_per_rad * now.q.first;
  const double required_nm =
      required_torque_nm(arm_->elbow, now.q.value, now.q.second, script.protocol.plane, script.protocol.held_mass_kg) -
      now.passive_torque_nm;
  const bool prescribed = script.against_dynamometer();
  if (prescribed) now.activation = script.prescribed_activations(time_s);
  // The force per activation depends a little on the activation (its shift of the optimum) and on
  // the force (the tendon's stretch). Iterates until all agree. Half steps make the iteration
  // converge even if a stretch changes the force by more than the force changed.
  constexpr int kMostTurns = 200;
  const bool at_once = !elastic_ && (prescribed || beside_.length_activation == 0.0);
  PerMuscle longer{}, full_n{}, capacity_nm{}, tension_n{};
  for (int turn = 0; turn < (at_once ? 1 : kMostTurns); ++turn) {
    const PerMuscle before = now.activation;
    for (std::size_t i = 0; i < 4; ++i) longer[i] = 1.0 + beside_.length_activation * (1.0 - now.activation[i]);
    full_n = body_.full_force_n(geometry, longer, tension_n);
    for (std::size_t i = 0; i < 4; ++i) {
      full_n[i] *= left[i];
      capacity_nm[i] = full_n[i] * geometry.moment_arm_m[i];
    }
    if (!prescribed) now.activation = activations_for(required_nm, capacity_nm, script.coordination(time_s));
    double change = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
      change = std::max(change, std::abs(now.activation[i] - before[i]));
      if (!elastic_) continue;
      const double step_n = now.activation[i] * full_n[i] - tension_n[i];
      tension_n[i] += 0.5 * step_n;
      change = std::max(change, std::abs(step_n) / (*muscles_)[i].max_isometric_force_n);
    }
    if (change < 1e-10) break;
  }
  for (std::size_t i = 0; i < 4; ++i) {
    now.force_n[i] = now.activation[i] * full_n[i];
    now.fiber_length_m[i] = body_.fiber_length_m(i, geometry.length_m[i], now.force_n[i]);
    now.muscle_torque_nm += now.activation[i] * capacity_nm[i];
  }
  if (prescribed) now.external_torque_nm = required_nm - now.muscle_torque_nm;
  return now;
}

PerMuscle ExactPerformance::drive(double time_s) const {
  // The electrode shows the activation that the muscle has a delay later.
  return at(time_s + delay_s_).activation;
}

std::string ExactPerformance::failure() const {
  constexpr double kRate_hz = 100.0;
  if (script().against_dynamometer()) return "";
  for (double t = 0.0; t <= script().duration_s; t += 1.0 / kRate_hz) {
    const PerMuscle a = at(t).activation;
    if (*std::max_element(a.begin(), a.end()) > kGreatestActivation) return std::string(kTooWeak);
  }
  return "";
}

}  // namespace myoid::lab
