#include "myoid/lab/twin/synthetic_recording.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/math/random.h"
#include "myoid/lab/virtual_person/draw_truth.h"
#include "myoid/lab/virtual_person/effective_delay.h"
#include "myoid/lab/virtual_person/effective_truth.h"
#include "myoid/lab/virtual_person/performance.h"
#include "myoid/lab/virtual_person/trial_script.h"

namespace myoid::lab {
namespace {

constexpr int kMostDraws = 500;

std::vector<Channel> per_muscle(Unit unit) {
  std::vector<Channel> channels;
  for (const std::string_view muscle : kArmMuscles) channels.push_back({std::string(muscle), unit});
  return channels;
}

/// Returns the heads over time; empty if the truth has none.
std::optional<TimeSeries> true_heads(const Performance& performance,
                                     const Truth& truth,
                                     const Eigen::VectorXd& time_s) {
  if (!truth.arm) return std::nullopt;
  std::vector<Channel> channels;
  for (const TrueHead& head : truth.arm->heads) {
    const std::string name(head.name);
    channels.push_back({name + "_activation", Unit::dimensionless});
    channels.push_back({name + "_fiber_length", Unit::meter});
    channels.push_back({name + "_tendon_force", Unit::newton});
  }
  Eigen::MatrixXd values(time_s.size(), static_cast<Eigen::Index>(channels.size()));
  for (Eigen::Index k = 0; k < time_s.size(); ++k) {
    const ArmState now = *performance.heads(time_s(k));
    for (std::size_t i = 0; i < kHeadCount; ++i) {
      const auto c = static_cast<Eigen::Index>(3 * i);
      values(k, c) = now.activation[i];
      values(k, c + 1) = now.fiber_length_m[i];
      values(k, c + 2) = now.tendon_force_n[i];
    }
  }
  return TimeSeries(time_s, channels, values);
}

/// Returns how cold the muscles are and how tired each of them is, as channels.
TimeSeries true_state(const Performance& performance, const Eigen::VectorXd& time_s) {
  std::vector<Channel> channels = {{"cold", Unit::dimensionless}};
  for (const std::string_view muscle : kArmMuscles)
    channels.push_back({"fatigued_" + std::string(muscle), Unit::dimensionless});
  Eigen::MatrixXd values(time_s.size(), 5);
  for (Eigen::Index k = 0; k < time_s.size(); ++k) {
    const PerMuscle f = performance.fatigued(time_s(k));
    values.row(k) << performance.script().cold(time_s(k)), f[0], f[1], f[2], f[3];
  }
  return {time_s, channels, values};
}

TrueTrial true_trial(const Performance& performance, const Truth& truth, double rate_hz) {
  const Eigen::VectorXd time_s = clock(performance.script().duration_s, rate_hz);
  const Eigen::Index n = time_s.size();
  Eigen::MatrixXd motion(n, 3);
  Eigen::MatrixXd torque(n, 3);
  Eigen::MatrixXd activation(n, 4);
  Eigen::MatrixXd force(n, 4);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Instant now = performance.at(time_s(k));
    motion.row(k) << now.q.value, now.q.first, now.q.second;
    torque.row(k) << now.muscle_torque_nm, now.external_torque_nm, now.passive_torque_nm;
    for (Eigen::Index i = 0; i < 4; ++i) {
      const auto muscle = static_cast<std::size_t>(i);
      activation(k, i) = now.activation[muscle];
      force(k, i) = now.force_n[muscle];
    }
  }
  return {.motion = {time_s,
                     {{"elbow_flexion", Unit::radian},
                      {"elbow_flexion_speed", Unit::radian_per_second},
                      {"elbow_flexion_acceleration", Unit::radian_per_second2}},
                     motion},
          .torque = {time_s,
                     {{"elbow_flexion_moment", Unit::newton_meter},
                      {"elbow_flexion_external_moment", Unit::newton_meter},
                      {"elbow_flexion_passive_moment", Unit::newton_meter}},
                     torque},
          .activation = {time_s, per_muscle(Unit::dimensionless), activation},
          .force = {time_s, per_muscle(Unit::newton), force},
          .heads = true_heads(performance, truth, time_s),
          .state = true_state(performance, time_s),
          .fatigued = performance.fatigued(0.5 * performance.script().duration_s),
          .emg_clock = {}};
}

/// A person who can do every trial, with the performances.
struct Session {
  std::vector<std::unique_ptr<Performance>> performances;
  std::string too_hard;  ///< The trial that this person cannot do; empty if there is none.
  std::string why;
};

Session perform(const Protocol& protocol,
                const VirtualArm& arm,
                const Truth& truth,
                const std::vector<TrialScript>& scripts,
                std::uint64_t seed) {
  Session session;
  const auto failed = [&session](const TrialScript& script, std::string why) {
    session.too_hard = why.empty() ? "" : script.protocol.name;
    session.why = std::move(why);
    return !session.why.empty();
  };
  // A person who is too weak for a trial is not simulated.
  for (const TrialScript& script : scripts) {
    const bool weak = truth.arm && foreseen_activation(*truth.arm, script) > kGreatestActivation;
    if (failed(script, weak ? std::string(kTooWeak) : "")) return session;
  }
  Tiredness<4> muscles;
  Tiredness<7> heads;
  if (protocol.fatigue.on) muscles.rates = heads.rates = muscle::published_fatigue_rates(protocol.fatigue.rates);
  for (const TrialScript& script : scripts) {
    std::unique_ptr<Performance> performance;
    if (truth.arm) {
      performance = std::make_unique<SimulatedPerformance>(*truth.arm, script, protocol.control.motor_noise, heads,
                                                           math::seed_for(seed, "nerves." + script.protocol.name));
    } else {
      performance = std::make_unique<ExactPerformance>(arm, truth.muscles, script, truth.emg_delay_s, muscles,
                                                       truth.beside, truth.departures);
    }
    if (failed(script, performance->failure())) return session;
    session.performances.push_back(std::move(performance));
    muscles.rest(protocol.fatigue.rest_s);
    heads.rest(protocol.fatigue.rest_s);
  }
  return session;
}

/// At L2 the brachialis, with or without an electrode, departs from the biceps: 0.7 to 1.3 of its
/// activation, and slowly wandering.
struct OwnBrachialis {
  double gain = 1.0;
  double wander = 0.0;
};

/// Grows the EMG per excitation evenly from the first trial to the end of the last.
void drift_gains(std::vector<TrialScript>& scripts, double growth, double rest_s) {
  double session_s = -rest_s;
  for (const TrialScript& script : scripts) session_s += script.duration_s + rest_s;
  double begin_s = 0.0;
  for (TrialScript& script : scripts) {
    script.emg_gain_first = 1.0 + growth * begin_s / session_s;
    script.emg_gain_last = 1.0 + growth * (begin_s + script.duration_s) / session_s;
    begin_s += script.duration_s + rest_s;
  }
}

std::vector<TrialScript> make_scripts(const Protocol& protocol,
                                      const PerMuscle& mvc_effort,
                                      const OwnBrachialis& brachialis,
                                      std::uint64_t seed) {
  std::vector<TrialScript> scripts;
  for (const TrialProtocol& trial : protocol.trials) {
    scripts.push_back(make_script(trial, protocol.control, seed));
    scripts.back().mvc_effort = mvc_effort;
    if (protocol.level != Level::different) continue;
    scripts.back().mean.brachialis += std::log(brachialis.gain);
    scripts.back().brachialis_change.depth += brachialis.wander;
    for (Effort& effort : scripts.back().efforts) {
      if (trial.kind != TrialKind::mvc) effort.coordination.brachialis += std::log(brachialis.gain);
    }
  }
  drift_gains(scripts, protocol.truth.sensors.emg_gain_drift, protocol.fatigue.rest_s);
  return scripts;
}

/// Makes the recording. `record`: the instruments record, too.
VirtualRecording make(const Protocol& protocol, std::uint64_t seed, bool record) {
  const bool simulated = protocol.level == Level::different;
  const VirtualArm arm(protocol.subject, protocol.seven_heads);
  VirtualRecording recording{.protocol = protocol,
                             .seed = seed,
                             .model_osim = arm.osim,
                             .held_at_m = arm.held_at_m,
                             .truth = {},
                             .trials = {}};
  Truth& truth = recording.truth;
  truth.instruments = attach_instruments(protocol, arm, seed);
  if (!simulated) {
    truth.beside = draw_beside_muscles(protocol.truth, math::Random(math::seed_for(seed, "beside muscles")));
    const bool drawn = protocol.truth.beside_muscles && !protocol.truth.sensors.emg_exponent;
    for (std::size_t m = 0; drawn && m < 4; ++m) truth.instruments.exponent[m] *= truth.beside.emg_exponent[m];
    truth.departures = draw_departures(protocol.truth, math::Random(math::seed_for(seed, "departures")));
  }
  math::Random random(math::seed_for(seed, "truth"));
  truth.emg_delay_s = random.uniform(protocol.truth.emg_delay_s.lower, protocol.truth.emg_delay_s.upper);
  if (protocol.level == Level::noise_free) {
    // Rounds to the clock of the EMG, so that no interpolation lies between truth and recovery.
    truth.emg_delay_s = std::round(truth.emg_delay_s * protocol.emg.rate_hz) / protocol.emg.rate_hz;
  }
  for (double& effort : truth.effort) effort = random.uniform(protocol.emg.effort.lower, protocol.emg.effort.upper);
  const OwnBrachialis brachialis{random.uniform(0.7, 1.3), random.uniform(0.2, 0.5)};

  Session session;
  for (truth.draws = 1; truth.draws <= kMostDraws; ++truth.draws) {
    const std::uint64_t draw_seed = math::seed_for(seed, fmt::format("draw {}", truth.draws));
    const std::vector<TrialScript> scripts = make_scripts(protocol, truth.effort, brachialis, draw_seed);
    if (simulated) {
      truth.arm = draw_true_arm(protocol.truth, protocol.subject, random);
    } else {
      truth.muscles = draw_muscles(protocol.truth, arm.literature, random);
    }
    session = perform(protocol, arm, truth, scripts, draw_seed);
    if (session.too_hard.empty()) break;
  }
  if (!session.too_hard.empty()) {
    throw InvalidInput(fmt::format(
        "none of {} virtual persons could do every trial of protocol \"{}\" with activations up to {}; the last one "
        "failed at trial \"{}\" ({}): choose a smaller held mass, a lower frequency or amplitude there",
        kMostDraws, protocol.name, kGreatestActivation, session.too_hard, session.why));
  }
  if (simulated) {
    truth.muscles = effective_muscles(*truth.arm, arm, &truth.misfit);
    truth.emg_delay_s = effective_delay_s(*truth.arm, arm, truth.muscles, session.performances);
  }
  if (!record) return recording;

  for (const auto& performance : session.performances) {
    const EmgClock emg_time = emg_clock(protocol, truth.instruments, performance->script().protocol.name, seed);
    VirtualTrial trial{.protocol = performance->script().protocol,
                       .markers = record_markers(protocol, arm, truth.instruments, *performance, seed),
                       .emg = record_emg(protocol, truth.instruments, *performance, emg_time, seed),
                       .external_torque = std::nullopt,
                       .fascicles = std::nullopt,
                       .truth = true_trial(*performance, truth, protocol.motion.rate_hz)};
    trial.truth.emg_clock = emg_time;
    if (performance->script().against_dynamometer()) {
      trial.external_torque = record_torque(protocol, *performance, trial.truth.torque.time_s(),
                                            trial.truth.torque.column("elbow_flexion_external_moment"), seed);
    }
    if (protocol.truth.sensors.fascicle_sd_m > 0.0)
      trial.fascicles = record_fascicles(protocol, *performance, performance->script().duration_s, seed);
    recording.trials.push_back(std::move(trial));
  }
  return recording;
}

}  // namespace

VirtualRecording make_virtual_recording(const Protocol& protocol, std::uint64_t seed) {
  return make(protocol, seed, true);
}

VirtualRecording make_virtual_person(const Protocol& protocol, std::uint64_t seed) {
  return make(protocol, seed, false);
}

}  // namespace myoid::lab
