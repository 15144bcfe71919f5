#include "myoid/muscle/isolated_values.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/nearest_word.h"

namespace myoid::muscle {

IsolatedField field_of(IsolatedModel& model, const std::string& wanted) {
  IsolatedField found;
  std::vector<std::string> names;
  visit_model(model, [&](std::string_view name, Unit unit, double& field) {
    names.emplace_back(name);
    if (name == wanted) found = {&field, unit};
  });
  if (found.value == nullptr)
    throw InvalidInput(fmt::format("a muscle has no '{}'{}", wanted, not_among(wanted, names)));
  return found;
}

double start_of(const IsolatedModel& model, const std::string& name) {
  IsolatedModel copy = model;
  const double value = *field_of(copy, name).value;
  if (name == "eccentric_plateau" && model.laws.velocity == VelocityLaw::millard)
    return model.millard.velocity.max_eccentric_multiplier;
  if (name == "passive_strain" && model.laws.passive == PassiveLaw::millard) return model.millard.passive.strain_at_one;
  return value;
}

Eigen::VectorXd logs_of(const IsolatedModel& model, const std::vector<std::string>& names) {
  Eigen::VectorXd logs(static_cast<Eigen::Index>(names.size()));
  for (std::size_t j = 0; j < names.size(); ++j)
    logs[static_cast<Eigen::Index>(j)] = std::log(start_of(model, names[j]));
  return logs;
}

IsolatedModel with_values(const IsolatedModel& start,
                          const std::vector<std::string>& names,
                          const Eigen::VectorXd& logs) {
  IsolatedModel model = start;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const double value = std::exp(logs[static_cast<Eigen::Index>(i)]);
    *field_of(model, names[i]).value = value;
    if (names[i] == "eccentric_plateau" && model.laws.velocity == VelocityLaw::millard)
      model.millard.velocity.max_eccentric_multiplier = value;
    if (names[i] == "passive_strain" && model.laws.passive == PassiveLaw::millard) {
      model.millard.passive.strain_at_one = value;
      model.millard.passive.stiffness_at_one = 2.0 / value;
    }
  }
  HillParameters<double>& hill = model.parameters.hill;
  if (std::ranges::find(names, "force_length_width") == names.end())
    hill.force_length_width_m *= hill.optimal_fiber_length_m / start.parameters.hill.optimal_fiber_length_m;
  return model;
}

}  // namespace myoid::muscle
