#include "myoid/lab/virtual_person/arm_stepper.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::lab {
namespace {

using muscle::CurvePoint;

constexpr int kIntervals = 600;
constexpr int kMostIterations = 60;
/// Relative tolerance of a fiber's length, over the optimal length; the tendon's force is then
/// exact to about 1e-9 of F_max.
constexpr double kLengthTolerance = 1e-12;

/// Tabulates the tendon from slack to twice the strain at F_max. The slope at slack is the
/// right-hand one, because De Groote's curve has a corner there.
CurveTable tabulated_tendon(const muscle::NormalizedCurves<double>& curves, double strain_at_max_force) {
  return {[&](double e) -> CurvePoint<double> {
            if (e > 0.0) return curves.tendon(e);
            return {0.0, curves.tendon(std::numeric_limits<double>::min()).slope};
          },
          0.0, 2.0 * strain_at_max_force, kIntervals};
}

}  // namespace

ArmStepper::ArmStepper(const TrueArm& arm, double step_s) : arm_(&arm), step_s_(step_s) {
  if (!(step_s > 0.0)) throw InvalidInput(fmt::format("steps of {} s lead nowhere", step_s));
  lag_ = -std::expm1(-step_s / arm.activation.excitation_time_s);
  lag_up_ = -std::expm1(-step_s / arm.activation.activation_time_s);
  lag_down_ = -std::expm1(-step_s / arm.activation.deactivation_time_s);
  strength_.fill(1.0);
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    const muscle::MusculotendonParameters<double>& p = arm.heads[i].parameters;
    const muscle::Musculotendon<double> unit(p, arm.laws, arm.millard);
    const muscle::NormalizedCurves<double>& curves = unit.curves();
    laws_[i] = {.length = {[&](double l) { return curves.length(l); }, 0.3, 2.1, kIntervals},
                .velocity = {[&](double v) { return curves.velocity({1.0}, v); }, -1.2, 1.2, 2 * kIntervals},
                .passive = {[&](double l) { return curves.passive(l); }, 0.2, 2.0, kIntervals},
                .tendon = tabulated_tendon(curves, p.tendon_strain),
                .height_m = unit.height_m(),
                .shortest_m = unit.shortest_fiber_m()};
  }
}

ArmStepper::FiberBalance ArmStepper::balance(
    std::size_t i, double path_m, double length_m, double velocity_mps, double velocity_slope) const {
  const muscle::MusculotendonParameters<double>& p = arm_->heads[i].parameters;
  const HeadLaws& laws = laws_[i];
  const double per_l0 = 1.0 / p.hill.optimal_fiber_length_m;
  const double per_speed = 1.0 / p.hill.max_shortening_speed_mps;
  const double a = state_.activation[i] * strength_[i];

  const double along_m = std::sqrt(length_m * length_m - laws.height_m * laws.height_m);
  const double cosine = along_m / length_m;
  const double per_slack = 1.0 / p.hill.tendon_slack_length_m;
  const double strain = (path_m - along_m) * per_slack - 1.0;
  const CurvePoint<double> tendon = strain > 0.0 ? laws.tendon(strain) : CurvePoint<double>{0.0, 0.0};

  const double shorter = per_l0 / (1.0 + p.optimal_length_shift * (1.0 - a));
  const CurvePoint<double> f_l = laws.length(length_m * shorter);
  const CurvePoint<double> f_v = laws.velocity(velocity_mps * per_speed);
  const CurvePoint<double> f_pe = laws.passive(length_m * per_l0);
  const double fiber = a * f_l.value * f_v.value + f_pe.value + p.damping * velocity_mps * per_speed;
  const double fiber_slope =
      a * (f_l.slope * shorter * f_v.value + f_l.value * f_v.slope * velocity_slope * per_speed) + f_pe.slope * per_l0 +
      p.damping * velocity_slope * per_speed;
  const double cosine_slope = laws.height_m * laws.height_m / (along_m * length_m * length_m);
  const double f_max = p.hill.max_isometric_force_n;
  return {.mismatch_n = f_max * (tendon.value - fiber * cosine),
          .slope_npm = f_max * (-tendon.slope * per_slack / cosine - fiber_slope * cosine - fiber * cosine_slope),
          .tendon_n = f_max * tendon.value};
}

double ArmStepper::balanced_length_m(
    std::size_t i, double path_m, double guess_m, double velocity_offset_mps, double velocity_slope) const {
  // The mismatch falls with the length: Newton's steps, halving the bracket where they leave it.
  const double l0_m = arm_->heads[i].parameters.hill.optimal_fiber_length_m;
  double lower_m = laws_[i].shortest_m;
  double upper_m = std::max(path_m, lower_m) + laws_[i].height_m;
  double length_m = std::clamp(guess_m, lower_m, upper_m);
  for (int k = 0; k < kMostIterations; ++k) {
    const FiberBalance now =
        balance(i, path_m, length_m, velocity_offset_mps + velocity_slope * length_m, velocity_slope);
    (now.mismatch_n > 0.0 ? lower_m : upper_m) = length_m;
    double next_m = length_m - now.mismatch_n / now.slope_npm;
    if (!(next_m > lower_m && next_m < upper_m)) {
      if (std::abs(next_m - length_m) <= kLengthTolerance * l0_m) return length_m;
      next_m = 0.5 * (lower_m + upper_m);
    }
    const double step_m = next_m - length_m;
    length_m = next_m;
    // Newton's error after a step is about the square of the step, over l0.
    if (std::abs(step_m) <= 1e-7 * l0_m && k > 0) return length_m;
  }
  return length_m;
}

