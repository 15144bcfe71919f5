#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/fit/measurement/study_data.h"
#include "myoid/run/design/earlier_run.h"

namespace myoid::run {

/// Knowledge of the free parameters before a recording, in the estimator's scale (logarithms
/// where it uses them).
struct Knowledge {
  Eigen::VectorXd mean;
  Eigen::MatrixXd covariance;
  Eigen::MatrixXd precision;  ///< Inverse covariance.
};

/// Returns the priors (fit::prior_precision). For the parameters that an earlier run fitted, its estimate and
/// covariance replace them. A direction that the run left undetermined keeps its prior. Throws InvalidInput if the
/// run's covariance is not finite.
[[nodiscard]] Knowledge knowledge_of(const std::vector<fit::Unknown>& free, const std::optional<EarlierRun>& earlier);

/// Draws persons from the knowledge, within the bounds; the first is the mean. One seed gives the same persons.
[[nodiscard]] std::vector<Eigen::VectorXd> draw_persons(const std::vector<fit::Unknown>& free,
                                                        const Knowledge& known,
                                                        int count,
                                                        std::uint64_t seed);

/// Returns the indices of the parameters that `wanted` names: "all" (except the EMG gains), an owner ("BIC"), a
/// parameter, or both ("BIC.optimal_fiber_length"). Throws InvalidInput for an unknown name.
[[nodiscard]] std::vector<Eigen::Index> targets_of(const std::vector<fit::Unknown>& free,
                                                   const std::vector<std::string>& wanted);

/// Returns the run's row of an unknown (for tied ones, of the first owner) if the row has an interval; else nullptr.
[[nodiscard]] const fit::ParameterEstimate* found_by(const std::optional<EarlierRun>& earlier,
                                                     const fit::Unknown& parameter);

/// The expected knowledge of a number, from which its verdict follows.
struct Expectation {
  double mean = 0.0, sd = 0.0, prior_sd = 0.0;  ///< In the estimator's scale.
  double model_error = 0.0;
  /// An earlier run's estimate, whose interval becomes `ratio` times as wide; or nullptr.
  const fit::ParameterEstimate* found = nullptr;
  double ratio = 1.0;
};
[[nodiscard]] fit::ParameterEstimate expected_estimate(const fit::Unknown& parameter, const Expectation& expectation);

}  // namespace myoid::run
