#include "myoid/run/resting_joints.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/body/kinematics/lumped_muscles.h"
#include "myoid/ground/core/error.h"
#include "myoid/study/intake/limits.h"
#include "myoid/study/study_model.h"

namespace myoid::run {

namespace {

/// Returns the torque of all the joint's muscles together: sum of the largest |r| times F_max.
double strength_nm(const study::Study& study,
                   const body::BodyModel& model,
                   const RelaxedTrial& trial,
                   const std::string& coordinate) {
  const Eigen::MatrixXd arms =
      body::lumped_moment_arm_m(*trial.muscles, study::muscle_groups(study, model), coordinate);
  const auto setups = study::muscle_setups(study, model);
  double sum = 0.0;
  for (Eigen::Index k = 0; k < arms.cols(); ++k)
    sum += arms.col(k).cwiseAbs().maxCoeff() * setups[static_cast<std::size_t>(k)].start.max_isometric_force_n;
  return sum;
}

/// Returns the reason why the torques of a passive trial exceed a relaxed joint's; empty if they do
/// not. The weight of limb and instrument is no resistance.
std::string too_strong(const study::Study& study, const body::BodyModel& model, const RelaxedTrial& trial) {
  const std::vector<std::string> coordinates = study::study_coordinates(study.model);
  for (std::size_t j = 0; j < coordinates.size(); ++j) {
    const std::string& name = coordinates[j];
    const Eigen::VectorXd torque = trial.muscle_torque->values().col(static_cast<Eigen::Index>(j));
    const double largest = torque.cwiseAbs().maxCoeff();
    const double beside = beside_weight(trial.q->column(name), torque).cwiseAbs().maxCoeff();
    const double strength = strength_nm(study, model, trial, name);
    const double limit = study::kLimits.joints.resting_share * strength;
    if (beside <= limit && largest <= limit + kLargestWeight_nm) continue;
    return fmt::format(
        "{} reaches {:.1f} N m, {:.1f} N m beside a weight's: more than {:g} % of its muscles' strength ({:.0f} N m) "
        "and {:g} N m of weight: no relaxed joint resists that much; N mm, or the instrument's offset?",
        name, largest, beside, 100.0 * study::kLimits.joints.resting_share, strength, kLargestWeight_nm);
  }
  return {};
}

/// Returns the reason why a passive trial does not show a relaxed joint; empty if it does.
std::string not_at_rest(const study::Study& study, const body::BodyModel& model, const RelaxedTrial& trial) {
  const bool mvc = study.emg.has_mvc;
  const double limit = mvc ? study::kLimits.joints.relaxed : study::kLimits.joints.relaxed_without_mvc;
  for (const Channel& channel : trial.activation->channels()) {
    const double mean = trial.activation->column(channel.name).mean();
    if (mean > limit) {
      return fmt::format(
          "the muscles were not at rest: EMG channel '{}' is on average at {:.1f} % of {}, at most {:g} % were "
          "expected",
          channel.name, 100.0 * mean, mvc ? "the maximal contraction" : "its greatest value in the study",
          100.0 * limit);
    }
  }
  return too_strong(study, model, trial);
}

Eigen::VectorXd joined(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  Eigen::VectorXd both(a.size() + b.size());
  both << a, b;
  return both;
}

}  // namespace

RestingJoints resting_joints(const study::Study& study,
                             const body::BodyModel& model,
                             const std::vector<RelaxedTrial>& trials) {
  RestingJoints found;
  std::vector<const RelaxedTrial*> relaxed;
  for (const RelaxedTrial& trial : trials) {
    if (!trial.spec->external_torque && !trial.spec->load_cell) continue;
    const std::string why = not_at_rest(study, model, trial);
    if (!why.empty()) {
      found.remarks.push_back({.code = RemarkCode::resting_torque,
                               .where = trial.spec->name,
                               .says = "the joint's resting torque is not taken from this trial: " + why});
      continue;
    }
    relaxed.push_back(&trial);
    if (trial.activation->empty())
      found.remarks.push_back(
          {.code = RemarkCode::resting_torque,
           .severity = Severity::note,
           .where = trial.spec->name,
           .says = "a relaxed joint by the study's word: no EMG shows that the muscles were at rest"});
  }
  const std::vector<std::string> coordinates = study::study_coordinates(study.model);
  for (std::size_t j = 0; j < coordinates.size(); ++j) {
    RestingJoint joint{.joint = coordinates[j], .torque = {}, .trials = {}};
    Eigen::VectorXd angle, velocity, torque;
    for (const RelaxedTrial* trial : relaxed) {
      angle = joined(angle, trial->q->column(joint.joint));
      velocity = joined(velocity, trial->qdot->column(joint.joint));
      torque = joined(torque, trial->muscle_torque->values().col(static_cast<Eigen::Index>(j)));
      joint.trials.push_back(trial->spec->name);
    }
    const auto fit = fit_resting_torque(angle, velocity, torque);
    if (!fit) continue;
    joint.torque = *fit;
    found.joints.push_back(std::move(joint));
  }
  return found;
}

Eigen::VectorXd resting_torque_nm(const std::vector<RestingJoint>& joints,
                                  const std::string& coordinate,
                                  const TimeSeries& q) {
  const auto found = std::ranges::find_if(joints, [&](const RestingJoint& joint) { return joint.joint == coordinate; });
  if (found == joints.end()) return {};
  const auto angle = q.find(coordinate);
  if (!angle)
    throw InvalidInput(
        fmt::format("the resting torque of {} was measured and depends on its angle: give 'motion' to "
                    "every trial",
                    coordinate));
  return found->torque.at(Eigen::VectorXd(q.values().col(*angle)));
}

}  // namespace myoid::run
