#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/intervals/result.h"

namespace myoid::run {

/// Returns the index of the fit's unknown for this parameter of this muscle, alone or tied: the
/// label "BIC+BRA.max_isometric_force" is that of BIC and BRA. Empty: the parameter is held.
[[nodiscard]] std::optional<Eigen::Index> unknown_of(const fit::IdentificationResult& method,
                                                     std::string_view muscle,
                                                     std::string_view parameter);

/// Returns the covariance of the logarithms of a muscle's numbers after the fit,
///
///   C_ij = R_ij (s_i / x_i) (s_j / x_j),
///
/// R the correlation of the fit's unknowns, s the standard errors as reported, x the estimates. A held number, or one
/// without a standard error, has zeros. A number that is no unknown of the fit itself, such as V_sh V_shl behind a
/// slope ratio, counts as uncorrelated. `names`: parameters as in parameters.csv.
[[nodiscard]] Eigen::MatrixXd log_covariance(const fit::IdentificationResult& method,
                                             const std::string& muscle,
                                             const std::vector<std::string>& names);

}  // namespace myoid::run
