#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/core/units.h"

namespace myoid {

/// A Gaussian belief about a parameter before the data: mean and standard deviation, in the
/// parameter's own unit, or of its natural logarithm if `logarithmic`.
struct Prior {
  double mean = 0.0;  ///< In the parameter's unit also when `logarithmic` (the median).
  double sd = 0.0;    ///< > 0. If `logarithmic`: of ln(value), hence a relative spread.
  bool logarithmic = false;

  friend bool operator==(const Prior&, const Prior&) = default;
};

/// One named number of a model. Names are unique in a set: "BIC.optimal_fiber_length".
struct Parameter {
  std::string name;
  Unit unit = Unit::dimensionless;
  double value = 0.0;
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool free = true;
  std::optional<Prior> prior;
};

/// An ordered list of parameters with unique names. Its free entries, in order, are the vector
/// that a solver sees.
class ParameterSet {
 public:
  ParameterSet() = default;

  /// Throws InvalidInput on a duplicate name, a value that is not finite or outside its bounds,
  /// lower > upper, or a prior whose sd is not positive.
  explicit ParameterSet(std::vector<Parameter> parameters);

  void add(Parameter parameter);  ///< Throws like the constructor.

  [[nodiscard]] const std::vector<Parameter>& all() const { return parameters_; }
  [[nodiscard]] std::size_t size() const { return parameters_.size(); }
  [[nodiscard]] bool contains(std::string_view name) const;
  [[nodiscard]] const Parameter& at(std::string_view name) const;  ///< Throws InvalidInput.
  [[nodiscard]] Parameter& at(std::string_view name);              ///< Throws InvalidInput.
  [[nodiscard]] double value(std::string_view name) const { return at(name).value; }

  /// Positions in `all()` of the free entries, in order.
  [[nodiscard]] std::vector<std::size_t> free_indices() const;
  [[nodiscard]] Eigen::VectorXd free_values() const;
  [[nodiscard]] Eigen::VectorXd free_lower() const;
  [[nodiscard]] Eigen::VectorXd free_upper() const;

  /// A copy whose free entries have these values. Throws InvalidInput if the size is wrong.
  [[nodiscard]] ParameterSet with_free_values(const Eigen::Ref<const Eigen::VectorXd>& x) const;

 private:
  std::vector<Parameter> parameters_;
};

}  // namespace myoid
