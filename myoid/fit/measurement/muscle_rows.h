#pragma once

#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/envelope.h"
#include "myoid/fit/measurement/muscle_law.h"
#include "myoid/fit/measurement/parameters.h"

namespace myoid::fit {

/// Tension of one muscle over n samples and its derivatives.
struct MuscleRows {
  Eigen::VectorXd force_n;        ///< n
  Eigen::VectorXd by_envelope_n;  ///< n: change by a relative error of the envelope.
  Eigen::VectorXd by_length;      ///< n: by the musculotendon length [N/m].
  Eigen::VectorXd by_velocity;    ///< n: by its rate [N s/m].
  std::vector<Eigen::Index> variables;
  Eigen::MatrixXd by_variable;  ///< v x n: by each of `variables` [N].
};

/// Fills `rows` from the channel's activation, musculotendon lengths and rates (n each), with
/// derivatives by the variables of `of_muscle` and `of_channel`. Overwrites the content of `rows`.
void evaluate_muscle(const std::vector<Activation>& activation,
                     const Eigen::Ref<const Eigen::VectorXd>& length_m,
                     const Eigen::Ref<const Eigen::VectorXd>& velocity_mps,
                     const MuscleValues& values,
                     const std::vector<ParameterMap::Chain>& of_muscle,
                     const std::vector<ParameterMap::Chain>& of_channel,
                     MuscleRows& rows);

}  // namespace myoid::fit
