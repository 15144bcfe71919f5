#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/intervals/result.h"

namespace myoid::identification {

/// Returns the number of the fit's unknown that is this parameter of this muscle, alone or with
/// others: the label "BIC+BRA.max_isometric_force" is about BIC and BRA. Empty: it was held.
[[nodiscard]] std::optional<Eigen::Index> unknown_of(const IdentificationResult& method,
                                                     std::string_view muscle,
                                                     std::string_view parameter);

/// Returns the covariance of the logarithms of a muscle's numbers after the fit,
///
///   C_ij = R_ij (s_i / x_i) (s_j / x_j),
///
/// R the correlation of the fit's unknowns, s the standard errors as reported, x the estimates.
/// A number that was held, or has no standard error, has zeros. A number that is no unknown of the
/// fit itself, as V_sh V_shl behind a slope ratio, counts as uncorrelated. `names`: parameters, as
/// parameters.csv has them.
[[nodiscard]] Eigen::MatrixXd log_covariance(const IdentificationResult& method,
                                             const std::string& muscle,
                                             const std::vector<std::string>& names);

}  // namespace myoid::identification
