#include "myoid/simulation/arm_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"

namespace myoid::simulation {

std::vector<std::string> arm_parameter_names(const Arm<double>& arm) {
  std::vector<std::string> names;
  visit_arm_parameters(arm, [&](const auto& name, Unit, const double&) { names.emplace_back(name); });
  return names;
}

double& arm_parameter(Arm<double>& arm, std::string_view wanted) {
  double* found = nullptr;
  visit_arm_parameters(arm, [&](const auto& name, Unit, double& field) {
    if (name == wanted) found = &field;
  });
  if (found == nullptr) {
    throw InvalidInput(
        fmt::format("the arm has no parameter '{}'; there are {}", wanted, fmt::join(arm_parameter_names(arm), ", ")));
  }
  return *found;
}

}  // namespace myoid::simulation
