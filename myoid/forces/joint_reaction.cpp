#include "myoid/forces/joint_reaction.h"

#include <utility>

#include <Eigen/QR>
#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/index.h"
#include "myoid/core/parallel.h"
#include "myoid/dynamics/passive_forces.h"
#include "myoid/forces/actuator_columns.h"
#include "myoid/model/constraints.h"

namespace myoid::forces {
namespace {

/// One frame after the other; one per thread.
class ReactionFrame {
 public:
  ReactionFrame(const model::BodyModel& model,
                const std::vector<Actuator>& actuators,
                const JointReactionOptions& options)
      : model_(model),
        actuators_(actuators),
        options_(options),
        state_(model::make_state(model)),
        columns_(model) {}

  JointLoads loads(Eigen::VectorXd q,
                   const Eigen::VectorXd& u,
                   const Eigen::VectorXd& force,
                   double time_s) {
    q = model::assemble(model_, q).q;
    model::compute_poses(model_, q, state_);
    model::compute_velocities(model_, u, state_);
    Eigen::VectorXd tau = Eigen::VectorXd::Zero(q.size());
    std::vector<model::BodyWrench> wrenches;
    if (options_.loads != nullptr) options_.loads->append_wrenches(state_, time_s, wrenches);
    dynamics::append_passive_forces(model_, state_, tau, wrenches, time_s);
    std::vector<model::BodyWrench> all = wrenches;
    for (std::size_t k = 0; k < actuators_.size(); ++k) {
      const double f = force[static_cast<Eigen::Index>(k)];
      if (f == 0.0) continue;
      tau += f * columns_.of_unit_force(actuators_[k], state_);
      columns_.append_wrenches(actuators_[k], f, state_, all);
    }
    const Eigen::VectorXd udot = accelerations(q, u, tau, wrenches, time_s);
    std::vector<model::BodyWrench> carried;
    (void)model::inverse_dynamics(model_, q, u, udot, all, state_, &carried);
    JointLoads result;
    result.X_GB = state_.X_GB;
    for (const model::Joint& joint : model_.joints) {
      model::BodyWrench wrench = carried[at(joint.child)];
      // From the origin of the body to that of the joint's frame in it.
      const Vec3 arm_G = state_.X_GB[at(joint.child)].R * joint.X_BM.p;
      wrench.m_G -= arm_G.cross(wrench.f_G);
      result.on_child.push_back(wrench);
    }
    return result;
  }

 private:
  /// M udot = tau - bias + A' lambda, A udot = b.
  Eigen::VectorXd accelerations(const Eigen::VectorXd& q,
                                const Eigen::VectorXd& u,
                                const Eigen::VectorXd& tau,
                                const std::vector<model::BodyWrench>& wrenches,
                                double time_s) {
    const Eigen::Index n = q.size();
    const Eigen::VectorXd rest = Eigen::VectorXd::Zero(n);
    const Eigen::VectorXd weight = model::inverse_dynamics(model_, q, rest, rest, {}, state_);
    const Eigen::VectorXd bias = model::inverse_dynamics(model_, q, u, rest, wrenches, state_);
    std::vector<Eigen::Index> fixed;
    for (Eigen::Index c = 0; c < n; ++c) {
      const model::Coordinate& k = model_.coordinates[at(c)];
      if (k.locked || k.prescribed) fixed.push_back(c);
    }
    const auto couplers = static_cast<Eigen::Index>(model_.couplers.size());
    const Eigen::Index rows = couplers + static_cast<Eigen::Index>(fixed.size());
    Eigen::MatrixXd kkt = Eigen::MatrixXd::Zero(n + rows, n + rows);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + rows);
    for (Eigen::Index k = 0; k < n; ++k) {
      kkt.col(k).head(n) =
          model::inverse_dynamics(model_, q, rest, Eigen::VectorXd::Unit(n, k), {}, state_) -
          weight;
    }
    right.head(n) = tau - bias;
    for (Eigen::Index k = 0; k < couplers; ++k) {
      const model::CoordinateCoupler& c = model_.couplers[at(k)];
      const model::FunctionValue f = evaluate(c.function, q[c.independent]);
      kkt(n + k, c.dependent) = 1.0;
      kkt(n + k, c.independent) = -f.first;
      right[n + k] = f.second * u[c.independent] * u[c.independent];
    }
    for (std::size_t k = 0; k < fixed.size(); ++k) {
      const Eigen::Index row = n + couplers + static_cast<Eigen::Index>(k);
      const model::Coordinate& coordinate = model_.coordinates[at(fixed[k])];
      kkt(row, fixed[k]) = 1.0;
      if (coordinate.prescribed && !coordinate.locked)
        right[row] = evaluate(*coordinate.prescribed, time_s).second;
    }
    kkt.topRightCorner(n, rows) = kkt.bottomLeftCorner(rows, n).transpose();
    model::compute_velocities(model_, u, state_);
    return kkt.completeOrthogonalDecomposition().solve(right).head(n);
  }

  const model::BodyModel& model_;
  const std::vector<Actuator>& actuators_;
  const JointReactionOptions& options_;
  model::BodyState state_;
  ActuatorColumns columns_;
};

}  // namespace

std::vector<JointLoads> joint_reactions(const model::BodyModel& model,
                                        const kinematics::JointMotion& motion,
                                        const TimeSeries& forces,
                                        const JointReactionOptions& options) {
  if (!model.constraints.empty()) {
    throw ModelError(
        fmt::format("joint reactions: the joints form closed loops (constraint '{}'), in which the "
                    "forces of the constraints are not known one by one",
                    model.constraints[0].name));
  }
  const Eigen::Index frames = motion.sample_count();
  if (forces.sample_count() != frames) {
    throw InvalidInput(fmt::format("joint reactions: forces of {} frames for {} frames of motion",
                                   forces.sample_count(), frames));
  }
  const std::vector<Actuator> actuators = actuators_of(model);
  Eigen::MatrixXd table =
      Eigen::MatrixXd::Zero(frames, static_cast<Eigen::Index>(actuators.size()));
  for (std::size_t k = 0; k < actuators.size(); ++k) {
    if (const auto column = forces.find(actuators[k].name))
      table.col(static_cast<Eigen::Index>(k)) = forces.values().col(*column);
  }
  std::vector<JointLoads> result(at(frames));
  parallel_ranges<Eigen::Index>(frames, 8, [&](const auto& range) {
    ReactionFrame frame(model, actuators, options);
    for (Eigen::Index i = range.begin(); i != range.end(); ++i) {
      options.progress.check();
      result[at(i)] =
          frame.loads(motion.q.values().row(i).transpose(), motion.qdot.values().row(i).transpose(),
                      table.row(i).transpose(), motion.q.time_s()[i]);
    }
  });
  return result;
}

}  // namespace myoid::forces
