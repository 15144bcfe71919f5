#include "myoid/forces/joint_reaction.h"

#include "myoid/core/index.h"
#include "myoid/core/parallel.h"
#include "myoid/forces/driven_frame.h"

namespace myoid::forces {

std::vector<JointLoads> joint_reactions(const model::BodyModel& model,
                                        const kinematics::JointMotion& motion,
                                        const TimeSeries& forces,
                                        const DrivenOptions& options) {
  const std::vector<Actuator> actuators = actuators_of(model);
  const Eigen::MatrixXd force = force_rows(actuators, motion, forces);
  std::vector<JointLoads> result(at(motion.sample_count()));
  parallel_ranges<Eigen::Index>(motion.sample_count(), 8, [&](const auto& range) {
    DrivenFrame frame(model, actuators, options.loads);
    model::BodyState state = model::make_state(model);
    std::vector<model::BodyWrench> carried;
    for (Eigen::Index i = range.begin(); i != range.end(); ++i) {
      options.progress.check();
      const Eigen::VectorXd qdot = motion.qdot.values().row(i).transpose();
      const DrivenState driven =
          frame.at_state(motion.q.values().row(i).transpose(), qdot, force.row(i).transpose(), motion.q.time_s()[i]);
      (void)model::inverse_dynamics(model, driven.q, qdot, driven.qddot, driven.wrenches, state, &carried);
      JointLoads& loads = result[at(i)];
      loads.X_GB = state.X_GB;
      for (const model::Joint& joint : model.joints) {
        model::BodyWrench wrench = carried[at(joint.child)];
        // From the origin of the body to the origin of the joint's frame in it.
        const Vec3 arm_G = state.X_GB[at(joint.child)].R * joint.X_BM.p;
        wrench.m_G -= arm_G.cross(wrench.f_G);
        loads.on_child.push_back(wrench);
      }
    }
  });
  return result;
}

}  // namespace myoid::forces
