#pragma once

#include <string>
#include <vector>

#include "myoid/body/simulation/simulation_model.h"
#include "myoid/program/steps/simulate.h"

namespace myoid::program {

/// Excitations of the muscles, and the simulated time [s].
struct Drive {
  std::vector<body::Signal> excitation;
  double start_s = 0.0, end_s = 1.0;
};

/// Reads the excitations of the file, or takes the descriptions. The simulated time is the call's,
/// else the time of the file, or one second.
[[nodiscard]] Drive read_drive(const SimulateOptions& options,
                               const std::vector<std::string>& muscles,
                               Remarks& remarks);

/// A coordinate; the options give the values of a rotation in degrees.
struct NamedCoordinate {
  std::string name;
  bool turns = true;
};

/// Sets the values, speeds and locks that the options name among the coordinates.
void place(const SimulateOptions& options,
           const std::vector<NamedCoordinate>& coordinates,
           body::SimulationStart& start,
           std::vector<body::Device>& devices);

/// Throws InvalidInput if the options place a coordinate that follows another by a coupler.
void refuse_followers(const SimulateOptions& options, const body::BodyModel& body);

/// Returns the parameters of the model that `sensitivity` names, each once, in their order.
[[nodiscard]] std::vector<std::string> wanted_parameters(const SimulateOptions& options,
                                                         const body::SimulationModel& model);

}  // namespace myoid::program
