#pragma once

#include <limits>
#include <string_view>
#include <vector>

namespace myoid::math {

/// How an integration ended. Only `done` is an answer; up to the time reached, the rest holds too.
enum class OdeStatus {
  done,
  too_many_steps,  ///< `OdeOptions::max_steps` were not enough.
  step_too_small,  ///< The tolerance cannot be met with steps that still move the time.
  not_finite,      ///< The rate is NaN or infinite, however short the step.
  rate_failed,     ///< The rate reported that it cannot be evaluated.
  stopped,         ///< The caller asked to stop.
  solver_failed,   ///< The implicit solver gave up.
};

/// One sentence for a person.
[[nodiscard]] std::string_view explain(OdeStatus status);

struct OdeOptions {
  double relative_tolerance = 1e-8;
  double absolute_tolerance = 1e-10;        ///< Of every state ...
  std::vector<double> absolute_tolerances;  ///< ... or, if not empty, of each.
  double max_step_s = std::numeric_limits<double>::infinity();
  double first_step_s = 0.0;  ///< 0: chosen.
  long max_steps = 5'000'000;
};

/// Throws InvalidInput unless tolerances are positive, their number fits and the steps are usable.
void validate(const OdeOptions& options, long state_count);

struct OdeStatistics {
  long steps = 0;             ///< Accepted.
  long rejected = 0;          ///< Tried again, shorter.
  long rate_evaluations = 0;  ///< Of the right-hand side.
  long jacobians = 0;         ///< Implicit solver only.
  long events = 0;            ///< Kinks located, and the integration restarted there.
};

}  // namespace myoid::math
