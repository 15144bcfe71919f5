#include "myoid/study/checks/relaxed_joint.h"

#include <cmath>

#include <fmt/format.h>

#include "myoid/ground/core/units.h"
#include "myoid/recording/signals/resample.h"
#include "myoid/study/intake/limits.h"

namespace myoid::study {

RelaxedJoint relaxed_joint(const std::vector<EffortTrial>& trials, const std::string& coordinate, double weight_nm) {
  RelaxedJoint joint;
  std::vector<double> angles, torques;
  for (const EffortTrial& trial : trials) {
    if (trial.spec->use != Use::passive || trial.external_torque == nullptr || trial.motion == nullptr) continue;
    const auto torque = trial.external_torque->find(coordinate + "_moment");
    const auto angle = trial.motion->find(coordinate);
    if (!torque || !angle) continue;
    joint.trials.push_back(trial.spec);
    const Eigen::VectorXd& t = trial.external_torque->time_s();
    const Eigen::VectorXd q = recording::resample(*trial.motion, t).values().col(*angle);
    const Eigen::VectorXd& of_motion_s = trial.motion->time_s();
    for (Eigen::Index i = 0; i < t.size(); ++i) {
      if (t[i] < of_motion_s[0] || t[i] > of_motion_s[of_motion_s.size() - 1]) continue;
      const double torque_nm = trial.external_torque->values()(i, *torque);
      if (!std::isfinite(torque_nm)) continue;
      angles.push_back(q[i]);
      torques.push_back(torque_nm);
    }
  }
  if (angles.size() < 2) return joint;
  const Eigen::Map<const Eigen::VectorXd> q(angles.data(), std::ssize(angles)), m(torques.data(), std::ssize(torques));
  joint.range_rad = q.maxCoeff() - q.minCoeff();
  if (joint.range_rad < kGateLimits.least_range_deg * kDegree) return joint;
  const Eigen::VectorXd dq = q.array() - q.mean(), dm = m.array() - m.mean();
  const double change_nm = dq.dot(dm) / dq.squaredNorm() * joint.range_rad;
  const bool follows = std::abs(dq.dot(dm)) > kLimits.joints.follows_at_rest * dq.norm() * dm.norm();
  if (follows && std::abs(change_nm) > kLimits.joints.dynamometer_weights * weight_nm) joint.change_nm = change_nm;
  return joint;
}

std::vector<Remark> yielding_joint(const RelaxedJoint& joint, const std::string& coordinate, double right_log_odds) {
  std::vector<Remark> found;
  if (!joint.yields()) return found;
  const bool torque_is_right = right_log_odds > kLimits.joints.certain_log_odds;
  for (const TrialSpec* trial : joint.trials)
    found.push_back(
        {.code = RemarkCode::dynamometer_sign,
         .severity = Severity::warning,
         .where = trial->name,
         .about = coordinate,
         .value = joint.change_nm,
         .says = fmt::format("over {:.0f} degrees of {} the torque of the surroundings on the relaxed joint falls by "
                             "{:.3g} N m as the angle rises: a joint at rest resists, and the torque rises",
                             joint.range_rad / kDegree, coordinate, -joint.change_nm),
         .remedy = torque_is_right
                       ? fmt::format("by the EMG {0}_moment has its right sign in the other trials: negate it in the "
                                     "relaxed trials alone, or negate {0} in all",
                                     coordinate)
                       : fmt::format("negate {0}, or {0}_moment, whichever is reversed", coordinate)});
  return found;
}

}  // namespace myoid::study
