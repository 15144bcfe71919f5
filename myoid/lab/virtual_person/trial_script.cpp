#include "myoid/lab/virtual_person/trial_script.h"

#include <algorithm>
#include <cmath>

#include "myoid/ground/core/units.h"
#include "myoid/ground/math/random.h"

namespace myoid::lab {
namespace {

constexpr double kMarginOfFlexion_s = 0.5;  ///< time at rest before and after

/// Adds a movement of an uneven person: several overlapping submovements.
void add_uneven_move(double start_s, double duration_s, double by_rad, SmoothMotion& motion, math::Random& random) {
  constexpr double kOne_s = 0.9;  // duration of each submovement
  const int count = std::max(1, static_cast<int>(std::lround(duration_s / kOne_s)));
  std::vector<double> share;
  double sum = 0.0;
  for (int i = 0; i < count; ++i) sum += share.emplace_back(random.uniform(0.7, 1.3));
  const double apart_s = duration_s / (count + 1);
  for (int i = 0; i < count; ++i)
    motion.moves.push_back({start_s + i * apart_s, 2.0 * apart_s, by_rad * share[static_cast<std::size_t>(i)] / sum});
}

/// Raises and lowers (eccentric, passive), or moves there and back.
void add_lifts(TrialScript& script, double irregularity, math::Random& random) {
  constexpr double kTimeSd = 0.10;
  constexpr double kReachSd_rad = 2.0 * kDegree;
  constexpr double kMost = 2.0;  // standard deviations
  const TrialProtocol& p = script.protocol;
  SmoothMotion& motion = script.motion;
  const bool even = irregularity == 0.0 || p.kind == TrialKind::passive;
  const auto around = [&](double sd) {
    return even ? 0.0 : sd * irregularity * std::clamp(random.normal(), -kMost, kMost);
  };
  const auto lasting_s = [&](double usual_s) { return usual_s * std::exp(around(kTimeSd)); };
  const auto move = [&](double start_s, double duration_s, double by_rad) {
    if (even) {
      motion.moves.push_back({start_s, duration_s, by_rad});
    } else {
      add_uneven_move(start_s, duration_s, by_rad, motion, random);
    }
  };
  double time_s = 0.0;
  double at_rad = p.lift.from_rad;
  const auto go_to = [&](double usual_rad, double usual_s) {
    time_s += lasting_s(p.rest_s);
    const double duration_s = lasting_s(usual_s);
    const double to_rad = std::clamp(usual_rad + around(kReachSd_rad), std::min(usual_rad, 5.0 * kDegree),
                                     std::max(usual_rad, 140.0 * kDegree));
    move(time_s, duration_s, to_rad - at_rad);
    at_rad = to_rad;
    time_s += duration_s;
  };
  for (int k = 0; k < p.repetitions; ++k) {
    go_to(p.lift.to_rad, p.lift.raise_s);
    go_to(p.lift.from_rad, p.lift.lower_s);
  }
  motion.start_rad = p.lift.from_rad;
  script.duration_s = time_s + p.rest_s;
}

void add_oscillation(TrialScript& script, math::Random& random) {
  const TrialProtocol& p = script.protocol;
  SmoothMotion& motion = script.motion;
  motion.start_rad = p.cycles.centre_rad - p.cycles.amplitude_rad;
  motion.amplitude_rad = p.cycles.amplitude_rad;
  motion.oscillation_start_s = kMarginOfFlexion_s;
  motion.frequency_hz = p.cycles.frequency_hz;
  motion.pace_s = std::max(0.6, 0.5 / p.cycles.frequency_hz);
  motion.cycles = std::max(
      1, static_cast<int>(std::floor(
             (p.cycles.duration_s - 2.0 * kMarginOfFlexion_s - motion.pace_s) * p.cycles.frequency_hz + 1e-9)));
  motion.amplitude_variation = p.cycles.variation;
  motion.variation_hz = 0.37 * p.cycles.frequency_hz;
  motion.variation_phase_rad = random.uniform(0.0, 2.0 * kPi);
  script.duration_s = std::max(p.cycles.duration_s, motion.end_s() + kMarginOfFlexion_s);
}

/// Draws the other differences from cycle to cycle.
void make_uneven(TrialScript& script, double irregularity, math::Random& random) {
  const TrialProtocol& p = script.protocol;
  script.eased = true;
  const double phase_rad = random.uniform(0.0, 2.0 * kPi);
  const double wander_rad = random.uniform(0.0, 2.0 * kPi);
  if (p.kind == TrialKind::flexion) {
    script.motion.wander_rad = 0.25 * irregularity;
    script.motion.wander_hz = 0.23 * p.cycles.frequency_hz;
    script.motion.wander_phase_rad = wander_rad;
  }
  const double cycle_s =
      p.kind == TrialKind::flexion ? 1.0 / p.cycles.frequency_hz : p.lift.raise_s + p.lift.lower_s + 2.0 * p.rest_s;
  if (p.kind == TrialKind::flexion || p.kind == TrialKind::eccentric) {
    script.co_contraction_change = {
        .depth = std::min(0.9, 0.9 * irregularity), .frequency_hz = 1.0 / cycle_s, .phase_rad = phase_rad};
  }
}

/// Returns flexor proportions that move around a circle from effort to effort, so that each leads in turn.
Coordination lead(const ControlSpec& control, double first_rad, int k, int count) {
  const double angle_rad = first_rad + 2.0 * kPi * k / std::max(count, 3);
  return {.brachioradialis = control.synergy * std::sqrt(2.0) * std::cos(angle_rad),
          .brachialis = control.brachialis_synergy * std::sqrt(2.0) * std::sin(angle_rad)};
}

/// Adds effort at the angle where the sweep begins, the sweep, and rest; between sweeps that do not
/// follow each other the relaxed arm is moved back.
void add_sweeps(TrialScript& script, const ControlSpec& control, math::Random& random) {
  const TrialProtocol& p = script.protocol;
  constexpr double kReturn_s = 2.0;
  constexpr double kMargin_s = 0.1;
  SmoothMotion& motion = script.motion;
  motion.start_rad = p.lift.from_rad;
  const double first_rad = random.uniform(0.0, 2.0 * kPi);
  const double range_rad = p.lift.to_rad - p.lift.from_rad;
  bool low = true;
  double time_s = 0.0;
  const auto sweep = [&](bool flexion, bool upwards, int k) {
    if (low != upwards) {
      motion.moves.push_back({time_s + p.rest_s, kReturn_s, low ? range_rad : -range_rad});
      time_s += p.rest_s + kReturn_s;
      low = !low;
    }
    const double travel_s = range_rad / p.speed_radps;
    const Sweep way{.start_s = time_s + p.rest_s + p.rise_s + kMargin_s,
                    .by_rad = upwards ? range_rad : -range_rad,
                    .speed_radps = p.speed_radps,
                    .pace_s = std::min(0.15, 0.4 * travel_s)};
    motion.sweeps.push_back(way);
    Effort effort{.start_s = time_s + p.rest_s,
                  .rise_s = p.rise_s,
                  .hold_s = way.end_s() + kMargin_s - (time_s + p.rest_s + p.rise_s),
                  .flexion = flexion};
    if (flexion) effort.coordination = lead(control, first_rad, k, p.repetitions);
    script.efforts.push_back(effort);
    time_s = effort.end_s();
    low = !low;
  };
  for (int k = 0; k < p.repetitions; ++k) {
    if (p.direction != Direction::extension) {
      if (p.concentric) sweep(true, true, k);
      if (p.eccentric) sweep(true, false, k);
    }
    if (p.direction != Direction::flexion) {
      if (p.eccentric) sweep(false, true, k);
      if (p.concentric) sweep(false, false, k);
    }
  }
  script.duration_s = time_s + p.rest_s;
}

void add_efforts(TrialScript& script, const ControlSpec& control, math::Random& random) {
  const TrialProtocol& p = script.protocol;
  script.motion.start_rad = p.angle_rad;
  const double first_rad = random.uniform(0.0, 2.0 * kPi);
  double time_s = 0.0;
  for (int k = 0; k < p.repetitions; ++k) {
    for (const bool flexion : {true, false}) {
      if (p.direction == (flexion ? Direction::extension : Direction::flexion)) continue;
      Effort effort{.start_s = time_s + p.rest_s, .rise_s = p.rise_s, .hold_s = p.hold_s, .flexion = flexion};
      // At the greatest effort every muscle is fully active.
      if (p.kind != TrialKind::mvc && flexion) effort.coordination = lead(control, first_rad, k, p.repetitions);
      script.efforts.push_back(effort);
      time_s = effort.end_s();
    }
  }
  script.duration_s = time_s + p.rest_s;
}

}  // namespace

double Effort::level(double time_s) const {
  return smooth_step(time_s, start_s, rise_s).value - smooth_step(time_s, start_s + rise_s + hold_s, rise_s).value;
}

double Modulation::operator()(double time_s) const {
  return 1.0 + depth * std::cos(2.0 * kPi * frequency_hz * time_s + phase_rad);
}

double TrialScript::cold(double time_s) const {
  if (!(protocol.warm_up_s > 0.0)) return 0.0;
  return std::exp(-3.0 * std::max(0.0, time_s) / protocol.warm_up_s);
}

double TrialScript::emg_gain(double time_s) const {
  return std::lerp(emg_gain_first, emg_gain_last, std::clamp(time_s / duration_s, 0.0, 1.0));
}

Coordination TrialScript::coordination(double time_s) const {
  return {.brachioradialis = mean.brachioradialis + brachioradialis_change(time_s) - 1.0,
          .brachialis = mean.brachialis + brachialis_change(time_s) - 1.0,
          .co_contraction = mean.co_contraction * co_contraction_change(time_s) * (1.0 + cold(time_s)),
          .eased = eased};
}

PerMuscle TrialScript::prescribed_activations(double time_s) const {
  PerMuscle a = {0.0, 0.0, 0.0, 0.0};
  for (const Effort& effort : efforts) {
    const double level = effort.level(time_s);
    if (level == 0.0) continue;
    const double agonist = protocol.peak * level;
    const double antagonist = mean.co_contraction * co_contraction_change(time_s) * level;
    const PerMuscle share = weights(effort.coordination);
    const double largest = std::max({share[kBiceps], share[kBrachialis], share[kBrachioradialis]});
    for (const std::size_t i : {kBiceps, kBrachialis, kBrachioradialis}) {
      a[i] += share[i] / largest * (effort.flexion ? agonist : antagonist);
    }
    a[kTriceps] += effort.flexion ? antagonist : agonist;
  }
  for (std::size_t i = 0; protocol.kind == TrialKind::mvc && i < a.size(); ++i) a[i] *= mvc_effort[i];
  return a;
}

bool TrialScript::against_dynamometer() const {
  return protocol.kind == TrialKind::isometric_ramp || protocol.kind == TrialKind::mvc ||
         protocol.kind == TrialKind::isokinetic || protocol.kind == TrialKind::passive;
}

TrialScript make_script(const TrialProtocol& trial, const ControlSpec& control, std::uint64_t seed) {
  math::Random random(math::seed_for(seed, "script." + trial.name));
  TrialScript script;
  script.protocol = trial;
  math::Random uneven(math::seed_for(seed, "uneven." + trial.name));
  const Range co_contraction = trial.co_contraction.value_or(control.co_contraction);
  script.mean.co_contraction = random.uniform(co_contraction.lower, co_contraction.upper);
  script.co_contraction_change = {
      .depth = 0.5, .frequency_hz = random.uniform(0.07, 0.2), .phase_rad = random.uniform(0.0, 2.0 * kPi)};
  // About half of the variance of the flexors' proportions lies between trials (a place on a circle), half within.
  const auto change = [&random](double sd) {
    return Modulation{
        .depth = sd, .frequency_hz = random.uniform(0.05, 0.15), .phase_rad = random.uniform(0.0, 2.0 * kPi)};
  };
  const double angle_rad = random.uniform(0.0, 2.0 * kPi);
  const double brachioradialis = 0.5 * control.synergy;
  const double brachialis = 0.5 * control.brachialis_synergy;
  script.mean.brachioradialis = brachioradialis * std::cos(angle_rad);
  script.brachioradialis_change = change(brachioradialis);
  script.mean.brachialis = brachialis * std::sin(angle_rad);
  script.brachialis_change = change(brachialis);
  switch (trial.kind) {
    case TrialKind::flexion:
      add_oscillation(script, random);
      break;
    case TrialKind::eccentric:
    case TrialKind::passive:
      add_lifts(script, control.irregularity, uneven);
      break;
    case TrialKind::isokinetic:
      add_sweeps(script, control, random);
      break;
    case TrialKind::isometric_ramp:
    case TrialKind::mvc:
      add_efforts(script, control, random);
      break;
  }
  if (control.irregularity > 0.0) make_uneven(script, control.irregularity, uneven);
  return script;
}

}  // namespace myoid::lab
