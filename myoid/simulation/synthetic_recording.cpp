#include "myoid/simulation/synthetic_recording.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"
#include "myoid/simulation/draw_truth.h"
#include "myoid/simulation/random.h"
#include "myoid/simulation/raw_emg.h"
#include "myoid/simulation/trial_script.h"

namespace myoid::simulation {
namespace {

constexpr double kGreatestActivation = 0.95;  ///< More cannot be asked of a person.
constexpr int kMostDraws = 500;
/// Resolution of the instruments, as steps per unit: 0.01 mm, 0.1 uV, 0.1 mN m.
constexpr double kMarkerSteps_perm = 1e5;
constexpr double kEmgSteps_perv = 1e7;
constexpr double kTorqueSteps_pernm = 1e4;
constexpr double kArtefactBand_hz = 4.0;
constexpr double kArtefactSpeed_radps =
    2.0;  ///< At which the artefact has the rms of the protocol.

/// What happens at one instant.
struct Instant {
  Moment q;
  MuscleGeometry geometry;
  PerMuscle activation = {};
  PerMuscle force_n = {};
  double muscle_torque_nm = 0.0;
  double external_torque_nm = 0.0;
};

/// One person doing one trial: the truth at any time.
class Performance {
 public:
  Performance(const VirtualArm& arm, const HillSet& muscles, TrialScript script)
      : arm_(&arm), muscles_(&muscles), script_(std::move(script)) {}

  [[nodiscard]] const TrialScript& script() const { return script_; }
  [[nodiscard]] const HillSet& muscles() const { return *muscles_; }

  [[nodiscard]] Instant at(double time_s) const {
    Instant now;
    now.q = script_.motion(time_s);
    now.geometry = arm_->geometry(now.q);
    const PerMuscle full_n = full_force_n(now.geometry, *muscles_);
    PerMuscle capacity_nm = {};
    for (std::size_t i = 0; i < 4; ++i) capacity_nm[i] = full_n[i] * now.geometry.moment_arm_m[i];

    const double required_nm =
        arm_->required_torque_nm(now.q, script_.protocol.plane, script_.protocol.held_mass_kg);
    now.activation = script_.against_dynamometer()
                         ? script_.prescribed_activations(time_s)
                         : activations_for(required_nm, capacity_nm, script_.coordination(time_s));
    for (std::size_t i = 0; i < 4; ++i) {
      now.force_n[i] = now.activation[i] * full_n[i];
      now.muscle_torque_nm += now.activation[i] * capacity_nm[i];
    }
    if (script_.against_dynamometer()) {
      now.external_torque_nm = required_nm - now.muscle_torque_nm;
    }
    return now;
  }

  /// The greatest activation that the motion asks for; 0 against a dynamometer.
  [[nodiscard]] double greatest_activation(double rate_hz) const {
    double greatest = 0.0;
    if (script_.against_dynamometer()) return greatest;
    for (double t = 0.0; t <= script_.duration_s; t += 1.0 / rate_hz) {
      const PerMuscle a = at(t).activation;
      greatest = std::max(greatest, *std::max_element(a.begin(), a.end()));
    }
    return greatest;
  }

 private:
  const VirtualArm* arm_;
  const HillSet* muscles_;
  TrialScript script_;
};

Eigen::VectorXd clock(double duration_s, double rate_hz) {
  const auto count = static_cast<Eigen::Index>(std::floor(duration_s * rate_hz + 1e-9)) + 1;
  Eigen::VectorXd time_s(count);
  for (Eigen::Index k = 0; k < count; ++k) time_s(k) = static_cast<double>(k) / rate_hz;
  return time_s;
}

std::vector<Channel> per_muscle(Unit unit) {
  std::vector<Channel> channels;
  for (const std::string_view muscle : kArmMuscles) channels.push_back({std::string(muscle), unit});
  return channels;
}

TrueTrial true_trial(const Performance& performance, double rate_hz) {
  const Eigen::VectorXd time_s = clock(performance.script().duration_s, rate_hz);
  const Eigen::Index n = time_s.size();
  Eigen::MatrixXd motion(n, 3);
  Eigen::MatrixXd torque(n, 2);
  Eigen::MatrixXd activation(n, 4);
  Eigen::MatrixXd force(n, 4);
  Eigen::MatrixXd length(n, 4);
  for (Eigen::Index k = 0; k < n; ++k) {
    const Instant now = performance.at(time_s(k));
    motion.row(k) << now.q.value, now.q.first, now.q.second;
    torque.row(k) << now.muscle_torque_nm, now.external_torque_nm;
    for (Eigen::Index i = 0; i < 4; ++i) {
      const auto muscle = static_cast<std::size_t>(i);
      activation(k, i) = now.activation[muscle];
      force(k, i) = now.force_n[muscle];
      length(k, i) =
          now.geometry.length_m[muscle] - performance.muscles()[muscle].tendon_slack_length_m;
    }
  }
  return {.motion = {time_s,
                     {{"elbow_flexion", Unit::radian},
                      {"elbow_flexion_speed", Unit::radian_per_second},
                      {"elbow_flexion_acceleration", Unit::radian_per_second2}},
                     motion},
          .torque = {time_s,
                     {{"elbow_flexion_moment", Unit::newton_meter},
                      {"elbow_flexion_external_moment", Unit::newton_meter}},
                     torque},
          .activation = {time_s, per_muscle(Unit::dimensionless), activation},
          .force = {time_s, per_muscle(Unit::newton), force},
          .length = {time_s, per_muscle(Unit::meter), length}};
}

/// Everything that the instruments need to know.
struct Laboratory {
  const Protocol* protocol;
  const Truth* truth;
  const VirtualArm* arm;
  std::uint64_t seed;

