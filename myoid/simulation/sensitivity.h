#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/simulation/arm.h"
#include "myoid/simulation/simulation.h"

namespace myoid::simulation {

/// Derivatives of a simulated movement by parameters of the arm: one row per output time, one
/// column per parameter, in SI units of the quantity over those of the parameter.
struct Sensitivities {
  math::OdeStatus status = math::OdeStatus::done;
  std::string message;  ///< One sentence.
  math::OdeStatistics statistics;
  std::vector<std::string> parameters;
  Eigen::VectorXd time_s;
  Eigen::MatrixXd angle, speed, acceleration;  ///< Sensitivities of elbow flexion.
  Eigen::MatrixXd torque;                      ///< Torque of all muscles together.
  Eigen::MatrixXd device;                      ///< Torque of the device that moves the joint; 0 without one.
  std::vector<Eigen::MatrixXd> activation;     ///< One matrix per muscle, here and below.
  std::vector<Eigen::MatrixXd> fiber_length;
  std::vector<Eigen::MatrixXd> tendon_force;
};

/// Computes the derivatives of `simulate`'s result by the named parameters (arm_parameters.h, and "start_angle",
/// "start_speed") by forward sensitivity equations, ds/dt = (df/dy) s + df/dp. The right-hand side is exact: the
/// equations of motion in dual numbers. Derivatives of the start are included: unless given, fibers begin in
/// equilibrium, which depends on the parameters. The laws are continuous at their kinks, so that the sensitivities do
/// not jump there. Throws as `simulate` does, if a name is unknown, and for a controller, whose answers have no
/// derivatives. Threads take eight parameters at a time; the result does not depend on the number of threads.
[[nodiscard]] Sensitivities simulate_sensitivities(const Arm<double>& arm,
                                                   const SimulationInput& input,
                                                   const SimulationStart& start,
                                                   const SimulationOptions& options,
                                                   std::span<const std::string> parameters);

/// Standard deviations of independent measurements at every output time; 0: not measured.
struct MeasurementSpread {
  double angle_rad = 0.0;
  double torque_nm = 0.0;       ///< Torque of all muscles together.
  double device_nm = 0.0;       ///< Torque at the dynamometer.
  double tendon_force_n = 0.0;  ///< Tendon force of every muscle.
  double fiber_length_m = 0.0;  ///< Fiber length of every muscle, as by ultrasound.
};

/// Returns Fisher's information about the parameters in such measurements, sum of J' J / sd^2,
/// parameters x parameters, in SI units. Throws InvalidInput if a spread is negative or all are 0.
[[nodiscard]] Eigen::MatrixXd information(const Sensitivities& sensitivities, const MeasurementSpread& spread);

}  // namespace myoid::simulation
