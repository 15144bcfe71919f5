#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/simulation/arm_dynamics.h"

namespace myoid::simulation {

/// The arm in the form that `SimulationRun` moves. A skeleton holds all values of one posture:
/// `set` first, then ask. Not to be shared by threads; its arm is not copied.
class HingeSkeleton {
 public:
  explicit HingeSkeleton(const ArmDynamics<double>& arm) : arm_(arm), paths_(arm.muscle_count()) {}

  [[nodiscard]] std::size_t coordinate_count() const { return 1; }
  [[nodiscard]] std::string coordinate_name(std::size_t) const { return "elbow_flexion"; }
  [[nodiscard]] bool is_rotational(std::size_t) const { return true; }
  [[nodiscard]] std::size_t muscle_count() const { return arm_.muscle_count(); }
  [[nodiscard]] const std::string& muscle_name(std::size_t i) const { return arm_.arm().muscles[i].name; }
  [[nodiscard]] const muscle::Musculotendon<double>& unit(std::size_t i) const { return arm_.unit(i); }
  [[nodiscard]] const muscle::ActivationDynamics<double>& activation(std::size_t i) const {
    return arm_.arm().muscles[i].activation;
  }

  void set(const double* q, const double* qdot) {
    q_ = q[0];
    qdot_ = qdot[0];
    for (std::size_t i = 0; i < paths_.size(); ++i) paths_[i] = travel(arm_.arm().muscles[i].path, q_);
    passive_ = muscle::joint_passive(arm_.arm().joint, q_, qdot_);
  }
  [[nodiscard]] double length_m(std::size_t i) const { return paths_[i].length_m; }
  [[nodiscard]] double velocity_mps(std::size_t i) const { return -paths_[i].moment_arm_m * qdot_; }
  [[nodiscard]] double moment_arm_m(std::size_t i, std::size_t) const { return paths_[i].moment_arm_m; }

  /// Computes accelerations under generalized forces `tau` (muscles and all other outside forces),
  /// in addition to gravity and the joints' own. A prescribed acceleration is read from `qddot`,
  /// and `device` gets the necessary force.
  void accelerate(const double* tau, const char* prescribed, double* qddot, double* device) const {
    const double all = tau[0] + arm_.gravity_torque_nm(q_) + passive_.torque_nm;
    device[0] = 0.0;
    if (prescribed[0] != 0) {
      device[0] = arm_.inertia_kgm2() * qddot[0] - all;
    } else {
      qddot[0] = all / arm_.inertia_kgm2();
    }
  }
  [[nodiscard]] double gravity(std::size_t) const { return arm_.gravity_torque_nm(q_); }
  [[nodiscard]] double joint_elastic(std::size_t) const { return passive_.elastic_torque_nm; }
  [[nodiscard]] double joint_viscous(std::size_t) const { return passive_.viscous_torque_nm; }
  [[nodiscard]] double kinetic_energy_j() const { return 0.5 * arm_.inertia_kgm2() * qdot_ * qdot_; }
  [[nodiscard]] double gravity_energy_j() const { return arm_.gravity_energy_j(q_); }
  [[nodiscard]] double joint_elastic_energy_j() const { return passive_.stored_energy_j; }

 private:
  const ArmDynamics<double>& arm_;
  double q_ = 0.0, qdot_ = 0.0;
  std::vector<HingeTravel<double>> paths_;
  muscle::JointPassiveOutput<double> passive_;
};

}  // namespace myoid::simulation
