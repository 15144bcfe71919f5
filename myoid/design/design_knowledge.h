#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/design/earlier_run.h"
#include "myoid/identification/residual_model.h"
#include "myoid/identification/study_data.h"

namespace myoid {

/// Knowledge of the free parameters before a recording, in the estimator's scale (logarithms
/// where it uses them).
struct Knowledge {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd precision;  ///< Its inverse.
};

/// The priors, and of the parameters that an earlier run fitted, its estimate and covariance. A
/// direction that the run left undetermined stays as unknown as it was. Throws InvalidInput if the
/// run's covariance is not finite.
[[nodiscard]] Knowledge knowledge_of(const std::vector<identification::Unknown>& free,
                                     const std::optional<EarlierRun>& earlier);

/// Persons drawn from the knowledge, within the bounds; the first is its mean. The same for the
/// same seed.
[[nodiscard]] std::vector<Eigen::VectorXd> draw_persons(
    const std::vector<identification::Unknown>& free,
    const Knowledge& known,
    int count,
    std::uint64_t seed);

/// The places of the parameters that `wanted` names: "all" (but the EMG gains), an owner ("BIC"), a
/// parameter, or both ("BIC.optimal_fiber_length"). Throws InvalidInput for a name that is none.
[[nodiscard]] std::vector<Eigen::Index> targets_of(const std::vector<identification::Unknown>& free,
                                                   const std::vector<std::string>& wanted);

/// The run's own row of an unknown (of its first owner, where it is tied), if it has an interval;
/// else nullptr.
[[nodiscard]] const identification::ParameterEstimate* found_by(
    const std::optional<EarlierRun>& earlier, const identification::Unknown& parameter);

/// The verdict on an interval of this width.
struct Expectation {
  double mean = 0.0, sd = 0.0, prior_sd = 0.0;  ///< In the estimator's scale.
  double model_error = 0.0;
  /// An earlier run's estimate, whose interval becomes `ratio` times as wide; or nullptr.
  const identification::ParameterEstimate* found = nullptr;
  double ratio = 1.0;
};
[[nodiscard]] identification::ParameterEstimate expected_estimate(
    const identification::Unknown& parameter,
    const Expectation& expectation,
    const std::vector<identification::MuscleSetup>& muscles);

}  // namespace myoid
