#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/model/muscle_path.h"
#include "myoid/body/simulation/simulation_model.h"
#include "myoid/body/simulation/tree_dynamics.h"

namespace myoid::body {

/// Paths, joints and equations of motion of a model at one posture: `set` first, then ask. It reads the model, which
/// must outlive it. Not to be shared by threads.
class Skeleton {
 public:
  explicit Skeleton(const SimulationModel& model);

  [[nodiscard]] std::size_t coordinate_count() const { return model_->body.coordinates.size(); }
  [[nodiscard]] std::size_t muscle_count() const { return units_.size(); }
  [[nodiscard]] const muscle::Musculotendon<double>& unit(std::size_t i) const { return units_[i]; }

  void set(const double* q, const double* qdot);
  [[nodiscard]] double length_m(std::size_t i) const { return paths_[i].length_m; }
  [[nodiscard]] double velocity_mps(std::size_t i) const { return paths_[i].speed_mps; }
  [[nodiscard]] double moment_arm_m(std::size_t i, std::size_t k) const {
    return paths_[i].moment_arm_m[static_cast<Eigen::Index>(k)];
  }

  /// Computes accelerations under generalized forces `tau` (muscles and all other outside forces), in addition to
  /// gravity and the joints' own. A prescribed acceleration is read from `qddot`, and `device` gets the necessary
  /// force. Throws ModelError if the mass matrix of the free coordinates is not positive definite.
  void accelerate(const double* tau, const char* prescribed, double* qddot, double* device);
  [[nodiscard]] double gravity(std::size_t k) const { return dynamics_.gravity()[static_cast<Eigen::Index>(k)]; }
  [[nodiscard]] double joint_elastic(std::size_t k) const { return passive_[k].elastic_torque_nm; }
  /// Includes the model's other passive forces, whose energies are not counted.
  [[nodiscard]] double joint_viscous(std::size_t k) const { return passive_[k].viscous_torque_nm + other(k); }
  [[nodiscard]] double kinetic_energy_j() const { return dynamics_.kinetic_energy_j(); }
  [[nodiscard]] double gravity_energy_j() const { return dynamics_.gravity_energy_j(); }
  [[nodiscard]] double joint_elastic_energy_j() const;

 private:
  [[nodiscard]] double other(std::size_t k) const {
    return model_->body.passive_forces.empty() ? 0.0 : others_[static_cast<Eigen::Index>(k)];
  }

  const SimulationModel* model_;
  TreeDynamics dynamics_;
  std::vector<muscle::Musculotendon<double>> units_;
  Eigen::VectorXd q_, qdot_;
  body::PathWorkspace workspace_;
  std::vector<body::PathResult> paths_;
  std::vector<muscle::JointPassiveOutput<double>> passive_;
  std::vector<double> forces_;
  Eigen::VectorXd others_;  ///< Generalized forces of the model's passive forces.
  std::vector<body::BodyWrench> wrenches_;
};

}  // namespace myoid::body
