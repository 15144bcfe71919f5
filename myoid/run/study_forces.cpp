#include "myoid/run/study_forces.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>

#include "myoid/body/dynamics/inverse_dynamics.h"
#include "myoid/body/forces/sharing_input.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/run/resting_joints.h"
#include "myoid/study/study_model.h"

namespace myoid::run {
namespace {

/// Returns the times in which a leg's torque lacks the ground reaction; empty if there are none.
std::optional<body::UncarriedTime> uncarried_time(const study::Study& study,
                                                  const study::TrialSpec& spec,
                                                  const TrialMotion& motion,
                                                  const TimeSeries& generalized) {
  if (spec.external_torque || spec.given.torques) return std::nullopt;
  const std::vector<std::string> names = study::study_coordinates(study.model);
  const Eigen::VectorXd posture = motion.joints.q.values().row(0).transpose();
  const bool bears = std::ranges::any_of(names, [&](const std::string& name) {
    return body::bears_the_body(*motion.model, name, posture, study.subject.mass_kg.value_or(0.0));
  });
  return bears ? body::uncarried_time(*motion.model, generalized) : std::nullopt;
}

bool is_computed(const TrialMotion& motion, const TrialForces& forces) {
  return motion.failure.empty() && forces.failure.empty() && motion.joints.sample_count() > 0;
}

/// Runs `work(i)` for all trials in parallel; InvalidInput becomes the trial's failure.
template <typename Work>
void for_each_trial(const std::vector<TrialMotion>& motion,
                    std::vector<TrialForces>& forces,
                    const Progress& progress,
                    const Work& work) {
  parallel_each(motion.size(), [&](std::size_t i) {
    progress.check();
    if (!is_computed(motion[i], forces[i])) return;
    try {
      work(i);
    } catch (const InvalidInput& error) {
      forces[i].failure = error.what();
    }
  });
}

/// Puts the columns of a given stage in the place of the computed ones. `stage` is empty where nothing was computed.
void take_given(const body::BodyModel& model, const TimeSeries& given, Unit unit, TimeSeries& stage) {
  std::vector<Channel> channels;
  for (const body::Muscle& muscle : model.muscles) channels.push_back({muscle.name, unit});
  Eigen::MatrixXd values = stage.values();
  for (Eigen::Index c = 0; c < given.channel_count(); ++c)
    values.col(model.muscle_index(given.channels()[static_cast<std::size_t>(c)].name)) = given.values().col(c);
  stage = TimeSeries(stage.time_s(), std::move(channels), std::move(values));
}

/// Returns true if the trial gives the paths of every muscle of the model.
bool gives_paths(const body::BodyModel& model, const study::GivenStages& given) {
  const auto whole = [&](const TimeSeries& series) {
    return series.channel_count() == static_cast<Eigen::Index>(model.muscles.size());
  };
  return given.lengths && !given.moment_arms.empty() && whole(*given.lengths) && whole(*given.velocities) &&
         std::ranges::all_of(given.moment_arms, whole);
}

/// Returns the muscles' paths: those that the trial gives, and those of the model for the rest.
body::MuscleKinematics muscle_paths(const study::Study& study,
                                    const TrialMotion& motion,
                                    const study::GivenStages& given) {
  const body::BodyModel& model = *motion.model;
  const Eigen::VectorXd& time_s = motion.joints.q.time_s();
  const std::vector<std::string> coordinates = study::study_coordinates(study.model);
  body::MuscleKinematics found;
  if (study.model.is_none() || gives_paths(model, given)) {
    std::vector<Channel> names;
    for (const body::Muscle& muscle : model.muscles) names.push_back({muscle.name, Unit::meter});
    const TimeSeries blank(time_s, names,
                           Eigen::MatrixXd::Zero(time_s.size(), static_cast<Eigen::Index>(names.size())));
    found.length = found.velocity = blank;
    for (const std::string& name : coordinates) found.moment_arm[name] = blank;
  } else {
    found = body::muscle_kinematics(model, motion.joints);
  }
  const auto put = [&](const TimeSeries& series, Unit unit, TimeSeries& stage) {
    take_given(model, {time_s, series.channels(), study::values_at(series, time_s)}, unit, stage);
  };
  if (given.lengths) {
    put(*given.lengths, Unit::meter, found.length);
    put(*given.velocities, Unit::meter_per_second, found.velocity);
  }
  for (std::size_t j = 0; j < given.moment_arms.size(); ++j)
    put(given.moment_arms[j], Unit::meter, found.moment_arm.at(coordinates[j]));
  return found;
}

/// Returns the torques of all coordinates by inverse dynamics.
TimeSeries computed_torques(const study::TrialInput& input, const TrialMotion& motion) {
  return body::inverse_dynamics(*motion.model, motion.joints, {.loads = input.loads ? &*input.loads : nullptr});
}

/// Returns given forces on the clock of the motion.
body::MuscleForces given_forces(const TimeSeries& given, const Eigen::VectorXd& time_s) {
  body::MuscleForces forces;
  forces.force = TimeSeries(time_s, given.channels(), study::values_at(given, time_s));
  return forces;
}

std::vector<RestingJoint> find_resting(const StudyInputs& inputs,
                                       const study::StudyActivation& activation,
                                       const std::vector<TrialMotion>& motion,
                                       std::vector<TrialForces>& forces) {
  std::vector<RelaxedTrial> trials;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const study::TrialSpec& spec = inputs.source.study.trials[i];
    if (spec.use != study::Use::passive || !is_computed(motion[i], forces[i])) continue;
    trials.push_back({i, &spec, &activation.trials[i].activation, &motion[i].joints.q, &motion[i].joints.qdot,
                      &forces[i].muscle_torque, &forces[i].muscles});
  }
  RestingJoints found = resting_joints(inputs.source.study, *inputs.source.model, trials);
  for (Remark& remark : found.remarks) {
    const auto of_it =
        std::ranges::find_if(trials, [&](const RelaxedTrial& trial) { return trial.spec->name == remark.where; });
    forces[of_it->index].remarks.push_back(std::move(remark));
  }
  return std::move(found.joints);
}

}  // namespace

