#include "myoid/simulation/identification_ready.h"

#include <cmath>
#include <optional>

#include "myoid/dynamics/held_mass.h"
#include "myoid/dynamics/inverse_dynamics.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/kinematics/joint_motion.h"
#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/model/osim_reader.h"
#include "myoid/signals/resample.h"

namespace myoid::simulation {
namespace {

constexpr double kMotionRate_hz = 100.0;        ///< The study's default.
constexpr double kKeptEnvelopeRate_hz = 250.0;  ///< It holds nothing above some 15 Hz.

/// Every so-manieth sample, down to about the rate.
TimeSeries thinned(const TimeSeries& series, double rate_hz) {
  const auto stride = static_cast<Eigen::Index>(std::floor(series.mean_rate_hz() / rate_hz));
  if (stride <= 1) return series;
  const Eigen::Index count = (series.sample_count() - 1) / stride + 1;
  const auto rows = Eigen::seqN(Eigen::Index{0}, count, stride);
  return {series.time_s()(rows), series.channels(), series.values()(rows, Eigen::all)};
}

void process_emg(const VirtualRecording& recording, ReadyPerson& person) {
  if (recording.protocol.level == Level::noise_free) {
    for (std::size_t i = 0; i < recording.trials.size(); ++i)
      person.trials[i].activation = recording.trials[i].emg;
    return;
  }
  std::vector<TimeSeries> envelopes;
  std::vector<Eigen::VectorXd> bandwidths_hz;
  std::vector<const TimeSeries*> raw;
  for (const VirtualTrial& trial : recording.trials) raw.push_back(&trial.emg);
  for (signals::EmgStages& stages :
       signals::process_emg(raw, {.lowpass_hz = recording.protocol.lowpass_hz})) {
    envelopes.push_back(std::move(stages.envelope));
    bandwidths_hz.push_back(std::move(stages.bandwidth_hz));
  }
  std::vector<signals::TrialEnvelope> views;
  for (std::size_t i = 0; i < envelopes.size(); ++i) {
    const TrialProtocol& trial = recording.trials[i].protocol;
    views.push_back({trial.name, trial.use == "mvc", &envelopes[i], bandwidths_hz[i]});
  }
  person.normalisation =
      signals::find_normalisation(views, {.window_s = recording.protocol.mvc_window_s});
  for (std::size_t i = 0; i < envelopes.size(); ++i) {
    person.trials[i].activation =
        thinned(signals::normalise(envelopes[i], person.normalisation), kKeptEnvelopeRate_hz);
  }
}

kinematics::JointMotion motion_of(const model::BodyModel& model,
                                  const VirtualRecording& recording,
                                  const VirtualTrial& trial) {
  const kinematics::IkResult ik = kinematics::inverse_kinematics(model, trial.markers);
  kinematics::MotionOptions options;
  const double rate_hz = ik.q.mean_rate_hz();
  const double cutoff_hz = recording.protocol.lowpass_hz;
  if (recording.protocol.level != Level::noise_free && cutoff_hz < 0.45 * rate_hz)
    options.cutoff_hz = cutoff_hz;
  if (recording.protocol.level != Level::noise_free &&
      std::abs(rate_hz - kMotionRate_hz) > 0.01 * kMotionRate_hz) {
    const Eigen::VectorXd& clock = ik.q.time_s();
    options.time_s = signals::even_clock(clock[0], clock[clock.size() - 1], kMotionRate_hz);
  }
  return kinematics::joint_motion(model, ik.q, options).motion;
}

void process_motion(const model::BodyModel& unloaded,
                    const VirtualRecording& recording,
                    const VirtualTrial& trial,
                    const std::vector<std::vector<std::pair<Eigen::Index, double>>>& groups,
                    ReadyTrial& ready) {
  const model::BodyModel model = dynamics::with_held_mass(
      unloaded, recording.held_body, recording.held_at_m, trial.protocol.held_mass_kg);
  const kinematics::JointMotion motion = motion_of(model, recording, trial);
  ready.time_s = motion.q.time_s();
  ready.torque_nm = dynamics::inverse_dynamics(model, motion).column("elbow_flexion_moment");
  if (trial.external_torque) {
    ready.torque_nm -= signals::resample(*trial.external_torque, ready.time_s).values().col(0);
  }
  const kinematics::MuscleKinematics muscles = kinematics::muscle_kinematics(model, motion);
  const Eigen::MatrixXd& arms = muscles.moment_arm.at("elbow_flexion").values();
  const Eigen::Index n = ready.time_s.size();
  ready.length_m = ready.velocity_mps = ready.moment_arm_m =
      Eigen::MatrixXd::Zero(n, static_cast<Eigen::Index>(groups.size()));
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto column = static_cast<Eigen::Index>(g);
    for (const auto& [member, share] : groups[g]) {
      ready.length_m.col(column) += share * muscles.length.values().col(member);
      ready.velocity_mps.col(column) += share * muscles.velocity.values().col(member);
      ready.moment_arm_m.col(column) += share * arms.col(member);
    }
  }
}

/// Muscles of the model that make up BIC, BRA, BRD and TRI, with their shares of F_max.
std::vector<std::vector<std::pair<Eigen::Index, double>>> groups_of(const model::BodyModel& model) {
  std::vector<std::vector<std::pair<Eigen::Index, double>>> groups(kArmMuscles.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    double total_n = 0.0;
    for (std::size_t i = 0; i < model.muscles.size(); ++i) {
      // Heads are named after their muscle: BIClong, TRImed.
      if (!model.muscles[i].name.starts_with(kArmMuscles[g])) continue;
      const double force_n = model.muscles[i].properties.max_isometric_force_n;
      groups[g].emplace_back(static_cast<Eigen::Index>(i), force_n);
      total_n += force_n;
    }
    for (auto& member : groups[g]) member.second /= total_n;
  }
  return groups;
}

}  // namespace

ReadyPerson identification_ready(const VirtualRecording& recording) {
  ReadyPerson person;
  person.protocol = recording.protocol;
  person.seed = recording.seed;
  person.truth = recording.truth;
  person.literature =
      VirtualArm(recording.protocol.subject, recording.protocol.seven_heads).literature();
  for (std::size_t m = 0; m < kArmMuscles.size(); ++m) {
    const bool shares = m == kBrachialis && !has_brachialis_electrode(recording.protocol);
    person.channels.emplace_back(kArmMuscles[shares ? std::size_t{kBiceps} : m]);
  }
  person.trials.resize(recording.trials.size());
  process_emg(recording, person);

  const model::BodyModel model = model::parse_osim(recording.model_osim, "model.osim");
  const auto groups = groups_of(model);
  std::vector<ReadyTrial> used;
  for (std::size_t i = 0; i < recording.trials.size(); ++i) {
    const VirtualTrial& trial = recording.trials[i];
    ReadyTrial& ready = person.trials[i];
    ready.name = trial.protocol.name;
    ready.use = trial.protocol.use;
    ready.calibration = ready.use == "calibration" || ready.use == "isometric";
    if (!ready.calibration && ready.use != "validation") continue;
    process_motion(model, recording, trial, groups, ready);
    used.push_back(std::move(ready));
  }
  person.trials = std::move(used);
  return person;
}

ReadyPerson make_identification_ready(const Protocol& protocol, std::uint64_t seed) {
  return identification_ready(make_virtual_recording(protocol, seed));
}

}  // namespace myoid::simulation
