#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/units.h"
#include "myoid/intervals/identifiability.h"
#include "myoid/intervals/verdict_rules.h"

namespace myoid::identification {
namespace {

/// Returns the likely error behind a value outside physiology, known from simulation of single errors.
std::string diagnosis(const ParameterEstimate& e) {
  const std::string& p = e.parameter;
  if (p == "eccentric_plateau" && e.estimate < 1.0) {
    return "force in lengthening below the isometric one contradicts muscle physiology: EMG and assigned force "
           "disagree in gain while lengthening (co-contraction that force sharing set to zero, or F_max too high), not "
           "a property of the muscle";
  }
  if (p == "eccentric_curvature_product" && e.estimate <= 0.0) {
    return "a product that is not positive is no force-velocity curve: the velocity effect in lengthening is not "
           "resolved (an EMG delay that was not accounted for does this)";
  }
  if (p == "concentric_curvature") {
    return e.estimate > 1.0 ? "a curvature above 1 means a straight line: the velocity effect in shortening is not "
                              "resolved (an EMG delay that was not accounted for does this)"
                            : "a curvature this small is below that of the slowest muscle: co-contraction that force "
                              "sharing set to zero does this";
  }
  if (p == "force_length_width") {
    return e.initial > 0.0 && e.estimate > e.initial ? "a width this size is no muscle's: F_max or the EMG gain too "
                                                       "high, a wrong geometry or electrode flattens the curve"
                                                     : "a width this size is no muscle's: co-contraction set to zero, "
                                                       "a delay, a wrong geometry or electrode narrows the curve";
  }
  return "the value lies outside what a muscle can have: the fit describes something else";
}

/// Half of a normal distribution's 95 % interval, in standard deviations.
constexpr double kSpreads95 = 1.96;

std::string unit_text(Unit unit) { return unit == Unit::dimensionless ? "" : " " + std::string(symbol(unit)); }

/// Describes how much the recording narrows the prior.
std::string narrowing(double shrinkage) {
  return shrinkage > kVerdictRules.any_shrinkage
             ? fmt::format("the recording narrows it by only {:.0f} %", 100.0 * shrinkage)
             : std::string("the recording does not narrow it");
}

using MaybeJudgment = std::optional<Judgment>;

/// Returns the prior's standard deviation of a number that is 0 by nature; 0 for other numbers.
double spread_of_nothing(const ParameterEstimate& e) {
  return zero_by_nature(e.parameter) ? e.prior_sd.value_or(0.0) : 0.0;
}

/// Returns true for a number that is 0 by nature and 0 on its bound.
bool is_none(const ParameterEstimate& e) {
  const double prior_sd = spread_of_nothing(e);
  return e.at_bound && prior_sd > 0.0 && std::abs(e.estimate) <= 1e-6 * prior_sd;
}

bool unexplained(const VerdictContext& context) { return context.r2 < kVerdictRules.least_r2; }

/// Judges a fit that gave no number, or none that depends on a muscle's length.
MaybeJudgment without_fit(const ParameterEstimate& e, const VerdictContext& context) {
  if (!std::isfinite(e.estimate))
    return Judgment{Verdict::not_identifiable, context.failure.empty() ? "the fit gave no number" : context.failure};
  if (!context.converged && !context.outside_physical)
    return Judgment{Verdict::not_identifiable, "the fit did not converge: " + context.failure};
  if (!context.length_span || *context.length_span >= kVerdictRules.least_length_span) return std::nullopt;
  return Judgment{e.shrinkage ? Verdict::prior_dominated : Verdict::not_identifiable,
                  one_length_text(*context.length_span)};
}

/// Judges a number that, or whose companion in the fit, no muscle can have.
MaybeJudgment without_muscle(const ParameterEstimate& e, const VerdictContext& context) {
  if (context.outside_physical) {
    return Judgment{Verdict::non_physical, context.converged
                                               ? diagnosis(e)
                                               : "the fit did not converge (" + context.failure +
                                                     ") and stopped where no muscle can be: that says nothing"};
  }
  if (!kVerdictRules.possible(context.relative_width)) {
    return Judgment{Verdict::non_physical,
                    fmt::format("{:.2g} of the optimal length, and muscles have {} to {}: {}", context.relative_width,
                                kVerdictRules.relative_width.lower, kVerdictRules.relative_width.upper, diagnosis(e))};
  }
  if (e.parameter == "force_length_width" && e.at_bound && !context.given_bound) {
    return Judgment{Verdict::non_physical,
                    fmt::format("the recording pulls beyond what muscles have, {} to {} of the optimal length: {}",
                                kVerdictRules.relative_width.lower, kVerdictRules.relative_width.upper, diagnosis(e))};
  }
  if (context.bad_company.empty()) return std::nullopt;
  return Judgment{Verdict::not_identifiable,
                  fmt::format("the same fit puts {} where no muscle can be: none of its numbers describes the muscle",
                              context.bad_company)};
}

/// Judges a number on a bound.
MaybeJudgment on_a_bound(const ParameterEstimate& e, const VerdictContext& context) {
  if (!e.at_bound) return std::nullopt;
  if (e.parameter == "emg_delay" && e.estimate <= kVerdictRules.no_delay_s && e.ci_high) {
    if (*e.ci_high > kVerdictRules.delay_weak_s) {
      return Judgment{
          Verdict::not_identifiable,
          fmt::format("any delay up to {:.0f} ms does as well: the EMG changes too little or too slowly to show one",
                      1000.0 * *e.ci_high)};
    }
    const bool known = *e.ci_high <= kVerdictRules.delay_identified_s && !unexplained(context);
    return Judgment{known ? Verdict::identified : Verdict::weak, "no delay: EMG and torque go together"};
  }
  if (is_none(e)) return std::nullopt;
  return Judgment{Verdict::not_identifiable,
                  context.given_bound
                      ? "the best fit leans on the bound that was given: the recording pulls beyond it"
                      : "the best fit leans on a bound: the recording pulls beyond what is physically possible"};
}

/// Judges a number on which alone nothing in the recording depends.
MaybeJudgment without_effect(const ParameterEstimate& e, const VerdictContext& context) {
  if (!context.never.empty()) {
    return Judgment{
        e.shrinkage ? Verdict::prior_dominated : Verdict::not_identifiable,
        fmt::format("the muscle never {} while active: nothing in the recording speaks of it", context.never)};
  }
  if (!context.determined || !e.std_error || !e.ci_low || !e.ci_high) {
    return Judgment{Verdict::not_identifiable,
                    "other parameters can make up for any change of it: the recording cannot tell them apart"};
  }
  if (e.parameter != "eccentric_curvature_product" || !context.plateau_is_flat) return std::nullopt;
  return Judgment{e.shrinkage && *e.shrinkage < kVerdictRules.least_shrinkage ? Verdict::prior_dominated
                                                                              : Verdict::not_identifiable,
                  "no rise of force in lengthening is resolved (V_ml not clearly above 1), and without one this number "
                  "has no effect"};
}

/// Judges a number of a force that nobody measured: its interval would be about the optimizer's assumptions.
MaybeJudgment of_shared_force(const ParameterEstimate&, const VerdictContext& context) {
  if (!context.shared_forces) return std::nullopt;
  return Judgment{Verdict::prior_dominated,
                  "nobody measured the force: an optimizer shared the torque among the muscles by its own assumptions, "
                  "with the literature's F_max and without co-contraction"};
}

/// Judges a number that the recording hardly improves beyond its prior.
MaybeJudgment mostly_prior(const ParameterEstimate& e, const VerdictContext& context) {
  if (!e.shrinkage || *e.shrinkage >= kVerdictRules.least_shrinkage) return std::nullopt;
  const std::string away =
      fmt::format("{} away from {}", deviations(context.prior_distance, context), context.beforehand);
  if (context.prior_distance > kVerdictRules.prior_conflict) {
    return Judgment{Verdict::not_identifiable,
                    fmt::format("{} and no surer than that: use neither before the cause is known", away),
                    Tells::distance};
  }
  // If recording and prior agree, a fit moves a value by N(0, P - C), P the prior's variance and C
  // the posterior's. A much longer distance is a contradiction between the two.
  const double conflict = context.prior_is_given && *e.shrinkage > kVerdictRules.any_shrinkage
                              ? context.prior_distance / std::sqrt(*e.shrinkage)
                              : 0.0;
  if (conflict > kVerdictRules.prior_conflict) {
    return Judgment{Verdict::not_identifiable,
                    fmt::format("mostly {}, which the recording contradicts by {:.1f} of their standard deviations: "
                                "use neither before the cause is known",
                                context.beforehand, conflict),
                    Tells::distance};
  }
  if (context.prior_distance <= kVerdictRules.prior_stays)
    return Judgment{Verdict::prior_dominated,
                    fmt::format("mostly {}: {}", context.beforehand, narrowing(*e.shrinkage))};
  return Judgment{Verdict::prior_dominated,
                  fmt::format("{}, though the fit moved it {}", narrowing(*e.shrinkage), away), Tells::distance};
}

/// Judges an EMG delay by the half width of its interval [s].
Judgment delay_by_width(const ParameterEstimate& e, const VerdictContext& context) {
  const double half_s = half_width(e);
  if (half_s <= kVerdictRules.delay_identified_s && context.model_error <= kVerdictRules.model_error &&
      !unexplained(context))
    return {Verdict::identified, fmt::format("known to {:.0f} ms", 1000.0 * half_s)};
  if (half_s <= kVerdictRules.delay_weak_s)
    return {Verdict::weak, fmt::format("known only to {:.0f} ms; faster movements tell more", 1000.0 * half_s)};
  return {Verdict::not_identifiable, "the movements are too slow to show a delay"};
}

/// Describes how well the number is known.
std::string known_words(const ParameterEstimate& e, double relative) {
  if (is_none(e)) return fmt::format("none to be seen, at most {:.2g}{}", half_width(e), unit_text(e.unit));
  if (spread_of_nothing(e) > 0.0) return fmt::format("known to ± {:.2g}{}", half_width(e), unit_text(e.unit));
  return fmt::format("known to {:.1f} %", 100.0 * relative);
}

/// Judges the number by the width of its interval.
Judgment by_width(const ParameterEstimate& e, const VerdictContext& context) {
  const double relative = half_width(e) / std::max(std::abs(e.estimate), 1e-300);
  const double prior_sd = spread_of_nothing(e);
  const std::string known = known_words(e, relative);
  // For a number that is 0 by nature, an interval of any width bounds the number's size.
  if (context.prior_distance > kVerdictRules.prior_conflict &&
      (prior_sd > 0.0 || relative <= kVerdictRules.weak_half_width)) {
    return {Verdict::weak,
            fmt::format("{} away from {}: a simplification of the model, or the EMG, may be what is fitted",
                        deviations(context.prior_distance, context), context.beforehand),
            Tells::distance};
  }
  if (relative <= kVerdictRules.identified_half_width) return {Verdict::identified, known};
  if (prior_sd > 0.0) return {Verdict::weak, fmt::format("{}, of ± {:.2g} beforehand", known, kSpreads95 * prior_sd)};
  if (relative <= kVerdictRules.weak_half_width)
    return {Verdict::weak, fmt::format("known only to {:.0f} %", 100.0 * relative)};
  return {Verdict::not_identifiable, fmt::format("the truth may be {:.0f} % away from the value", 100.0 * relative)};
}

/// Returns the gravest reason that makes a narrow interval weak instead of `identified`; empty:
/// none. `known` describes the interval's width.
MaybeJudgment weakened(const ParameterEstimate& e, const std::string& known, const VerdictContext& context) {
  const auto weak = [](std::string reason, Tells tells = Tells::nothing) {
    return Judgment{Verdict::weak, std::move(reason), tells};
  };
  if (unexplained(context))
    return weak(fmt::format(
        "{}, but by a fit that explains little of the torque (R2 {:.2f}): what it finds describes no muscle", known,
        context.r2));
  if (e.shrinkage && *e.shrinkage < kVerdictRules.half_shrinkage)
    return weak(known + ", but about as much from the literature as from the recording");
  if (!context.shares_electrode_with.empty())
    return weak(
        fmt::format("{} if it does just what {} does: one electrode stands for both, and what is taken from the one is "
                    "given to the other",
                    known, context.shares_electrode_with));
  if (context.model_error > kVerdictRules.model_error)
    return weak(fmt::format(
        "{}, but what the model leaves of the torque depends on posture and effort as if it were wrong by {:.0f} %",
        known, 100.0 * context.model_error));
  if (!kVerdictRules.possible(context.curve_width))
    return weak(known + ", but by a force-length curve that no muscle has", Tells::curve);
  if (context.width_leans)
    return weak(known + ", but by a force-length curve that leans on the bound of what muscles have");
  if (context.muscle_distance > kVerdictRules.prior_conflict)
    return weak(fmt::format("{}, but this muscle's numbers together are {:.1f} standard deviations of their priors "
                            "away from these: a wrong label, sign, mass or geometry may be what is fitted",
                            known, context.muscle_distance),
                Tells::distance);
  if (!context.rests_on.empty())
    return weak(
        fmt::format("rests on trial '{}': without it the value would leave its own interval; record more like it",
                    context.rests_on));
  if (context.given_strength)
    return weak(known +
                " if F_max is what it was held at: an error in it goes into every other number; method force finds it "
                "along with them");
  return std::nullopt;
}

/// Returns the judgment by the first rule that applies.
Judgment by_first_rule(const ParameterEstimate& e, const VerdictContext& context) {
  for (const auto& rule : {without_fit, without_muscle, on_a_bound, without_effect, of_shared_force, mostly_prior}) {
    if (MaybeJudgment judgment = rule(e, context)) return std::move(*judgment);
  }
  if (e.parameter == "emg_delay") return delay_by_width(e, context);
  Judgment judgment = by_width(e, context);
  if (judgment.verdict == Verdict::identified) {
    if (MaybeJudgment weak = weakened(e, judgment.reason, context)) judgment = std::move(*weak);
  }
  judgment.reason += beside_the_maximum(e.parameter, context.from_mvc);
  return judgment;
}

}  // namespace

double half_width(const ParameterEstimate& e) { return std::max(*e.ci_high - e.estimate, e.estimate - *e.ci_low); }

std::string deviations(double distance, const VerdictContext& context) {
  return fmt::format("{:.1f} standard deviations of the prior{}", distance,
                     context.prior_of_logarithm ? " (of the logarithm)" : "");
}

Judgment judgment_of(const ParameterEstimate& e, const VerdictContext& context) {
  Judgment judgment = by_first_rule(e, context);
  const bool known = judgment.verdict == Verdict::identified || judgment.verdict == Verdict::weak;
  if (!known || context.r2 >= kVerdictRules.mean_r2) return judgment;
  return {Verdict::not_identifiable,
          fmt::format("the fit errs more than the mean of the torque would (R2 {:.2f}): none of its numbers is known",
                      context.r2)};
}

std::string beside_the_maximum(std::string_view parameter, bool from_mvc) {
  if (from_mvc || parameter != "max_isometric_force") return "";
  return "; no maximal contraction was recorded, so this is the force at the study's largest EMG, not the muscle's "
         "maximum";
}

}  // namespace myoid::identification
