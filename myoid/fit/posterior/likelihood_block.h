#pragma once

#include <memory>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "myoid/fit/posterior/likelihood.h"
#include "myoid/ground/math/woodbury.h"

namespace myoid::fit {

/// The model's values at z and their derivatives by z.
struct Likelihood::Point {
  Point(const ParameterMap& map, const Eigen::VectorXd& z) : values(map.values(z, &chains)), by_owner(map, chains) {}
  std::vector<ParameterMap::Chain> chains;
  ModelValues values;
  ChainsByOwner by_owner;
};

/// One run at one point. A is divided by the weight w of the run's rows.
struct Likelihood::Block {
  std::unique_ptr<RunEvaluation> evaluation;
  Eigen::LLT<Eigen::MatrixXd> factor;  ///< Cholesky factor of A.
  Eigen::MatrixXd whitening;           ///< C^-1, A = C C'
  Eigen::VectorXd solved;              ///< A^-1 r
  Eigen::VectorXd white;               ///< C^-1 r
  Eigen::MatrixXd unseen;              ///< L S W
  Eigen::MatrixXd unseen_half;         ///< C^-1 L S W
  double own = 0.0;                    ///< -1/2 r' A^-1 r - w/2 ln |w A|
  bool positive = false;
};

/// Quantities of all runs together, at one point.
struct Likelihood::AllRuns {
  Eigen::VectorXd weights;  ///< W
  Eigen::VectorXd turned;   ///< a tanh((z - z_ref) / a) of each of Unseen::slopes.
  Eigen::VectorXd shared;   ///< The unseen quantities' expectation, times their growth.

  /// Returns G = 1 + W S' L' A^-1 L S W of all blocks; G^-1 is the covariance of x, given r.
  [[nodiscard]] math::Woodbury joined(const std::vector<Block>& blocks) const;
};

}  // namespace myoid::fit