TrialForces trial_torques(const StudySource& source,
                          const study::TrialSpec& spec,
                          const study::TrialInput& input,
                          const TrialMotion& motion) {
  const body::BodyModel& model = *motion.model;
  TrialForces found;
  found.muscles = muscle_paths(source.study, motion, input.given);
  const std::optional<TimeSeries>& given = input.given.torques;
  // Methods that fit forces need no torque.
  if (source.study.model.is_none() && !given) return found;
  const Eigen::VectorXd& time_s = motion.joints.q.time_s();
  found.generalized =
      given ? TimeSeries(time_s, given->channels(), study::values_at(*given, time_s)) : computed_torques(input, motion);
  const std::vector<std::string> coordinates = study::study_coordinates(source.study.model);
  std::vector<Channel> columns;
  Eigen::MatrixXd torque(motion.joints.sample_count(), static_cast<Eigen::Index>(coordinates.size()));
  for (const std::string& name : coordinates) {
    const auto index = static_cast<std::size_t>(model.coordinate_index(name));
    const auto column = static_cast<Eigen::Index>(columns.size());
    columns.push_back({body::generalized_force_name(model.coordinates[index]), Unit::newton_meter});
    torque.col(column) = found.generalized.column(columns.back().name);
  }
  // The muscles do not produce the torque that acts from outside.
  if (input.external_torque) torque -= recording::resample(*input.external_torque, time_s).values();
  found.muscle_torque = TimeSeries(time_s, std::move(columns), std::move(torque));
  found.uncarried = uncarried_time(source.study, spec, motion, found.generalized);
  if (found.uncarried)
    found.remarks.push_back({.code = RemarkCode::body_unsupported, .says = found.uncarried->sentence()});
  return found;
}

body::MuscleForces shared_forces(const study::Study& study,
                                 const study::TrialInput& input,
                                 const TrialMotion& motion,
                                 const TrialForces& torques,
                                 const std::vector<RestingJoint>& resting,
                                 std::vector<Remark>& remarks) {
  const Eigen::VectorXd& time_s = motion.joints.q.time_s();
  if (input.given.forces) return given_forces(*input.given.forces, time_s);
  const std::vector<std::string> coordinates = study::study_coordinates(study.model);
  body::SharingInput sharing =
      input.given.torques ? body::sharing_input(*motion.model, torques.generalized, torques.muscles, coordinates)
                          : body::sharing_input(*motion.model, motion.joints, torques.muscles, coordinates,
                                                input.loads ? &*input.loads : nullptr);
  remarks.insert(remarks.end(), sharing.notes.begin(), sharing.notes.end());
  Eigen::MatrixXd torque = sharing.torques.values();
  for (std::size_t j = 0; j < coordinates.size(); ++j) {
    const auto index = static_cast<std::size_t>(motion.model->coordinate_index(coordinates[j]));
    const Eigen::Index column =
        sharing.torques.find(body::generalized_force_name(motion.model->coordinates[index])).value();
    if (input.external_torque)
      torque.col(column) -=
          recording::resample(*input.external_torque, time_s).values().col(static_cast<Eigen::Index>(j));
    const Eigen::VectorXd by_itself = resting_torque_nm(resting, coordinates[j], motion.joints.q);
    if (by_itself.size() > 0) torque.col(column) -= by_itself;
  }
  sharing.torques = TimeSeries(sharing.torques.time_s(), sharing.torques.channels(), std::move(torque));
  return body::share(sharing, {.objective = study.sharing.objective,
                               .exponent = study.sharing.exponent,
                               .reserve_nm = study.sharing.reserve_nm});
}

StudyForces study_forces(const StudyInputs& inputs,
                         const study::StudyActivation& activation,
                         const std::vector<TrialMotion>& motion,
                         bool share,
                         const Progress& progress) {
  const study::Study& study = inputs.source.study;
  StudyForces found;
  found.trials.resize(motion.size());
  std::atomic<int> done = 0;
  for_each_trial(motion, found.trials, progress, [&](std::size_t i) {
    found.trials[i] = trial_torques(inputs.source, study.trials[i], inputs.trials[i], motion[i]);
    progress.tell(++done / (2.0 * static_cast<double>(motion.size())), study.trials[i].name);
  });
  found.resting = find_resting(inputs, activation, motion, found.trials);
  if (!share) return found;
  for_each_trial(motion, found.trials, progress, [&](std::size_t i) {
    TrialForces& trial = found.trials[i];
    // The passive trials give the resting torques, so in them the muscles share the whole torque.
    const bool passive = study.trials[i].use == study::Use::passive;
    trial.shared = shared_forces(study, inputs.trials[i], motion[i], trial,
                                 passive ? std::vector<RestingJoint>{} : found.resting, trial.remarks);
    progress.tell(++done / (2.0 * static_cast<double>(motion.size())), study.trials[i].name);
  });
  return found;
}

}  // namespace myoid::run
