#include "myoid/intervals/identifiability.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "myoid/core/units.h"
#include "myoid/math/statistics.h"

namespace myoid::identification {
namespace {

/// What a value outside physiology is the signature of; found by simulation of each single error.
std::string diagnosis(const ParameterEstimate& e) {
  const std::string& p = e.parameter;
  if (p == "eccentric_plateau" && e.estimate < 1.0) {
    return "force in lengthening below the isometric one contradicts muscle physiology: EMG and "
           "assigned force disagree in gain while "
           "lengthening (co-contraction that force sharing set to zero, or F_max too high), not a "
           "property of the muscle";
  }
  if (p == "eccentric_curvature_product" && e.estimate <= 0.0) {
    return "a product that is not positive is no force-velocity curve: the velocity effect in "
           "lengthening is not resolved (an EMG delay "
           "that was not accounted for does this)";
  }
  if (p == "concentric_curvature") {
    return e.estimate > 1.0 ? "a curvature above 1 means a straight line: the velocity effect in "
                              "shortening is not resolved (an EMG delay that "
                              "was not accounted for does this)"
                            : "a curvature this small is below that of the slowest muscle: "
                              "co-contraction that force sharing set to zero does this";
  }
  if (p == "force_length_width") {
    return e.initial > 0.0 && e.estimate > e.initial
               ? "a width this size is no muscle's: F_max or the EMG gain too high, a wrong "
                 "geometry "
                 "or electrode flattens the curve"
               : "a width this size is no muscle's: co-contraction set to zero, a delay, a wrong "
                 "geometry or electrode narrows the curve";
  }
  return "the value lies outside what a muscle can have: the fit describes something else";
}

/// The ground of a verdict, one for each sentence that `judge_alone` can give.
enum class Ground {
  no_number,
  not_converged,
  one_length,
  no_muscle,
  impossible_width,
  width_at_bound,
  bad_company,
  any_delay,
  no_delay,
  at_bound,
  never_acted,
  undetermined,
  flat_plateau,
  unsure_and_far_from_prior,
  contradicts_prior,
  stays_at_prior,
  moved_from_prior,
  delay_known,
  delay_rough,
  delay_open,
  far_from_prior,
  known,
  at_most_so_large,
  known_roughly,
  wide,
  unexplained,
  half_of_prior,
  shared_electrode,
  model_error,
  impossible_curve,
  leaning_curve,
  muscle_far_from_prior,
  rests_on_a_trial,
  shared_forces,
  given_strength,
};

/// The sentence of this ground tells a distance from the prior.
bool tells_distance(Ground ground) {
  return ground == Ground::unsure_and_far_from_prior || ground == Ground::contradicts_prior ||
         ground == Ground::moved_from_prior || ground == Ground::far_from_prior ||
         ground == Ground::muscle_far_from_prior;
}

/// Half of a normal distribution's 95 % interval, in standard deviations.
constexpr double kSpreads95 = 1.96;

std::string unit_text(Unit unit) {
  return unit == Unit::dimensionless ? "" : " " + std::string(symbol(unit));
}

/// A distance from the prior's mean, with what it is measured in.
std::string deviations(double distance, const VerdictContext& context) {
  return fmt::format("{:.1f} standard deviations of the prior{}", distance,
                     context.prior_of_logarithm ? " (of the logarithm)" : "");
}

/// What the recording adds to what is known beforehand.
std::string narrowing(double shrinkage) {
  return shrinkage > VerdictRules{}.any_shrinkage
             ? fmt::format("the recording narrows it by only {:.0f} %", 100.0 * shrinkage)
             : std::string("the recording does not narrow it");
}

}  // namespace

double half_width(const ParameterEstimate& e) {
  return std::max(*e.ci_high - e.estimate, e.estimate - *e.ci_low);
}

std::string_view name(Verdict verdict) {
  switch (verdict) {
    case Verdict::identified:
      return "identified";
    case Verdict::weak:
      return "weak";
    case Verdict::prior_dominated:
      return "prior_dominated";
    case Verdict::not_identifiable:
      return "not_identifiable";
    case Verdict::non_physical:
      return "non_physical";
  }
  return "?";
}

int severity(Verdict verdict) { return static_cast<int>(verdict); }

double equivalent_deviations(double sum_of_squares, int count) {
  if (count < 1 || !(sum_of_squares > 0.0)) return 0.0;
  if (count == 1) return std::sqrt(sum_of_squares);
  const double beyond = math::chi_squared_tail(sum_of_squares, count);
  // A tail too small for a number: one deviation of the same square is near enough.
  return beyond > 0.0 ? -math::normal_quantile(0.5 * beyond) : std::sqrt(sum_of_squares);
}

namespace {

/// Fills verdict and reason; the ground of both.
Ground judge_alone(ParameterEstimate& e, const VerdictContext& context, const VerdictRules& rules) {
  Ground ground = Ground::no_number;
  const auto set = [&](Ground why, Verdict verdict, std::string reason) {
    ground = why;
    e.verdict = verdict;
    e.reason = std::move(reason);
    return ground;
  };
  if (!std::isfinite(e.estimate))
    return set(Ground::no_number, Verdict::not_identifiable,
               context.failure.empty() ? "the fit gave no number" : context.failure);
  if (!context.converged && !context.outside_physical)
    return set(Ground::not_converged, Verdict::not_identifiable,
               "the fit did not converge: " + context.failure);
  if (context.length_span && *context.length_span < rules.least_length_span) {
    return set(
        Ground::one_length, e.shrinkage ? Verdict::prior_dominated : Verdict::not_identifiable,
        fmt::format("while active the muscle's length changed by {:.1f} % of the optimal one: "
                    "at one length F_max and the force-length curve are one number; record "
                    "other joint angles",
                    100.0 * *context.length_span));
  }
  if (context.outside_physical) {
    return set(Ground::no_muscle, Verdict::non_physical,
               context.converged ? diagnosis(e)
                                 : "the fit did not converge (" + context.failure +
                                       ") and stopped where no muscle can be: that says nothing");
  }
  if (!rules.possible(context.relative_width)) {
    return set(Ground::impossible_width, Verdict::non_physical,
               fmt::format("{:.2g} of the optimal length, and muscles have {} to {}: {}",
                           context.relative_width, rules.relative_width.lower,
                           rules.relative_width.upper, diagnosis(e)));
  }
  if (e.parameter == "force_length_width" && e.at_bound && !context.given_bound) {
    return set(Ground::width_at_bound, Verdict::non_physical,
               fmt::format("the recording pulls beyond what muscles have, {} to {} of the optimal "
                           "length: {}",
                           rules.relative_width.lower, rules.relative_width.upper, diagnosis(e)));
  }
  if (!context.bad_company.empty()) {
    return set(
        Ground::bad_company, Verdict::not_identifiable,
        fmt::format(
            "the same fit puts {} where no muscle can be: none of its numbers describes the muscle",
            context.bad_company));
  }
  const bool unexplained = context.r2 < rules.least_r2;
  if (e.at_bound && e.parameter == "emg_delay" && e.estimate <= rules.no_delay_s && e.ci_high) {
    if (*e.ci_high > rules.delay_weak_s) {
      return set(
          Ground::any_delay, Verdict::not_identifiable,
          fmt::format("any delay up to {:.0f} ms does as well: the EMG changes too little or "
                      "too slowly to show one",
                      1000.0 * *e.ci_high));
    }
    return set(Ground::no_delay,
               *e.ci_high <= rules.delay_identified_s && !unexplained ? Verdict::identified
                                                                      : Verdict::weak,
               "no delay: EMG and torque go together");
  }
  const double prior_sd = zero_by_nature(e.parameter) ? e.prior_sd.value_or(0.0) : 0.0;
  const bool none = e.at_bound && prior_sd > 0.0 && std::abs(e.estimate) <= 1e-6 * prior_sd;
  if (e.at_bound && !none) {
    return set(Ground::at_bound, Verdict::not_identifiable,
               context.given_bound
                   ? "the best fit leans on the bound that was given: the recording pulls beyond it"
                   : "the best fit leans on a bound: the recording pulls beyond what is physically "
                     "possible");
  }
  if (!context.never.empty()) {
    const bool known = e.shrinkage.has_value();  // beforehand
    return set(
        Ground::never_acted, known ? Verdict::prior_dominated : Verdict::not_identifiable,
        fmt::format("the muscle never {} while active: nothing in the recording speaks of it",
                    context.never));
  }
  if (!context.determined || !e.std_error || !e.ci_low || !e.ci_high) {
    return set(
        Ground::undetermined, Verdict::not_identifiable,
        "other parameters can make up for any change of it: the recording cannot tell them apart");
  }
  if (e.parameter == "eccentric_curvature_product" && context.plateau_is_flat) {
    return set(Ground::flat_plateau,
               e.shrinkage && *e.shrinkage < rules.least_shrinkage ? Verdict::prior_dominated
                                                                   : Verdict::not_identifiable,
               "no rise of force in lengthening is resolved (V_ml not clearly above 1), and "
               "without one this number has no effect");
  }
  if (e.shrinkage && *e.shrinkage < rules.least_shrinkage) {
    if (context.prior_distance > rules.prior_conflict) {
      return set(Ground::unsure_and_far_from_prior, Verdict::not_identifiable,
                 fmt::format("{} away from {} and no surer than that: use neither before the cause "
                             "is known",
                             deviations(context.prior_distance, context), context.beforehand));
    }
    // A fit with a prior moves a value by N(0, P - C), P the prior's and C its own variance: much
    // farther, and what the recording says and the prior contradict each other.
    const double conflict = context.prior_is_given && *e.shrinkage > rules.any_shrinkage
                                ? context.prior_distance / std::sqrt(*e.shrinkage)
                                : 0.0;
    if (conflict > rules.prior_conflict) {
      return set(
          Ground::contradicts_prior, Verdict::not_identifiable,
          fmt::format("mostly {}, which the recording contradicts by {:.1f} of their standard "
                      "deviations: use neither before the cause is known",
                      context.beforehand, conflict));
    }
    return set(
        context.prior_distance <= rules.prior_stays ? Ground::stays_at_prior
                                                    : Ground::moved_from_prior,
        Verdict::prior_dominated,
        context.prior_distance <= rules.prior_stays
            ? fmt::format("mostly {}: {}", context.beforehand, narrowing(*e.shrinkage))
            : fmt::format("{}, though the fit moved it {} away from {}", narrowing(*e.shrinkage),
                          deviations(context.prior_distance, context), context.beforehand));
  }
  const double half = half_width(e);
  if (e.parameter == "emg_delay") {
    if (half <= rules.delay_identified_s && context.model_error <= rules.model_error &&
        !unexplained)
      return set(Ground::delay_known, Verdict::identified,
                 fmt::format("known to {:.0f} ms", 1000.0 * half));
    if (half <= rules.delay_weak_s)
      return set(Ground::delay_rough, Verdict::weak,
                 fmt::format("known only to {:.0f} ms; faster movements tell more", 1000.0 * half));
    return set(Ground::delay_open, Verdict::not_identifiable,
               "the movements are too slow to show a delay");
  }
  const double relative = half / std::max(std::abs(e.estimate), 1e-300);
  const std::string known =
      none             ? fmt::format("none to be seen, at most {:.2g}{}", half, unit_text(e.unit))
      : prior_sd > 0.0 ? fmt::format("known to ± {:.2g}{}", half, unit_text(e.unit))
                       : fmt::format("known to {:.1f} %", 100.0 * relative);
  // What is 0 by nature tells something at any width: that it is no larger.
  if (context.prior_distance > rules.prior_conflict &&
      (prior_sd > 0.0 || relative <= rules.weak_half_width)) {
    set(Ground::far_from_prior, Verdict::weak,
        fmt::format("{} away from {}: a simplification of the model, or the EMG, may be what is "
                    "fitted",
                    deviations(context.prior_distance, context), context.beforehand));
  } else if (relative <= rules.identified_half_width) {
    set(Ground::known, Verdict::identified, known);
  } else if (prior_sd > 0.0) {
    set(Ground::at_most_so_large, Verdict::weak,
        fmt::format("{}, of ± {:.2g} beforehand", known, kSpreads95 * prior_sd));
  } else if (relative <= rules.weak_half_width) {
    set(Ground::known_roughly, Verdict::weak,
        fmt::format("known only to {:.0f} %", 100.0 * relative));
  } else {
    set(Ground::wide, Verdict::not_identifiable,
        fmt::format("the truth may be {:.0f} % away from the value", 100.0 * relative));
  }
  // One reason why a narrow interval is not enough, the gravest first.
  const auto unless = [&](bool wrong, Ground why, const std::string& reason) {
    if (wrong && e.verdict == Verdict::identified) set(why, Verdict::weak, reason);
  };
  unless(unexplained, Ground::unexplained,
         fmt::format("{}, but by a fit that explains little of the torque (R2 {:.2f}): what it "
                     "finds describes no muscle",
                     known, context.r2));
  unless(e.shrinkage && *e.shrinkage < rules.half_shrinkage, Ground::half_of_prior,
         known + ", but about as much from the literature as from the recording");
  unless(!context.shares_electrode_with.empty(), Ground::shared_electrode,
         fmt::format("{} if it does just what {} does: one electrode stands for both, "
                     "and what is taken from the one is given to the other",
                     known, context.shares_electrode_with));
  unless(context.model_error > rules.model_error, Ground::model_error,
         fmt::format("{}, but what the model leaves of the torque depends on posture and "
                     "effort as if it were wrong by {:.0f} %",
                     known, 100.0 * context.model_error));
  unless(!rules.possible(context.curve_width), Ground::impossible_curve,
         known + ", but by a force-length curve that no muscle has");
  unless(context.width_leans, Ground::leaning_curve,
         known + ", but by a force-length curve that leans on the bound of what muscles have");
  unless(context.muscle_distance > rules.prior_conflict, Ground::muscle_far_from_prior,
         fmt::format(
             "{}, but this muscle's numbers together are {:.1f} standard deviations of "
             "their priors away from these: a wrong label, sign, mass or geometry may be what is "
             "fitted",
             known, context.muscle_distance));
  unless(!context.rests_on.empty(), Ground::rests_on_a_trial,
         fmt::format("rests on trial '{}': without it the value would leave its own "
                     "interval; record more like it",
                     context.rests_on));
  unless(context.shared_forces, Ground::shared_forces,
         known +
             ", but about the forces that an optimizer assigned, which carry its assumptions and "
             "no co-contraction; method torque does not need them");
  unless(context.given_strength, Ground::given_strength,
         known +
             " if F_max is what it was held at: an error in it goes into every other number; "
             "method force finds it along with them");
  if (e.parameter == "max_isometric_force" && !context.from_mvc) {
    e.reason +=
        "; no maximal contraction was recorded, so this is the force at the study's largest EMG, "
        "not the muscle's maximum";
  }
  return ground;
}

}  // namespace

void judge(ParameterEstimate& e, const VerdictContext& context, const VerdictRules& rules) {
  const Ground ground = judge_alone(e, context, rules);
  const bool no_muscle = !rules.possible(context.curve_width);
  const bool told = e.verdict == Verdict::weak || e.verdict == Verdict::identified;
  const bool peak_of_none = no_muscle && told && e.parameter == "optimal_fiber_length";
  if (peak_of_none) {
    // Where the peak of a curve lies that is none says nothing, however narrow it is.
    e.verdict = Verdict::not_identifiable;
    e.reason = fmt::format(
        "the place of the peak of a force-length curve that no muscle has (its width is {:.2g} of "
        "the optimal length)",
        context.curve_width);
  } else if (no_muscle && e.verdict == Verdict::weak && ground != Ground::impossible_curve) {
    e.reason += "; by a force-length curve that no muscle has";
  }
  const bool said = tells_distance(ground) && !peak_of_none;
  if (context.prior_distance > rules.prior_conflict && std::isfinite(e.estimate) && !said)
    e.reason += fmt::format("; {} away from {}", deviations(context.prior_distance, context),
                            context.beforehand);
  if (context.tendon_share > rules.mostly_tendon && e.verdict != Verdict::identified &&
      std::isfinite(e.estimate))
    e.reason +=
        "; most of its uncertainty is that of the tendon slack length, which is no measurement: "
        "with a rigid tendon the recording tells the sum of both";
  if (e.parameter == "concentric_curvature" && context.speed_is_free &&
      e.verdict != Verdict::identified && e.verdict != Verdict::non_physical)
    e.reason += "; v_max is not known, and another v_max asks for another V_sh";
}

}  // namespace myoid::identification
