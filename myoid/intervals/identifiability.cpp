#include "myoid/intervals/identifiability.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/intervals/verdict_rules.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
int severity(Verdict verdict) { return static_cast<int>(verdict); }

double equivalent_deviations(double sum_of_squares, int count) {
  if (count < 1 || !(sum_of_squares > 0.0)) return 0.0;
  if (count == 1) return std::sqrt(sum_of_squares);
  const double beyond = math::chi_squared_tail(sum_of_squares, count);
  // The tail underflows: one deviation of the same square is close enough.
  return beyond > 0.0 ? -math::normal_quantile(0.5 * beyond) : std::sqrt(sum_of_squares);
}

void judge(ParameterEstimate& e, const VerdictContext& context) {
  Judgment judgment = judgment_of(e, context);
  e.verdict = judgment.verdict;
  e.reason = std::move(judgment.reason);
  const bool no_muscle = !kVerdictRules.possible(context.curve_width);
  const bool told = e.verdict == Verdict::weak || e.verdict == Verdict::identified;
  const bool peak_of_none = no_muscle && told && e.parameter == "optimal_fiber_length";
  if (peak_of_none) {
    // No muscle has this curve, so the place of its peak says nothing even with a narrow interval.
    e.verdict = Verdict::not_identifiable;
    e.reason = fmt::format(
        "the place of the peak of a force-length curve that no muscle has (its width is {:.2g} of the optimal length)",
        context.curve_width);
  } else if (no_muscle && e.verdict == Verdict::weak && judgment.tells != Tells::curve) {
    e.reason += "; by a force-length curve that no muscle has";
  }
  const bool said = judgment.tells == Tells::distance && !peak_of_none;
  if (context.prior_distance > kVerdictRules.prior_conflict && std::isfinite(e.estimate) && !said)
    e.reason += fmt::format("; {} away from {}", deviations(context.prior_distance, context), context.beforehand);
  if (context.tendon_share > kVerdictRules.mostly_tendon && e.verdict != Verdict::identified &&
      std::isfinite(e.estimate))
    e.reason +=
        "; most of its uncertainty is that of the tendon slack length, which is no measurement: with a rigid tendon "
        "the recording tells the sum of both";
  if (e.parameter == "concentric_curvature" && context.speed_is_free && e.verdict != Verdict::identified &&
      e.verdict != Verdict::non_physical)
    e.reason += "; v_max is not known, and another v_max asks for another V_sh";
}

}  // namespace myoid::identification
