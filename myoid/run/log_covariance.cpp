#include "myoid/run/log_covariance.h"

#include <cmath>

namespace myoid::run {
namespace {

/// Returns the reported standard error over the estimate; 0 without one.
double relative_error(const fit::IdentificationResult& method, std::string_view muscle, std::string_view parameter) {
  for (const fit::ParameterEstimate& e : method.estimates) {
    if (e.muscle == muscle && e.parameter == parameter && e.std_error && e.estimate != 0.0)
      return *e.std_error / std::abs(e.estimate);
  }
  return 0.0;
}

}  // namespace

std::optional<Eigen::Index> unknown_of(const fit::IdentificationResult& method,
                                       std::string_view muscle,
                                       std::string_view parameter) {
  for (std::size_t k = 0; k < method.free_parameters.size(); ++k) {
    const std::string_view label = method.free_parameters[k];
    const std::size_t dot = label.rfind('.');
    if (dot == std::string_view::npos || label.substr(dot + 1) != parameter) continue;
    std::string_view owners = label.substr(0, dot);
    while (true) {
      const std::size_t plus = owners.find('+');
      if (owners.substr(0, plus) == muscle) return static_cast<Eigen::Index>(k);
      if (plus == std::string_view::npos) break;
      owners.remove_prefix(plus + 1);
    }
  }
  return std::nullopt;
}

Eigen::MatrixXd log_covariance(const fit::IdentificationResult& method,
                               const std::string& muscle,
                               const std::vector<std::string>& names) {
  const auto n = static_cast<Eigen::Index>(names.size());
  Eigen::VectorXd spread(n);
  std::vector<std::optional<Eigen::Index>> rows;
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::string& name = names[static_cast<std::size_t>(i)];
    spread[i] = relative_error(method, muscle, name);
    rows.push_back(unknown_of(method, muscle, name));
  }
  Eigen::MatrixXd covariance = spread.cwiseAbs2().asDiagonal();
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const auto a = rows[static_cast<std::size_t>(i)], b = rows[static_cast<std::size_t>(j)];
      if (i == j || !a || !b || *a >= method.covariance.rows() || *b >= method.covariance.rows()) continue;
      const double size = std::sqrt(method.covariance(*a, *a) * method.covariance(*b, *b));
      if (size > 0.0) covariance(i, j) = method.covariance(*a, *b) / size * spread[i] * spread[j];
    }
  }
  return covariance;
}

}  // namespace myoid::run
