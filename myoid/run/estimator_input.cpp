#include "myoid/run/estimator_input.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "myoid/body/kinematics/lumped_muscles.h"
#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/fit/measurement/nuisances.h"
#include "myoid/fit/measurement/unseen_activations.h"
#include "myoid/ground/core/units.h"
#include "myoid/run/effort_prior.h"
#include "myoid/run/resting_joints.h"
#include "myoid/study/intake/emg_cover.h"
#include "myoid/study/intake/read_fascicles.h"
#include "myoid/study/study_model.h"

namespace myoid::run {
namespace {

/// Adds angle, speed and acceleration of a joint and its resting torque, as far as the angle is known.
void add_motion(const body::JointMotion& motion,
                const std::vector<RestingJoint>& resting,
                const std::string& name,
                auto& joint) {
  joint.resting_nm = resting_torque_nm(resting, name, motion.q);
  if (motion.q.channel_count() == 0) return;
  joint.angle_rad = motion.q.column(name);
  joint.velocity_radps = motion.qdot.column(name);
  joint.acceleration_radps2 = motion.qddot.column(name);
}

/// Returns the part of the j-th joint's torque by weight and inertia; empty without a dynamometer.
Eigen::VectorXd beside_dynamometer(const TrialResult& trial, std::size_t j) {
  if (!trial.spec.external_torque || trial.forces.muscle_torque.empty()) return {};
  return trial.forces.generalized.column(trial.forces.muscle_torque.channels()[j].name);
}

/// Returns the torques of the joints; 0 where the trial gives forces alone, which methods `force` and `paper` fit.
Eigen::MatrixXd torques_of(const TrialForces& forces, std::size_t joints) {
  if (!forces.muscle_torque.empty()) return forces.muscle_torque.values();
  return Eigen::MatrixXd::Zero(forces.muscles.length.sample_count(), static_cast<Eigen::Index>(joints));
}

fit::TrialData trial_data(const study::Study& study,
                          const study::TrialSpec& spec,
                          const TrialResult& trial,
                          const TimeSeries& activation,
                          const std::vector<body::MuscleGroup>& groups,
                          const std::vector<RestingJoint>& resting) {
  fit::TrialData data;
  data.name = trial.spec.name;
  data.calibration = study.fits(spec);
  data.reference = spec.use == study::Use::mvc;
  data.time_s = trial.motion.joints.q.time_s();
  body::LumpedMuscles lumped = body::lumped_muscles(trial.forces.muscles, groups, study.model.coordinate);
  data.length_m = std::move(lumped.length_m);
  data.velocity_mps = std::move(lumped.velocity_mps);
  data.moment_arm_m = std::move(lumped.moment_arm_m);
  if (!trial.forces.shared.force.empty()) {
    data.force_n = Eigen::MatrixXd::Zero(data.length_m.rows(), data.length_m.cols());
    for (Eigen::Index g = 0; g < data.force_n.cols(); ++g) {
      for (const std::string& head : study.muscles[static_cast<std::size_t>(g)].osim)
        data.force_n.col(g) += trial.forces.shared.force.column(head);
    }
  }
  const Eigen::MatrixXd torque_nm = torques_of(trial.forces, study.model.more_coordinates.size() + 1);
  data.torque_nm = torque_nm.col(0);
  data.dynamics_nm = beside_dynamometer(trial, 0);
  data.condition = trial.spec.condition;
  data.joint = study.model.coordinate;
  add_motion(trial.motion.joints, resting, data.joint, data);
  for (std::size_t j = 0; j < study.model.more_coordinates.size(); ++j) {
    const std::string& name = study.model.more_coordinates[j];
    data.more_joints.push_back({.joint = name,
                                .torque_nm = torque_nm.col(static_cast<Eigen::Index>(j) + 1),
                                .moment_arm_m = body::lumped_moment_arm_m(trial.forces.muscles, groups, name)});
    data.more_joints.back().dynamics_nm = beside_dynamometer(trial, j + 1);
    add_motion(trial.motion.joints, resting, name, data.more_joints.back());
  }
  data.activation = activation;
  if (trial.input.fascicles) data.fascicle_m = study::fascicles_at(*trial.input.fascicles, study.muscles, data.time_s);
  data.excluded = trial.spec.exclude.windows;
  if (trial.forces.uncarried)
    data.excluded.insert(data.excluded.end(), trial.forces.uncarried->stretches.begin(),
                         trial.forces.uncarried->stretches.end());
  // Times without EMG are not fitted.
  const study::Rows rows = study::rows_with_emg(trial.motion.joints.q.time_s(), activation.time_s());
  return fit::part(data, rows.first, rows.count());
}

}  // namespace

fit::StudyData estimator_data(const FitSource& source) {
  const study::Study& study = source.study;
  const std::vector<body::MuscleGroup> groups = study::muscle_groups(study, source.model);
  fit::StudyData data;
  data.muscles = study::muscle_setups(study, source.model);
  if (effort_is_in_strength(study)) expect_any_effort(data.muscles);
  for (std::size_t i = 0; i < source.trials.size(); ++i) {
    const TrialResult& trial = source.trials[i];
    const TimeSeries& activation = *source.activation[i];
    if (!trial.has_motion() || activation.empty()) continue;
    const study::TrialSpec& spec = study.trials[i];
    if (!study.fits(spec) && spec.use != study::Use::validation) continue;
    data.trials.push_back(trial_data(study, spec, trial, activation, groups, source.resting));
  }
  fit::expect_activations(data);
  // Without an unknown gain EMG that is given as activation is taken at its word.
  const bool scaled = study.emg.kind == study::EmgKind::activation ? study.identify.gain : study.emg.has_mvc;
  data.rules = fit::nuisance_rules(data, scaled);
  if (effort_is_unknown(study)) {
    data.rules.push_back(effort_bounds());
    data.rules.back().owners = fit::measured_channels(data);
  }
  data.rules.insert(data.rules.end(), study.parameters.begin(), study.parameters.end());
  fit::free_speeds(data, fit::unstated_speeds(data, study.identify.muscles));
  return data;
}

fit::EstimatorSettings estimator_settings(const study::Study& study) {
  const study::IdentifySpec& spec = study.identify;
  fit::UnseenSpreads unseen = study.beliefs;
  unseen.effort = unseen_effort(study);
  if (effort_is_in_strength(study)) unseen.strength = std::hypot(unseen.strength, any_effort().common_sd);
  return {.muscles = spec.muscles,
          .unseen = unseen,
          .lag = spec.dynamics ? fit::LagChoice::equation_1 : spec.lag,
          .delay_s = study.emg.delay_s,
          .delay_per_channel = spec.delay_per_channel,
          .angle_sd_rad = spec.angle_sd_deg * kDegree,
          .angle_rate_sd_radps = spec.angle_rate_sd_degps * kDegree,
          .eccentric = spec.eccentric,
          .normalised = spec.normalised,
          .posterior_draws = spec.posterior_draws};
}

fit::ActivationSource activation_source(const study::Study& study,
                                        const std::vector<recording::ChannelNormalisation>& normalisation) {
  fit::ActivationSource source{.from_mvc = from_maximal_effort(study.emg),
                               .envelope_cutoff_hz = study.emg.chain.lowpass_hz};
  // Activation 1 is the greatest effort of the MVC trials: a share of the muscle's maximum.
  AnyEffort effort{.own = {.mean = 1.0}};
  if (study.emg.has_mvc)
    effort.own = {.mean = study.emg.mvc_effort, .sd = study.emg.mvc_effort_sd / study.emg.mvc_effort};
  if (effort_is_unknown(study)) effort = any_effort();
  for (const recording::ChannelNormalisation& n : normalisation) {
    fit::ChannelSource channel{.channel = n.channel,
                               .gain_common_sd = effort.common_sd,
                               .gain_mean = effort.own.mean,
                               .bandwidth_hz = n.bandwidth_hz,
                               .rest = n.resting_level_v / n.reference_v,
                               .full_v = n.reference_v};
    if (study.identify.gain) channel.gain_sd = std::hypot(n.relative_sd, effort.own.sd);
    source.channels.push_back(std::move(channel));
  }
  // Another program's normalisation is of unknown exactness.
  if (study.emg.kind != study::EmgKind::activation || !study.identify.gain) return source;
  for (const study::MuscleSpec& muscle : study.muscles) {
    if (!muscle.without_emg &&
        std::ranges::find(source.channels, muscle.emg, &fit::ChannelSource::channel) == source.channels.end())
      source.channels.push_back({.channel = muscle.emg, .gain_sd = fit::beliefs::kEmgGain.sd});
  }
  return source;
}

fit::EstimatorOptions torque_options(const study::Study& study,
                                     const std::vector<recording::ChannelNormalisation>& normalisation,
                                     const Progress& progress) {
  return fit::estimator_options(estimator_settings(study), activation_source(study, normalisation),
                                {.report = nullptr, .stop = progress.stop});
}

}  // namespace myoid::run
