#include "myoid/run/study_forces.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

#include "myoid/core/error.h"
#include "myoid/dynamics/inverse_dynamics.h"
#include "myoid/forces/sharing_input.h"
#include "myoid/run/resting_joints.h"
#include "myoid/signals/resample.h"
#include "myoid/study/study_model.h"

namespace myoid {
namespace {

/// Returns the times in which a leg's torque lacks the ground reaction; empty if there are none.
std::optional<dynamics::UncarriedTime> uncarried_time(const Study& study,
                                                      const TrialSpec& spec,
                                                      const TrialMotion& motion,
                                                      const TimeSeries& generalized) {
  if (spec.external_torque) return std::nullopt;
  const std::vector<std::string> names = study_coordinates(study.model);
  const Eigen::VectorXd posture = motion.joints.q.values().row(0).transpose();
  const bool bears = std::ranges::any_of(names, [&](const std::string& name) {
    return dynamics::bears_the_body(*motion.model, name, posture, study.subject.mass_kg.value_or(0.0));
  });
  return bears ? dynamics::uncarried_time(*motion.model, generalized) : std::nullopt;
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
  oneapi::tbb::parallel_for(std::size_t{0}, motion.size(), [&](std::size_t i) {
    progress.check();
    if (!is_computed(motion[i], forces[i])) return;
    try {
      work(i);
    } catch (const InvalidInput& error) {
      forces[i].failure = error.what();
    }
  });
}

std::vector<identification::RestingJoint> find_resting(const StudyInputs& inputs,
                                                       const StudyActivation& activation,
                                                       const std::vector<TrialMotion>& motion,
                                                       std::vector<TrialForces>& forces) {
  std::vector<RelaxedTrial> trials;
  for (std::size_t i = 0; i < motion.size(); ++i) {
    const TrialSpec& spec = inputs.source.study.trials[i];
    if (spec.use != Use::passive || !is_computed(motion[i], forces[i])) continue;
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
                          const TrialSpec& spec,
                          const TrialInput& input,
                          const TrialMotion& motion) {
  const model::BodyModel& model = *motion.model;
  TrialForces found;
  found.generalized =
      dynamics::inverse_dynamics(model, motion.joints, {.loads = input.loads ? &*input.loads : nullptr});
  found.muscles = kinematics::muscle_kinematics(model, motion.joints);
  const std::vector<std::string> coordinates = study_coordinates(source.study.model);
  std::vector<Channel> columns;
  Eigen::MatrixXd torque(motion.joints.sample_count(), static_cast<Eigen::Index>(coordinates.size()));
  for (const std::string& name : coordinates) {
    const auto index = static_cast<std::size_t>(model.coordinate_index(name));
    const auto column = static_cast<Eigen::Index>(columns.size());
    columns.push_back({dynamics::generalized_force_name(model.coordinates[index]), Unit::newton_meter});
    torque.col(column) = found.generalized.column(columns.back().name);
  }
  // The muscles do not produce the torque that acts from outside.
  if (input.external_torque) torque -= signals::resample(*input.external_torque, motion.joints.q.time_s()).values();
  found.muscle_torque = TimeSeries(motion.joints.q.time_s(), std::move(columns), std::move(torque));
  found.uncarried = uncarried_time(source.study, spec, motion, found.generalized);
  if (found.uncarried)
    found.remarks.push_back({.code = RemarkCode::body_unsupported, .says = found.uncarried->sentence()});
  return found;
}

forces::MuscleForces shared_forces(const Study& study,
                                   const TrialInput& input,
                                   const TrialMotion& motion,
                                   const kinematics::MuscleKinematics& muscles,
                                   const std::vector<identification::RestingJoint>& resting,
                                   std::vector<Remark>& remarks) {
  const std::vector<std::string> coordinates = study_coordinates(study.model);
  forces::SharingInput sharing =
      forces::sharing_input(*motion.model, motion.joints, muscles, coordinates, input.loads ? &*input.loads : nullptr);
  add_notes(sharing.notes, remarks);
  Eigen::MatrixXd torque = sharing.torques.values();
  for (std::size_t j = 0; j < coordinates.size(); ++j) {
    const auto index = static_cast<std::size_t>(motion.model->coordinate_index(coordinates[j]));
    const Eigen::Index column =
        sharing.torques.find(dynamics::generalized_force_name(motion.model->coordinates[index])).value();
    if (input.external_torque)
      torque.col(column) -= signals::resample(*input.external_torque, motion.joints.q.time_s())
                                .values()
                                .col(static_cast<Eigen::Index>(j));
    const Eigen::VectorXd by_itself =
        resting_torque_nm(resting, coordinates[j], motion.joints.q.column(coordinates[j]));
    if (by_itself.size() > 0) torque.col(column) -= by_itself;
  }
  sharing.torques = TimeSeries(sharing.torques.time_s(), sharing.torques.channels(), std::move(torque));
  return forces::share(sharing, {.objective = study.sharing.objective,
                                 .exponent = study.sharing.exponent,
                                 .reserve_nm = study.sharing.reserve_nm});
}

StudyForces study_forces(const StudyInputs& inputs,
                         const StudyActivation& activation,
                         const std::vector<TrialMotion>& motion,
                         bool share,
                         const Progress& progress) {
  const Study& study = inputs.source.study;
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
    const bool passive = study.trials[i].use == Use::passive;
    trial.shared = shared_forces(study, inputs.trials[i], motion[i], trial.muscles,
                                 passive ? std::vector<identification::RestingJoint>{} : found.resting, trial.remarks);
    progress.tell(++done / (2.0 * static_cast<double>(motion.size())), study.trials[i].name);
  });
  return found;
}

}  // namespace myoid
