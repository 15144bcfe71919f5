#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/identification/parameters.h"
#include "myoid/intervals/result.h"
#include "myoid/intervals/uncertainty.h"

namespace myoid::identification {

/// Indices of V_sh, V_ml and the slope ratio S of a muscle among the unknowns; -1: no unknown.
struct ProductPositions {
  Eigen::Index curvature = -1, plateau = -1, ratio = -1;
};

/// Fills interval, standard error, prior and shrinkage of P = V_sh V_shl, which follows from three
/// unknowns, by draws of (ln V_sh, V_ml, ln S) about the solution `z`. Does nothing if one of the
/// three is no unknown. `bootstrap` may be null.
void add_product_interval(ParameterEstimate& e,
                          const ProductPositions& where,
                          const std::vector<Unknown>& free,
                          const Eigen::VectorXd& z,
                          const Eigen::MatrixXd& covariance,
                          const BootstrapResult* bootstrap);

}  // namespace myoid::identification
