#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/simulation/arm.h"
#include "myoid/simulation/simulation.h"

namespace myoid::simulation {

/// Derivatives of a simulated movement by parameters of the arm: a row per output time, a column
/// per parameter, in SI units of the quantity over those of the parameter.
struct Sensitivities {
  math::OdeStatus status = math::OdeStatus::done;
  std::string message;  ///< One sentence.
  math::OdeStatistics statistics;
  std::vector<std::string> parameters;
  Eigen::VectorXd time_s;
  Eigen::MatrixXd angle, speed, acceleration;  ///< Of the elbow's flexion.
  Eigen::MatrixXd torque;                      ///< Of the muscles together.
  Eigen::MatrixXd device;                      ///< Of the device that moves the joint; else 0.
  std::vector<Eigen::MatrixXd> activation;     ///< Per muscle, here and below.
  std::vector<Eigen::MatrixXd> fiber_length;
  std::vector<Eigen::MatrixXd> tendon_force;
};

/// The derivatives of `simulate`'s result by the named parameters (arm_parameters.h, and
/// "start_angle", "start_speed": how it begins, with fibers in equilibrium unless given), carried
/// along by forward sensitivity equations, ds/dt = (df/dy) s + df/dp, whose right-hand side is
/// exact: the equations of motion in dual numbers. Those of the start too: fibers begin in
/// equilibrium, which depends on the parameters. The laws' kinks are continuous, so that the
/// sensitivities do not jump there. Throws as `simulate` does, and if a name is unknown; a
/// controller is refused, since its answers have no derivatives. Parameters are taken eight at a
/// time, spread over the threads; the result does not depend on their number.
[[nodiscard]] Sensitivities simulate_sensitivities(const Arm<double>& arm,
                                                   const SimulationInput& input,
                                                   const SimulationStart& start,
                                                   const SimulationOptions& options,
                                                   std::span<const std::string> parameters);

/// Standard deviations of independent measurements at every output time; 0: not measured.
struct MeasurementSpread {
  double angle_rad = 0.0;
  double torque_nm = 0.0;       ///< Of the muscles together.
  double device_nm = 0.0;       ///< At the dynamometer.
  double tendon_force_n = 0.0;  ///< Of every muscle.
  double fiber_length_m = 0.0;  ///< Of every muscle, as by ultrasound.
};

/// Fisher's information about the parameters in such measurements, sum of J' J / sd^2, parameters x
/// parameters, in SI units. Throws InvalidInput if a spread is negative, or nothing is measured.
[[nodiscard]] Eigen::MatrixXd information(const Sensitivities& sensitivities,
                                          const MeasurementSpread& spread);

}  // namespace myoid::simulation
