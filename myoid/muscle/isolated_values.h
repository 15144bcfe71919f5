#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/units.h"
#include "myoid/muscle/fit_isolated.h"

namespace myoid::muscle {

/// A number of a model, in SI units.
struct IsolatedField {
  double* value = nullptr;
  Unit unit = Unit::dimensionless;
};

/// Returns the field of this name; throws InvalidInput with all names if there is none.
[[nodiscard]] IsolatedField field_of(IsolatedModel& model, const std::string& name);

/// Returns the starting value of a parameter: under Millard's curves that of the curve.
[[nodiscard]] double start_of(const IsolatedModel& model, const std::string& name);

/// Returns the logarithms of the starting values.
[[nodiscard]] Eigen::VectorXd logs_of(const IsolatedModel& model, const std::vector<std::string>& names);

/// Returns the model with the values of these logarithms. force_length_width keeps its share of optimal_fiber_length
/// unless it is among the names.
[[nodiscard]] IsolatedModel with_values(const IsolatedModel& start,
                                        const std::vector<std::string>& names,
                                        const Eigen::VectorXd& logs);

}  // namespace myoid::muscle
