#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/units.h"
#include "myoid/lab/virtual_person/performance.h"
#include "myoid/lab/virtual_person/raw_emg.h"

namespace myoid::lab {
namespace {

constexpr double kStep_s = 0.001;
constexpr int kStepsPerSample = 5;
/// Interval of the commands and of the stored samples.
constexpr double kSample_s = kStep_s * kStepsPerSample;
constexpr int kSamplesPerFatigue = 10;
constexpr double kBefore_s = 1.0;  ///< time at rest, held, before the trial begins
constexpr double kAfter_s = 0.2;
constexpr double kMotorNoiseCutoff_hz = 3.0;
/// Distance from the intended angle at which a movement has failed.
constexpr double kLost_rad = 0.6;
constexpr double kFeedback_radps = 6.0;  ///< natural frequency of the correction
constexpr double kDamping = 0.8;         ///< damping ratio of the correction
constexpr double kIntegral = 0.1;        ///< integral part of the correction
constexpr double kForceSense_s = 0.05;   ///< Time over which felt forces are averaged.

/// The plan of the person at one time.
struct Plan {
  Moment target;
  double torque_nm = 0.0;
  PerMuscle capacity_nm{};
};

Plan plan_at(const ArmStepper& stepper, const TrueArm& arm, const TrialScript& script, double t) {
  Plan plan{.target = script.motion(t)};
  const ArmStepper::Foresight foresight = stepper.foresee(plan.target);
  plan.torque_nm = foresight.torque_nm;
  for (std::size_t i = 0; i < kHeadCount; ++i)
    plan.capacity_nm[arm.heads[i].muscle] += arm.heads[i].drive * foresight.capacity_nm[i];
  return plan;
}

/// Returns the torque of the muscles minus the one that the person expects in this state [N m].
double surplus_nm(const ArmStepper& stepper) {
  const ArmState& state = stepper.state();
  const ArmStepper::Foresight foresight = stepper.foresee({state.q.value, state.q.first, 0.0});
  double foreseen_nm = foresight.passive_nm;
  for (std::size_t i = 0; i < kHeadCount; ++i) foreseen_nm += foresight.capacity_nm[i] * state.activation[i];
  return state.muscle_torque_nm - foreseen_nm;
}

/// Returns the mean of each muscle's heads, weighted by their strength.
PerMuscle mean_of_heads(const TrueArm& arm, const PerHead& values) {
  PerMuscle mean = {};
  PerMuscle strength = {};
  for (std::size_t i = 0; i < kHeadCount; ++i) {
    const double force_n = arm.heads[i].parameters.hill.max_isometric_force_n;
    mean[arm.heads[i].muscle] += force_n * values[i];
    strength[arm.heads[i].muscle] += force_n;
  }
  for (std::size_t m = 0; m < mean.size(); ++m) mean[m] /= strength[m];
  return mean;
}

/// Returns the unintended drive: a factor about 1 for each muscle, on the clock of the samples.
std::array<Eigen::VectorXd, 4> motor_noise_of(double sd, Eigen::Index count, std::uint64_t seed) {
  std::array<Eigen::VectorXd, 4> factor;
  math::Random random(seed);
  for (Eigen::VectorXd& f : factor) {
    const Eigen::VectorXd noise = lowpass_noise(kMotorNoiseCutoff_hz, 1.0 / kSample_s, count, random);
    f = (1.0 + sd * noise.array()).max(0.0).matrix();
  }
  return factor;
}

/// Chooses the muscles' activations: the ones foreseen for the movement, corrected by the seen and felt errors.
class Controller {
 public:
  Controller(const TrueArm& arm, const TrialScript& script, const ArmStepper& stepper)
      : arm_(arm),
        script_(script),
        stepper_(stepper),
        lead_s_(arm.delay_s + arm.activation.excitation_time_s + arm.activation.activation_time_s) {
    const double inertia_kgm2 = required_torque_nm(arm, 0.0, 1.0, script.protocol.plane, script.protocol.held_mass_kg);
    stiffness_ = inertia_kgm2 * kFeedback_radps * kFeedback_radps;
    viscosity_ = 2.0 * kDamping * inertia_kgm2 * kFeedback_radps;
  }

  /// Returns the command at time `t`. The first command knows no error yet.
  PerMuscle command(double t, bool first) {
    return script_.against_dynamometer() ? script_.prescribed_activations(t) : corrected(t, first);
  }

 private:
  PerMuscle corrected(double t, bool first) {
    // A command acts a little later, so the plan is that of the later time.
    const Plan later = plan_at(stepper_, arm_, script_, t + lead_s_);
    const Moment wanted = script_.motion(t);
    const Moment& is = stepper_.state().q;
    const double off_rad = wanted.value - is.value;
    double correction_nm = 0.0;
    if (!first) {
      held_nm_ += kIntegral * stiffness_ * kFeedback_radps * off_rad * kSample_s;
      felt_nm_ += kSample_s / kForceSense_s * (surplus_nm(stepper_) - felt_nm_);
      correction_nm = stiffness_ * off_rad + viscosity_ * (wanted.first - is.first) + held_nm_ - felt_nm_;
    }
    return activations_for(later.torque_nm + correction_nm, later.capacity_nm, script_.coordination(t));
  }

