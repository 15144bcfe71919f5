#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/simulation/simulation.h"

namespace myoid::body {

/// The rows of a simulation while it runs. Columns are in the order of the series of `Simulation`.
struct SimulationRecord {
  struct Coordinate {
    std::string name;
    bool rotational = true;
  };
  /// Works integrated for each muscle (active, passive, viscous, tendon, musculotendon, kinetic) and for all joints
  /// (gravity, joints' elastic and viscous parts, external).
  static constexpr std::size_t kMuscleWorks = 6, kJointWorks = 4;
  /// Columns for each coordinate: angle, speed, acceleration; torques of muscles, gravity, joint, external, device.
  static constexpr Eigen::Index kMotions = 3, kTorques = 5;
  /// Stored energies, behind the works: passive, tendon, kinetic for each muscle; kinetic, gravity, elastic together.
  static constexpr Eigen::Index kStored = 3, kStoredTogether = 3;

  SimulationRecord() = default;
  /// Makes room for `rows` rows; `energy` if works and energies are recorded.
  SimulationRecord(std::vector<std::string> muscle_names,
                   std::vector<Coordinate> coordinates_in_order,
                   std::size_t rows,
                   bool energy);

  /// Puts the series of the first rows, at these times [s], into the result.
  void write_to(Simulation& result, const Eigen::VectorXd& time_s) const;

  std::vector<std::string> muscles;
  std::vector<Coordinate> coordinates;
  Eigen::MatrixXd motion, torque, energy, moment_arm;
  Eigen::MatrixXd excitation, activation, length, velocity, fiber_length;
  Eigen::MatrixXd fiber_velocity, tendon_length, fiber_force, tendon_force;
};

}  // namespace myoid::body
