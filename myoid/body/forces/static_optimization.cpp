#include "myoid/body/forces/static_optimization.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/dynamics/passive_forces.h"
#include "myoid/body/forces/actuator_columns.h"
#include "myoid/body/forces/actuator_sharing.h"
#include "myoid/body/forces/opensim_muscle.h"
#include "myoid/body/kinematics/angular_speeds.h"
#include "myoid/body/model/constraints.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/motion_constraints.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/math/decompositions.h"

namespace myoid::body {
namespace {

/// Work space of a frame, reused for the next; one per thread.
class SharedFrame {
 public:
  SharedFrame(const body::BodyModel& model,
              const std::vector<Actuator>& actuators,
              const std::vector<OpensimMuscle>& muscles,
              const StaticOptimizationOptions& options)
      : model_(model),
        actuators_(actuators),
        muscles_(muscles),
        options_(options),
        state_(body::make_state(model)),
        columns_(model) {
    for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
      if (!model.is_constrained(static_cast<int>(c))) free_.push_back(static_cast<Eigen::Index>(c));
    }
  }

  /// Returns the problem at one instant; `strength` receives the force of each actuator at control
  /// 1.
  ActuatorProblem problem(
      Eigen::VectorXd q, const Eigen::VectorXd& u, Eigen::VectorXd udot, double time_s, Eigen::VectorXd& strength) {
    if (!model_.constraints.empty() || !model_.couplers.empty()) q = body::assemble(model_, q).q;
    const Eigen::MatrixXd T = constrain(q, u, time_s, udot);
    body::compute_poses(model_, q, state_);
    body::compute_velocities(model_, u, state_);
    wrenches_.clear();
    Eigen::VectorXd passive = Eigen::VectorXd::Zero(q.size());
    if (options_.loads != nullptr) options_.loads->append_wrenches(state_, time_s, wrenches_);
    if (!model_.passive_forces.empty()) body::append_passive_forces(model_, state_, passive, wrenches_, time_s);
    const Eigen::VectorXd required = body::inverse_dynamics(model_, q, u, udot, wrenches_, state_) - passive;
    const auto n = static_cast<Eigen::Index>(actuators_.size());
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(q.size(), n);
    strength.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) strength[i] = column(actuators_[at(i)], columns, i);
    ActuatorProblem p;
    p.forces = T.transpose() * columns;
    p.required = T.transpose() * required;
    p.lower.resize(n);
    p.upper.resize(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      p.lower[i] = actuators_[at(i)].lower;
      p.upper[i] = actuators_[at(i)].upper;
    }
    p.exponent = options_.exponent;
    return p;
  }

 private:
  /// Returns a basis of the speeds that the constraints allow, and adapts udot to the constraints.
  Eigen::MatrixXd constrain(const Eigen::VectorXd& q, const Eigen::VectorXd& u, double time_s, Eigen::VectorXd& udot) {
    const Eigen::Index nq = q.size();
    for (Eigen::Index c = 0; c < nq; ++c)
      if (model_.coordinates[at(c)].locked) udot[c] = 0.0;
    if (model_.constraints.empty()) {
      Eigen::MatrixXd T = Eigen::MatrixXd::Identity(nq, nq)(Eigen::all, free_);
      // Chains of couplers need as many rounds as there are couplers.
      for (std::size_t round = 0; round < model_.couplers.size(); ++round) {
        for (const body::CoordinateCoupler& c : model_.couplers) {
          const body::FunctionValue f = evaluate(c.function, q[c.independent]);
          T.row(c.dependent) = f.first * T.row(c.independent);
          udot[c.dependent] = f.first * udot[c.independent] + f.second * u[c.independent] * u[c.independent];
        }
      }
      return T;
    }
    // A udot = b, with the other accelerations as near to their targets as possible.
    body::compute_poses(model_, q, state_);
    body::compute_velocities(model_, u, state_);
    const auto [A, b] = body::acceleration_constraints(model_, state_, time_s);
    udot += math::shortest_solution(A, b - A * udot);
    return math::null_space(A);
  }

