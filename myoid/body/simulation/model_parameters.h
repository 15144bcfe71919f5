#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/body/simulation/simulation_model.h"

namespace myoid::body {

/// A number of a model that derivatives can be taken by, in SI units.
struct ModelParameter {
  std::string name;
  double* value = nullptr;  ///< In the model.
  bool may_be_negative = false;
};

/// Returns the numbers of a model in one fixed order: MUSCLE.<names of muscle::visit_parameters> and times of its
/// activation, COORDINATE.<numbers of its passive joint>, BODY.mass, .mass_center_x (y, z), .inertia_xx (yy, zz), and
/// gravity_x (y, z). Leaves out damping of 0, which is another law.
[[nodiscard]] std::vector<ModelParameter> model_parameters(SimulationModel& model);

/// Returns one number. Throws InvalidInput if there is none of this name.
[[nodiscard]] ModelParameter model_parameter(SimulationModel& model, std::string_view name);

}  // namespace myoid::body