void ArmStepper::start(const Surroundings& surroundings, double elbow_flexion_rad, const PerHead& excitation) {
  surroundings_ = surroundings;
  state_ = {};
  state_.q = {elbow_flexion_rad, 0.0, 0.0};
  filtered_ = excitation;
  state_.activation = excitation;
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    const double path_m = body::travel(arm_->heads[i].path, elbow_flexion_rad).length_m;
    const double slack_m = arm_->heads[i].parameters.hill.tendon_slack_length_m;
    state_.fiber_length_m[i] = balanced_length_m(i, path_m, path_m - slack_m, 0.0, 0.0);
  }
  before_m_ = state_.fiber_length_m;
  advance_fibers();
}

void ArmStepper::advance_activation(const PerHead& excitation) {
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    double& e = filtered_[i];
    double& a = state_.activation[i];
    e += lag_ * (excitation[i] - e);
    a += (e >= a ? lag_up_ : lag_down_) * (e - a);
  }
}

void ArmStepper::advance_fibers() {
  const double q_rad = state_.q.value;
  state_.muscle_torque_nm = 0.0;
  const double rate = 1.5 / step_s_;
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    const body::MuscleTravel path = body::travel(arm_->heads[i].path, q_rad);
    const double last_m = state_.fiber_length_m[i];
    const double offset_mps = (before_m_[i] - 4.0 * last_m) / (2.0 * step_s_);
    const double length_m = balanced_length_m(i, path.length_m, 2.0 * last_m - before_m_[i], offset_mps, rate);
    const double velocity_mps = offset_mps + rate * length_m;
    state_.tendon_force_n[i] = balance(i, path.length_m, length_m, velocity_mps, rate).tendon_n;
    state_.fiber_velocity_mps[i] = velocity_mps;
    before_m_[i] = last_m;
    state_.fiber_length_m[i] = length_m;
    state_.muscle_torque_nm += path.moment_arm_m * state_.tendon_force_n[i];
  }
}

void ArmStepper::step_free(const PerHead& excitation) {
  const double h = step_s_;
  Moment& q = state_.q;
  const double half_radps = q.first + 0.5 * h * q.second;
  q.value += h * half_radps;
  advance_activation(excitation);
  advance_fibers();
  // The joint's viscosity acts on the velocity at the end of the step, which is linear in the acceleration there.
  const double elastic_nm = joint_passive(arm_->joint, q.value, 0.0).torque_nm;
  const double gravity_nm = required_torque_nm(*arm_, q.value, 0.0, surroundings_.plane, surroundings_.held_mass_kg);
  const double inertia_kgm2 = required_torque_nm(*arm_, 0.0, 1.0, surroundings_.plane, surroundings_.held_mass_kg);
  const double b = arm_->joint.viscosity_nms_per_rad;
  q.second = (state_.muscle_torque_nm + elastic_nm - gravity_nm - b * half_radps) / (inertia_kgm2 + 0.5 * h * b);
  q.first = half_radps + 0.5 * h * q.second;
  state_.passive_torque_nm = elastic_nm - b * q.first;
}

void ArmStepper::step_moved(const PerHead& excitation, const Moment& q) {
  state_.q = q;
  advance_activation(excitation);
  advance_fibers();
  state_.passive_torque_nm = joint_passive(arm_->joint, q.value, q.first).torque_nm;
}

ArmStepper::Foresight ArmStepper::foresee(const Moment& q) const {
  constexpr double kStretch = 0.25;  // of the strain at F_max: a tenth of it, with the toe
  constexpr double kActivation = 0.2;
  constexpr double kLeastSpeedFactor = 0.05;
  Foresight result;
  result.torque_nm = required_torque_nm(*arm_, q.value, q.second, surroundings_.plane, surroundings_.held_mass_kg) -
                     joint_passive(arm_->joint, q.value, q.first).torque_nm;
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    const TrueHead& head = arm_->heads[i];
    const muscle::MusculotendonParameters<double>& p = head.parameters;
    const body::MuscleTravel path = body::travel(head.path, q.value);
    const double along_m = std::max(laws_[i].shortest_m,
                                    path.length_m - p.hill.tendon_slack_length_m * (1.0 + kStretch * p.tendon_strain));
    const double length_m = std::hypot(along_m, laws_[i].height_m);
    const double cosine = along_m / length_m;
    const double speed = -path.moment_arm_m * q.first * cosine / p.hill.max_shortening_speed_mps;
    const double optimum_m = p.hill.optimal_fiber_length_m * (1.0 + p.optimal_length_shift * (1.0 - kActivation));
    const double lever_nm = path.moment_arm_m * cosine * p.hill.max_isometric_force_n;
    result.capacity_nm[i] = lever_nm * strength_[i] * laws_[i].length(length_m / optimum_m).value *
                            std::max(kLeastSpeedFactor, laws_[i].velocity(speed).value);
    result.passive_nm +=
        lever_nm * (laws_[i].passive(length_m / p.hill.optimal_fiber_length_m).value + p.damping * speed);
  }
  result.torque_nm -= result.passive_nm;
  return result;
}

}  // namespace myoid::lab
