#include "myoid/body/model/body_accelerations.h"

#include "myoid/body/model/joint_posture.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {

PointMotion BodyAccelerations::of_station(const BodyState& state, BodyIndex body, const Vec3& p_BP) const {
  const std::size_t b = at(body);
  const Vec3 r = state.X_GB[b].R * p_BP;
  const Vec3& w = state.w_GB[b];
  return {state.X_GB[b] * p_BP, state.v_GB[b] + w.cross(r), a_GB[b] + alpha_GB[b].cross(r) + w.cross(w.cross(r))};
}

void compute_accelerations(const BodyModel& model,
                           const Eigen::Ref<const Eigen::VectorXd>& qddot,
                           const BodyState& state,
                           BodyAccelerations& result,
                           const Vec3& a_ground) {
  result.alpha_GB.assign(model.bodies.size(), Vec3::Zero());
  result.a_GB.assign(model.bodies.size(), a_ground);
  for (const Joint& joint : model.joints) {
    const std::size_t b = at(joint.child);
    const std::size_t parent = at(joint.parent);
    const JointPosture p = joint_posture(joint, state.q);
    const Pose X_GF = state.X_GB[parent] * joint.X_PF;
    const Vec3 p_GM = X_GF * p.X_FM.p;
    const bool by_coordinates = model.compat.axes_carried_by_coordinates && joint.class_name == "CustomJoint";
    const RelativeMotion m = relative_motion(joint, by_coordinates, p, state.qdot, qddot);
    const Vec3& w_P = state.w_GB[parent];
    const Vec3 rho = p_GM - state.X_GB[parent].p;
    const Vec3 w_rel = X_GF.R * m.w;
    const Vec3 v_rel = X_GF.R * m.v;
    result.alpha_GB[b] = result.alpha_GB[parent] + w_P.cross(w_rel) + X_GF.R * m.alpha;
    const Vec3 a_M = result.a_GB[parent] + result.alpha_GB[parent].cross(rho) + w_P.cross(w_P.cross(rho)) +
                     2.0 * w_P.cross(v_rel) + X_GF.R * m.a;
    const Vec3 r = state.X_GB[b].p - p_GM;
    const Vec3& w = state.w_GB[b];
    result.a_GB[b] = a_M + result.alpha_GB[b].cross(r) + w.cross(w.cross(r));
  }
}

}  // namespace myoid::body