  /// Computes the generalized force of an actuator at control 1; returns its force.
  double column(const Actuator& a, Eigen::MatrixXd& columns, Eigen::Index i) {
    double force = a.strength;
    columns.col(i) = columns_.of_unit_force(a, state_);
    if (a.kind == Actuator::Kind::muscle && options_.muscle_physiology) {
      const body::PathResult& path = columns_.path();
      force = muscles_[a.index].optimal_force(path.length_m, path.speed_mps);
    }
    columns.col(i) *= force;
    if (std::isfinite(force) && columns.col(i).allFinite()) return force;
    columns.col(i).setZero();  // an actuator without a path does not pull
    return 0.0;
  }

  const body::BodyModel& model_;
  const std::vector<Actuator>& actuators_;
  const std::vector<OpensimMuscle>& muscles_;
  const StaticOptimizationOptions& options_;
  body::BodyState state_;
  std::vector<Eigen::Index> free_;
  std::vector<body::BodyWrench> wrenches_;
  ActuatorColumns columns_;
};

}  // namespace

StaticOptimizationResult static_optimization(const body::BodyModel& model,
                                             const body::JointMotion& asked,
                                             const StaticOptimizationOptions& options) {
  const body::JointMotion motion = body::moved_by_speeds(model, asked);
  const std::vector<Actuator> actuators = actuators_of(model);
  if (actuators.empty()) throw ModelError("static optimization: the model has neither muscles nor actuators");
  StaticOptimizationResult result;
  std::vector<OpensimMuscle> muscles;
  for (const body::Muscle& muscle : model.muscles) {
    muscles.emplace_back(muscle, model.compat);
    if (!muscles.back().has_own_curves() && muscle.applies_force && options.muscle_physiology) {
      result.notes.push_back(
          {.severity = Severity::note,
           .says = fmt::format("muscle '{}' of class {}: its strength is that of Thelen's curves with a rigid tendon",
                               muscle.name, muscle.class_name)});
    }
  }
  const Eigen::Index frames = motion.sample_count();
  const auto count = static_cast<Eigen::Index>(actuators.size());
  Eigen::MatrixXd control(frames, count), force(frames, count);
  result.kkt_residual.resize(frames);
  std::vector<char> feasible(at(frames), 1), certified(at(frames), 1);
  parallel_ranges<Eigen::Index>(frames, 8, [&](const auto& range) {
    SharedFrame frame(model, actuators, muscles, options);
    Eigen::VectorXd strength;
    for (Eigen::Index i = range.begin(); i != range.end(); ++i) {
      options.progress.check();
      const ActuatorProblem problem =
          frame.problem(motion.q.values().row(i).transpose(), motion.qdot.values().row(i).transpose(),
                        motion.qddot.values().row(i).transpose(), motion.q.time_s()[i], strength);
      const ActuatorSolution solution = solve_actuators(problem);
      if (options.inspect) options.inspect(i, problem, solution);
      control.row(i) = solution.control.transpose();
      force.row(i) = solution.control.cwiseProduct(strength).transpose();
      result.kkt_residual[i] = solution.kkt_residual;
      feasible[at(i)] = solution.feasible ? 1 : 0;
      certified[at(i)] = solution.solved ? 1 : 0;
    }
  });
  result.is_feasible.assign(feasible.begin(), feasible.end());
  result.is_certified.assign(certified.begin(), certified.end());
  result.frames_failed = static_cast<int>(std::count(result.is_certified.begin(), result.is_certified.end(), false));
  std::vector<Channel> controls, forces;
  for (const Actuator& a : actuators) {
    controls.push_back({a.name, Unit::dimensionless});
    forces.push_back({a.name, Unit::newton});
  }
  result.control = TimeSeries(motion.q.time_s(), std::move(controls), std::move(control));
  result.force = TimeSeries(motion.q.time_s(), std::move(forces), std::move(force));
  return result;
}

}  // namespace myoid::body