  [[nodiscard]] bool exact() const { return protocol->level == Level::noise_free; }
  [[nodiscard]] Random stream(std::string_view instrument, const std::string& trial) const {
    return Random(seed_for(seed, fmt::format("{}.{}", instrument, trial)));
  }
};

/// What an instrument shows of a value: a multiple of its resolution.
template <typename Derived>
void quantize(Eigen::MatrixBase<Derived>& values, double per_unit) {
  values = (values * per_unit).array().round().matrix() / per_unit;
}

recording::MarkerSeries record_markers(const Laboratory& laboratory,
                                       const TrialScript& script,
                                       const TimeSeries& motion) {
  recording::MarkerSeries markers;
  markers.time_s = motion.time_s();
  markers.names = laboratory.arm->marker_names();
  markers.positions_m = laboratory.arm->markers_m(motion.values().col(0), script.protocol.plane);
  if (laboratory.exact()) return markers;
  Random random = laboratory.stream("markers", script.protocol.name);
  const double sd_m = laboratory.protocol->motion.marker_sd_m;
  for (Eigen::Index k = 0; k < markers.positions_m.rows(); ++k) {
    markers.positions_m.row(k) += sd_m * random.normals(markers.positions_m.cols()).transpose();
  }
  quantize(markers.positions_m, kMarkerSteps_perm);
  return markers;
}

/// One electrode: Gaussian noise with the amplitude of the muscle's effort, and what disturbs it.
Eigen::VectorXd raw_signal(const Laboratory& laboratory,
                           const std::string& stream,
                           const Eigen::VectorXd& effort,
                           const Eigen::VectorXd& speed_radps) {
  const EmgNoise& emg = laboratory.protocol->emg;
  const Eigen::Index n = effort.size();
  Random random = laboratory.stream("emg", stream);
  const double phase_rad = random.uniform(0.0, 2.0 * kPi);
  const Eigen::VectorXd muscle = emg_noise({}, emg.rate_hz, n, random);
  const Eigen::VectorXd amplifier = emg_noise({}, emg.rate_hz, n, random);
  const Eigen::VectorXd artefact = lowpass_noise(kArtefactBand_hz, emg.rate_hz, n, random);
  Eigen::VectorXd signal(n);
  for (Eigen::Index k = 0; k < n; ++k) {
    const double mains =
        std::sqrt(2.0) *
        std::sin(2.0 * kPi * emg.hum_hz * static_cast<double>(k) / emg.rate_hz + phase_rad);
    signal(k) = effort(k) * muscle(k) + emg.baseline * amplifier(k) + emg.hum * mains +
                emg.artefact * std::abs(speed_radps(k)) / kArtefactSpeed_radps * artefact(k);
  }
  return signal;
}

TimeSeries record_emg(const Laboratory& laboratory, const Performance& performance) {
  const Protocol& protocol = *laboratory.protocol;
  const Truth& truth = *laboratory.truth;
  const TrialScript& script = performance.script();
  const Eigen::VectorXd time_s = clock(script.duration_s, protocol.emg.rate_hz);

  // The electrode sees now what the muscle does a delay later.
  Eigen::MatrixXd effort(time_s.size(), 4);
  Eigen::VectorXd speed_radps(time_s.size());
  for (Eigen::Index k = 0; k < time_s.size(); ++k) {
    const PerMuscle a = performance.at(time_s(k) + truth.emg_delay_s).activation;
    effort.row(k) << a[0], a[1], a[2], a[3];
    speed_radps(k) = script.motion(time_s(k)).first;
  }

  std::vector<Channel> channels;
  std::vector<Eigen::VectorXd> signals;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == kBrachialis && !(protocol.control.brachialis_synergy > 0.0)) continue;
    const std::string muscle(kArmMuscles[i]);
    const Eigen::VectorXd own = effort.col(static_cast<Eigen::Index>(i));
    if (laboratory.exact()) {
      channels.push_back({muscle, Unit::dimensionless});
      signals.push_back(own);
    } else {
      channels.push_back({muscle, Unit::volt});
      signals.emplace_back(truth.mvc_v[i] * raw_signal(laboratory,
                                                       script.protocol.name + "." + muscle, own,
                                                       speed_radps));
    }
  }
  Eigen::MatrixXd values(time_s.size(), static_cast<Eigen::Index>(signals.size()));
  for (std::size_t i = 0; i < signals.size(); ++i) {
    values.col(static_cast<Eigen::Index>(i)) = signals[i];
  }
  if (!laboratory.exact()) quantize(values, kEmgSteps_perv);
  return {time_s, channels, values};
}

