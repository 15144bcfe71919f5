#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/intervals/result.h"

namespace myoid {

/// Returns the covariance of the logarithms of a muscle's numbers after the fit,
///
///   C_ij = R_ij (s_i / x_i) (s_j / x_j),
///
/// R the correlation of the fit's unknowns, s the standard errors as reported, x the estimates.
/// A number that was held, or has no standard error, has zeros. A number that is no unknown of the
/// fit itself, as V_sh V_shl behind a slope ratio, counts as uncorrelated. `names`: parameters, as
/// parameters.csv has them.
[[nodiscard]] Eigen::MatrixXd log_covariance(const identification::IdentificationResult& method,
                                             const std::string& muscle,
                                             const std::vector<std::string>& names);

}  // namespace myoid
