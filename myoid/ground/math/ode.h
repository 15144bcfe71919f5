#pragma once

#include <limits>
#include <string_view>
#include <vector>

namespace myoid::inline ground::math {

/// The end of an integration. Only `done` is an answer; the results up to the time reached are valid in all cases.
enum class OdeStatus {
  done,
  too_many_steps,  ///< `OdeOptions::max_steps` did not suffice.
  step_too_small,  ///< The tolerance needs steps too small to change the time.
  not_finite,      ///< The rate is NaN or infinite even for the shortest steps.
  rate_failed,     ///< The rate reported that it cannot be evaluated.
  stopped,         ///< The caller asked to stop.
  solver_failed,   ///< The implicit solver failed.
};

/// Explains a status in one sentence.
[[nodiscard]] std::string_view explain(OdeStatus status);

struct OdeOptions {
  double relative_tolerance = 1e-8;
  double absolute_tolerance = 1e-10;        ///< Absolute tolerance of all states.
  std::vector<double> absolute_tolerances;  ///< Absolute tolerance of each state; overrides the
                                            ///< common one unless empty.
  double max_step_s = std::numeric_limits<double>::infinity();
  double first_step_s = 0.0;  ///< 0: chosen automatically.
  long max_steps = 5'000'000;
};

/// Throws InvalidInput unless tolerances are positive, their number fits and the steps are usable.
void validate(const OdeOptions& options, long state_count);

struct OdeStatistics {
  long steps = 0;             ///< Accepted steps.
  long rejected = 0;          ///< Steps that were repeated with a shorter length.
  long rate_evaluations = 0;  ///< Evaluations of the right-hand side.
  long jacobians = 0;         ///< Implicit solver only.
  long events = 0;            ///< Kinks that were located and at which the integration restarted.
};

}  // namespace myoid::inline ground::math
