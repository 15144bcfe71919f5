#include "myoid/body/forces/driven_frame.h"

#include <utility>

#include <fmt/format.h>

#include "myoid/body/dynamics/passive_forces.h"
#include "myoid/body/model/constraints.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/parallel.h"

namespace myoid::body {

DrivenState DrivenFrame::at_state(const Eigen::VectorXd& q,
                                  const Eigen::VectorXd& qdot,
                                  const Eigen::VectorXd& force,
                                  double time_s) {
  DrivenState result;
  result.q = body::assemble(model_, q).q;
  dynamics_.set(result.q, qdot, time_s);
  const body::BodyState& state = dynamics_.state();
  Eigen::VectorXd tau = Eigen::VectorXd::Zero(q.size());
  if (loads_ != nullptr) loads_->append_wrenches(state, time_s, result.wrenches);
  body::append_passive_forces(model_, state, tau, result.wrenches, time_s);
  // Actuators accelerate by their moment arms and load joints by their wrenches: in OpenSim's paths
  // these differ slightly.
  const std::vector<body::BodyWrench> others = result.wrenches;
  for (std::size_t k = 0; k < actuators_.size(); ++k) {
    const double f = force[static_cast<Eigen::Index>(k)];
    if (f == 0.0) continue;
    tau += f * columns_.of_unit_force(actuators_[k], state);
    columns_.append_wrenches(actuators_[k], f, state, result.wrenches);
  }
  const body::ForwardDynamics::Solution solution = dynamics_.solve(tau, others);
  result.qddot = solution.qddot;
  body::append_constraint_wrenches(model_, state, solution.multipliers, result.wrenches);
  return result;
}

Eigen::MatrixXd force_rows(const std::vector<Actuator>& actuators,
                           const body::JointMotion& motion,
                           const TimeSeries& forces) {
  const Eigen::Index frames = motion.sample_count();
  if (forces.sample_count() != frames) {
    throw InvalidInput(fmt::format("forces of {} frames for {} frames of motion", forces.sample_count(), frames));
  }
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(frames, static_cast<Eigen::Index>(actuators.size()));
  for (std::size_t k = 0; k < actuators.size(); ++k) {
    if (const auto column = forces.find(actuators[k].name))
      rows.col(static_cast<Eigen::Index>(k)) = forces.values().col(*column);
  }
  return rows;
}

Eigen::MatrixXd driven_accelerations(const body::BodyModel& model,
                                     const body::JointMotion& motion,
                                     const TimeSeries& forces,
                                     const DrivenOptions& options) {
  const std::vector<Actuator> actuators = actuators_of(model);
  const Eigen::MatrixXd force = force_rows(actuators, motion, forces);
  Eigen::MatrixXd qddot(motion.sample_count(), static_cast<Eigen::Index>(model.coordinates.size()));
  parallel_ranges<Eigen::Index>(motion.sample_count(), 8, [&](const auto& range) {
    DrivenFrame frame(model, actuators, options.loads);
    for (Eigen::Index i = range.begin(); i != range.end(); ++i) {
      options.progress.check();
      qddot.row(i) = frame
                         .at_state(motion.q.values().row(i).transpose(), motion.qdot.values().row(i).transpose(),
                                   force.row(i).transpose(), motion.q.time_s()[i])
                         .qddot.transpose();
    }
  });
  return qddot;
}

std::vector<JointLoads> joint_reactions(const body::BodyModel& model,
                                        const body::JointMotion& motion,
                                        const TimeSeries& forces,
                                        const DrivenOptions& options) {
  const std::vector<Actuator> actuators = actuators_of(model);
  const Eigen::MatrixXd force = force_rows(actuators, motion, forces);
  std::vector<JointLoads> result(at(motion.sample_count()));
  parallel_ranges<Eigen::Index>(motion.sample_count(), 8, [&](const auto& range) {
    DrivenFrame frame(model, actuators, options.loads);
    body::BodyState state = body::make_state(model);
    std::vector<body::BodyWrench> carried;
    for (Eigen::Index i = range.begin(); i != range.end(); ++i) {
      options.progress.check();
      const Eigen::VectorXd qdot = motion.qdot.values().row(i).transpose();
      const DrivenState driven =
          frame.at_state(motion.q.values().row(i).transpose(), qdot, force.row(i).transpose(), motion.q.time_s()[i]);
      (void)body::inverse_dynamics(model, driven.q, qdot, driven.qddot, driven.wrenches, state, &carried);
      JointLoads& loads = result[at(i)];
      loads.X_GB = state.X_GB;
      for (const body::Joint& joint : model.joints) {
        body::BodyWrench wrench = carried[at(joint.child)];
        // From the origin of the body to the origin of the joint's frame in it.
        const Vec3 arm_G = state.X_GB[at(joint.child)].R * joint.X_BM.p;
        wrench.m_G -= arm_G.cross(wrench.f_G);
        loads.on_child.push_back(wrench);
      }
    }
  });
  return result;
}

}  // namespace myoid::body
