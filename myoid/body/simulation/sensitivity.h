#pragma once

#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/body/simulation/simulation.h"
#include "myoid/body/simulation/simulation_model.h"

namespace myoid::body {

/// Derivatives of one quantity: one row per output time, one column per parameter, in SI units of the quantity over
/// those of the parameter.
struct Sensitivity {
  std::string quantity;
  Eigen::MatrixXd by_parameter;
};

/// Derivatives of a simulated movement by parameters of the model.
struct Sensitivities {
  math::OdeStatus status = math::OdeStatus::done;
  std::string message;  ///< One sentence.
  std::vector<std::string> parameters;
  Eigen::VectorXd time_s;
  /// COORDINATE, COORDINATE_speed, COORDINATE_acceleration, COORDINATE_muscles (their torque), COORDINATE_device (the
  /// torque of the device that moves it), MUSCLE_activation, MUSCLE_fiber_length, MUSCLE_tendon_force.
  std::vector<Sensitivity> of;

  /// Returns the derivatives of a quantity. Throws InvalidInput if there is none of this name.
  [[nodiscard]] const Eigen::MatrixXd& operator[](std::string_view quantity) const;
};

/// Returns the names of all parameters: those of `model_parameters`, and COORDINATE.start, COORDINATE.start_speed.
[[nodiscard]] std::vector<std::string> sensitivity_names(SimulationModel model);

/// Computes the derivatives of `simulate`'s result by the named parameters by forward sensitivity equations, integrated
/// along with the states:
///
///   ds/dt = (f(y + h s, p + h) - f(y - h s, p - h)) / (2 h)
///
/// with h = 1e-4 of the parameter (of its unit if it is 0). Instead of h and -h, a parameter of 0 that may not be
/// negative is 2 h and 0. Derivatives of the start are included: unless given, fibers begin in equilibrium, which
/// depends on the parameters. The laws are continuous at their kinks, so that the sensitivities do not jump there.
/// Throws as `simulate` does, and if a name is unknown. Threads take eight parameters at a time; the result does not
/// depend on the number of threads.
[[nodiscard]] Sensitivities simulate_sensitivities(const SimulationModel& model,
                                                   const SimulationInput& input,
                                                   const SimulationStart& start,
                                                   const SimulationOptions& options,
                                                   std::span<const std::string> parameters);

}  // namespace myoid::body