TimeSeries record_torque(const Laboratory& laboratory,
                         const TrialScript& script,
                         const TimeSeries& torque) {
  const Protocol& protocol = *laboratory.protocol;
  Eigen::VectorXd external = torque.column("elbow_flexion_external_moment");
  if (!laboratory.exact() && protocol.torque.sd_nm > 0.0) {
    Random random = laboratory.stream("torque", script.protocol.name);
    external +=
        protocol.torque.sd_nm * lowpass_noise(protocol.torque.bandwidth_hz, protocol.motion.rate_hz,
                                              external.size(), random);
  }
  return {torque.time_s(), {{"elbow_flexion_moment", Unit::newton_meter}}, external};
}

/// A person, and how this person does the trials.
struct Draw {
  Truth truth;
  std::vector<TrialScript> scripts;
};

/// Draws persons until one can do every trial.
Draw draw_person(const Protocol& protocol, const VirtualArm& arm, std::uint64_t seed) {
  Random random(seed_for(seed, "truth"));
  Draw result;
  Truth& truth = result.truth;
  truth.emg_delay_s =
      random.uniform(protocol.truth.emg_delay_min_s, protocol.truth.emg_delay_max_s);
  if (protocol.level == Level::noise_free) {
    // On the clock of the EMG, so that no interpolation stands between truth and recovery.
    truth.emg_delay_s = std::round(truth.emg_delay_s * protocol.emg.rate_hz) / protocol.emg.rate_hz;
  }
  for (double& mvc_v : truth.mvc_v) {
    mvc_v = std::exp(
        random.uniform(std::log(protocol.emg.mvc_min_v), std::log(protocol.emg.mvc_max_v)));
  }

  std::string too_hard;
  for (truth.draws = 1; truth.draws <= kMostDraws; ++truth.draws) {
    truth.muscles = draw_muscles(protocol.truth, arm.literature(), random);
    result.scripts.clear();
    for (const TrialProtocol& trial : protocol.trials) {
      result.scripts.push_back(make_script(trial, protocol.control,
                                           seed_for(seed, fmt::format("draw {}", truth.draws))));
    }
    const std::vector<TrialScript>& scripts = result.scripts;
    const auto hard = std::find_if(scripts.begin(), scripts.end(), [&](const TrialScript& script) {
      return Performance(arm, truth.muscles, script).greatest_activation(100.0) >
             kGreatestActivation;
    });
    if (hard == scripts.end()) return result;
    too_hard = hard->protocol.name;
  }
  throw InvalidInput(fmt::format(
      "none of {} virtual persons could do every trial of protocol \"{}\" with activations up to "
      "{}; the last one failed at trial \"{}\": choose a smaller held mass, a lower frequency or "
      "amplitude there",
      kMostDraws, protocol.name, kGreatestActivation, too_hard));
}

}  // namespace

VirtualRecording make_virtual_recording(const Protocol& protocol, std::uint64_t seed) {
  const VirtualArm arm(protocol.subject);
  const Draw person = draw_person(protocol, arm, seed);
  VirtualRecording recording{.protocol = protocol,
                             .seed = seed,
                             .model_osim = arm.osim(),
                             .held_body = arm.held_body(),
                             .held_at_m = arm.held_at_m(),
                             .truth = person.truth,
                             .trials = {}};
  const Laboratory laboratory{
      .protocol = &protocol, .truth = &recording.truth, .arm = &arm, .seed = seed};
  for (const TrialScript& script : person.scripts) {
    const Performance performance(arm, recording.truth.muscles, script);
    VirtualTrial trial{.protocol = script.protocol,
                       .markers = {},
                       .emg = record_emg(laboratory, performance),
                       .external_torque = std::nullopt,
                       .truth = true_trial(performance, protocol.motion.rate_hz)};
    trial.markers = record_markers(laboratory, script, trial.truth.motion);
    if (script.against_dynamometer()) {
      trial.external_torque = record_torque(laboratory, script, trial.truth.torque);
    }
    recording.trials.push_back(std::move(trial));
  }
  return recording;
}

}  // namespace myoid::simulation