  const TrueArm& arm_;
  const TrialScript& script_;
  const ArmStepper& stepper_;
  double lead_s_;
  double stiffness_ = 0.0, viscosity_ = 0.0;
  double held_nm_ = 0.0;  ///< The integral part.
  double felt_nm_ = 0.0;  ///< Torque of the muscles beyond the foreseen torque.
};

PerHead excitation_of(const TrueArm& arm, const PerMuscle& command) {
  PerHead u;
  for (std::size_t i = 0; i < kHeadCount; ++i)
    u[i] = std::clamp(command[arm.heads[i].muscle] * arm.heads[i].drive, 0.0, 1.0);
  return u;
}

PerMuscle electrode_of(const TrueArm& arm, const PerMuscle& command) {
  PerMuscle power = {};
  const PerHead u = excitation_of(arm, command);
  for (std::size_t i = 0; i < kHeadCount; ++i) power[arm.heads[i].muscle] += arm.heads[i].electrode_share * u[i] * u[i];
  for (double& p : power) p = std::sqrt(p);
  return power;
}

/// Returns the reason why a movement has failed in this state; empty if it has not failed.
std::string failure_of(const ArmState& state, const TrialScript& script, double t) {
  const double off_rad = state.q.value - script.motion(t).value;
  if (!(std::abs(off_rad) < kLost_rad)) return fmt::format("the arm got out of hand at {:.2f} s", t);
  if (*std::max_element(state.activation.begin(), state.activation.end()) > kGreatestActivation)
    return fmt::format("an activation rose above {} at {:.2f} s", kGreatestActivation, t);
  return "";
}

}  // namespace

double foreseen_activation(const TrueArm& arm, const TrialScript& script) {
  constexpr double kLook_s = 0.02;
  if (script.against_dynamometer()) return 0.0;
  ArmStepper stepper(arm, kStep_s);
  stepper.start({script.protocol.plane, script.protocol.held_mass_kg}, script.motion.start_rad, {});
  double greatest = 0.0;
  for (double t = 0.0; t <= script.duration_s; t += kLook_s) {
    const Plan plan = plan_at(stepper, arm, script, t);
    const PerMuscle a = activations_for(plan.torque_nm, plan.capacity_nm, script.coordination(t));
    greatest = std::max(greatest, *std::max_element(a.begin(), a.end()));
  }
  return greatest;
}

SimulatedPerformance::SimulatedPerformance(
    const TrueArm& arm, TrialScript script, double motor_noise, Tiredness<7>& tiredness, std::uint64_t seed)
    : Performance(std::move(script)), arm_(&arm) {
  simulate(motor_noise, tiredness, seed);
}

PerMuscle SimulatedPerformance::delayed_command(double t) const {
  return interpolated(commands_, kSample_s, t - arm_->delay_s + kBefore_s);
}

void SimulatedPerformance::step_to_sample(std::size_t k, ArmStepper& stepper) const {
  for (int j = 1; j <= kStepsPerSample; ++j) {
    const double now = samples_[k - 1].time_s + j * kStep_s;
    const PerHead u = excitation_of(*arm_, delayed_command(now));
    if (script().against_dynamometer()) {
      stepper.step_moved(u, script().motion(now));
    } else {
      stepper.step_free(u);
    }
  }
}

void SimulatedPerformance::tire(std::size_t k, PerHead& worked, Tiredness<7>& tiredness, ArmStepper& stepper) {
  if (!tiredness.rates || samples_[k].time_s < 0.0) return;
  for (std::size_t i = 0; i < kHeadCount; ++i) worked[i] += samples_[k].arm.activation[i] / kSamplesPerFatigue;
  if (k % kSamplesPerFatigue != 0) return;
  PerHead fatigued;
  for (std::size_t i = 0; i < kHeadCount; ++i) fatigued[i] = tiredness.state[i].fatigued;
  fatigued_.push_back(mean_of_heads(*arm_, fatigued));
  tiredness.work(worked, kSamplesPerFatigue * kSample_s);
  worked = {};
  stepper.set_strength(tiredness.strength());
}

void SimulatedPerformance::simulate(double motor_noise, Tiredness<7>& tiredness, std::uint64_t seed) {
  const TrialScript& script = this->script();
  const Surroundings surroundings{script.protocol.plane, script.protocol.held_mass_kg};
  ArmStepper stepper(*arm_, kStep_s);
  stepper.set_strength(tiredness.strength());
  const auto count = static_cast<std::size_t>(std::ceil((kBefore_s + script.duration_s + kAfter_s) / kSample_s)) + 1;
  const std::array<Eigen::VectorXd, 4> noise = motor_noise_of(motor_noise, static_cast<Eigen::Index>(count), seed);
  Controller controller(*arm_, script, stepper);
  const auto command = [&](double t, std::size_t k) {
    PerMuscle& u = commands_.emplace_back(controller.command(t, k == 0));
    // Limits the excitation to 0..1; failure_of() finds a movement that needs more.
    for (std::size_t m = 0; m < 4; ++m) u[m] = std::clamp(u[m] * noise[m](static_cast<Eigen::Index>(k)), 0.0, 1.0);
  };

  samples_.reserve(count);
  PerHead worked = {};
  for (std::size_t k = 0; k < count; ++k) {
    const double t = static_cast<double>(k) * kSample_s - kBefore_s;
    if (k == 0) {
      stepper.start(surroundings, script.motion(t).value, {});
      command(t, k);
      stepper.start(surroundings, script.motion(t).value, excitation_of(*arm_, commands_.front()));
    } else {
      step_to_sample(k, stepper);
      command(t, k);
    }
    samples_.push_back({.time_s = t,
                        .arm = stepper.state(),
                        .excitation = excitation_of(*arm_, delayed_command(t)),
                        .electrode = electrode_of(*arm_, commands_.back())});
    tire(k, worked, tiredness, stepper);
    if (!script.against_dynamometer()) failure_ = failure_of(samples_.back().arm, script, t);
    if (!failure_.empty()) return;
  }
}

SimulatedPerformance::Place SimulatedPerformance::place(double time_s) const {
  const double s = std::clamp((time_s + kBefore_s) / kSample_s, 0.0, static_cast<double>(samples_.size() - 1));
  const std::size_t before = std::min(static_cast<std::size_t>(s), samples_.size() - 2);
  double share = s - static_cast<double>(before);
  // Round-off does not move times on the grid off their samples.
  if (share < 1e-9) share = 0.0;
  if (share > 1.0 - 1e-9) share = 1.0;
  return {before, share};
}

Moment SimulatedPerformance::motion(double time_s) const {
  const Place at = place(time_s);
  const Moment& a = samples_[at.before].arm.q;
  const Moment& b = samples_[at.before + 1].arm.q;
  if (at.share == 0.0) return a;
  if (at.share == 1.0) return b;
  // The quintic with value, speed and acceleration of both ends.
  const double h = kSample_s;
  const double x = at.share;
  const double rise = b.value - a.value - h * (a.first + 0.5 * h * a.second);
  const double slope = h * (b.first - a.first - h * a.second);
  const double bend = h * h * (b.second - a.second);
  const double c3 = 10.0 * rise - 4.0 * slope + 0.5 * bend;
  const double c4 = -15.0 * rise + 7.0 * slope - bend;
  const double c5 = 6.0 * rise - 3.0 * slope + 0.5 * bend;
  const double x2 = x * x;
  return {a.value + h * x * (a.first + 0.5 * h * x * a.second) + x2 * x * (c3 + x * (c4 + x * c5)),
          a.first + h * x * a.second + x2 * (3.0 * c3 + x * (4.0 * c4 + x * 5.0 * c5)) / h,
          a.second + x * (6.0 * c3 + x * (12.0 * c4 + x * 20.0 * c5)) / (h * h)};
}

std::optional<ArmState> SimulatedPerformance::heads(double time_s) const {
  const Place at = place(time_s);
  const ArmState& a = samples_[at.before].arm;
  const ArmState& b = samples_[at.before + 1].arm;
  if (at.share == 0.0) return a;
  if (at.share == 1.0) return b;
  ArmState now;
  now.q = motion(time_s);
  now.activation = lerp(a.activation, b.activation, at.share);
  now.fiber_length_m = lerp(a.fiber_length_m, b.fiber_length_m, at.share);
  now.fiber_velocity_mps = lerp(a.fiber_velocity_mps, b.fiber_velocity_mps, at.share);
  now.tendon_force_n = lerp(a.tendon_force_n, b.tendon_force_n, at.share);
  now.muscle_torque_nm = std::lerp(a.muscle_torque_nm, b.muscle_torque_nm, at.share);
  now.passive_torque_nm = std::lerp(a.passive_torque_nm, b.passive_torque_nm, at.share);
  return now;
}

Instant SimulatedPerformance::at(double time_s) const {
  const ArmState now = *heads(time_s);
  Instant result;
  result.q = now.q;
  result.activation = mean_of_heads(*arm_, now.activation);
  result.fiber_length_m = mean_of_heads(*arm_, now.fiber_length_m);
  for (std::size_t i = 0; i < kHeadCount; ++i) result.force_n[arm_->heads[i].muscle] += now.tendon_force_n[i];
  result.muscle_torque_nm = now.muscle_torque_nm;
  result.passive_torque_nm = now.passive_torque_nm;
  if (script().against_dynamometer()) {
    result.external_torque_nm =
        required_torque_nm(*arm_, now.q.value, now.q.second, script().protocol.plane, script().protocol.held_mass_kg) -
        now.muscle_torque_nm - now.passive_torque_nm;
  }
  return result;
}

PerMuscle SimulatedPerformance::fatigued(double time_s) const {
  if (fatigued_.empty()) return {};
  return interpolated(fatigued_, kSamplesPerFatigue * kSample_s, time_s);
}

PerMuscle SimulatedPerformance::drive(double time_s) const {
  const Place at = place(time_s);
  return lerp(samples_[at.before].electrode, samples_[at.before + 1].electrode, at.share);
}

}  // namespace myoid::lab
