#include "myoid/intervals/verdicts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "myoid/core/units.h"
#include "myoid/intervals/verdict_rules.h"

namespace myoid::identification {
namespace {

/// The names of the sources; "{}" is the torque or the force.
constexpr std::array<std::string_view, kSourceCount> kSourceNames = {
    "noise of the {}", "prior belief", "geometry", "electrodes", "scale of the {}", "error of the model"};

std::string_view fitted(const NumberFacts& facts) { return facts.of_force ? "force" : "torque"; }

/// Returns the distance from the value to the farther end: of a delay in seconds, of an angle in radians, else as a
/// share.
double half_width(const NumberFacts& facts, double value, double low, double high) {
  const double half = std::max(value - low, high - value);
  const bool absolute = facts.is_delay || facts.is_angle;
  return absolute ? half : half / std::max(facts.usual_size.value_or(std::abs(value)), 1e-12);
}

double half_of_person(const NumberFacts& facts) { return half_width(facts, facts.value, facts.low, facts.high); }

double half_given(const NumberFacts& facts) {
  return half_width(facts, facts.given, facts.low_given, facts.high_given);
}

bool is_far(const NumberFacts& facts) {
  return facts.prior_distance && *facts.prior_distance > kVerdictRules.prior_conflict;
}

std::string size_text(double half, const NumberFacts& facts) {
  if (facts.is_delay) return fmt::format("± {:.0f} ms", 1000.0 * half);
  if (facts.is_angle) return fmt::format("± {:.2g}°", half / kDegree);
  return half < 0.995 ? fmt::format("± {:.2g} %", 100.0 * half) : fmt::format("± {:.0f} %", 100.0 * half);
}

double identified_half(const NumberFacts& facts) {
  return facts.is_delay   ? kVerdictRules.delay_identified_s
         : facts.is_angle ? kVerdictRules.angle_identified_rad
                          : kVerdictRules.identified_half_width;
}

double weak_half(const NumberFacts& facts) {
  return facts.is_delay   ? kVerdictRules.delay_weak_s
         : facts.is_angle ? kVerdictRules.angle_weak_rad
                          : kVerdictRules.weak_half_width;
}

std::string sources_text(const NumberFacts& facts) {
  const SourceShares& shares = facts.shares;
  std::array<std::size_t, kSourceCount> order{0, 1, 2, 3, 4, 5};
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return shares[a] > shares[b]; });
  std::string text;
  for (const std::size_t i : order) {
    if (shares[i] < 0.1) break;
    text += fmt::format("{}{} {:.0f} %", text.empty() ? "" : ", ",
                        fmt::format(fmt::runtime(kSourceNames[i]), fitted(facts)), 100.0 * shares[i]);
  }
  return text;
}

std::string widths_text(const NumberFacts& facts) {
  const std::string usual = facts.usual_size ? ", as shares of what is usual" : "";
  const std::string person = size_text(half_of_person(facts), facts);
  return facts.one_reading ? person + usual
                           : fmt::format("{} of the person, {} given geometry and sensors{}", person,
                                         size_text(half_given(facts), facts), usual);
}

/// Returns the reason of a finding beside which no width matters; else empty.
std::string without_width(Finding finding, const NumberFacts& facts) {
  const std::string failed = facts.failure.empty() ? "the search for the posterior's mode did not end"
                                                   : "the fit did not converge: " + facts.failure;
  switch (finding) {
    case Finding::not_converged:
      return failed;
    case Finding::one_length:
      return one_length_text(*facts.length_span);
    case Finding::bad_company:
      return fmt::format("the same fit puts {} where no muscle can be: none of its numbers describes the muscle",
                         facts.bad_company);
    case Finding::no_effect:
      return facts.no_effect;
    case Finding::undetermined:
      return "other parameters can make up for any change of it: the recording cannot tell them apart";
    case Finding::shared_force:
      return "nobody measured the force: an optimizer shared the torque among the muscles by its own assumptions, with "
             "the literature's F_max and without co-contraction";
    case Finding::impossible:
      if (!facts.converged) return fmt::format("{}; it stopped where no muscle can be: that says nothing", failed);
      return facts.one_reading ? facts.impossible : "";
    default:
      return "";
  }
}

/// The finding about the person's interval, of a fit that may be judged by its widths.
Finding of_person(const NumberFacts& facts) {
  constexpr const VerdictRules& rules = kVerdictRules;
  if (facts.contraction && *facts.contraction < rules.least_shrinkage)
    return is_far(facts) ? Finding::far_from_prior : Finding::as_the_prior;
  const double half = half_of_person(facts);
  if (half > weak_half(facts) && !facts.usual_size) return Finding::too_wide;
  if (half > identified_half(facts)) return Finding::wide;
  if (facts.model_error > rules.model_error) return Finding::wrong_model;
  if (is_far(facts)) return Finding::narrow_and_far;
  if (facts.at_bound) return Finding::cut_off;
  if (facts.at_range_end) return Finding::range_ends;
  if (facts.given_strength) return Finding::given_strength;
  if (facts.contraction && *facts.contraction < rules.half_shrinkage) return Finding::half_the_prior;
  if (facts.high < facts.low_given || facts.high_given < facts.low) return Finding::readings_apart;
  return Finding::narrow;
}

/// Returns true if the number is narrow with geometry and sensors exact, and by the recording, not by its prior.
bool narrow_if_given(const NumberFacts& facts) {
  constexpr const VerdictRules& rules = kVerdictRules;
  if (facts.one_reading) return false;
  const double half = half_given(facts);
  const bool told = !facts.contraction_given || *facts.contraction_given >= rules.half_shrinkage;
  return half > 0.0 && half <= identified_half(facts) && told && facts.model_error <= rules.model_error &&
         !is_far(facts) && !facts.at_bound && !facts.at_range_end;
}

}  // namespace

Finding finding(const NumberFacts& facts) {
  constexpr const VerdictRules& rules = kVerdictRules;
  // Where a search ran away to numbers of no muscle, that is the finding.
  if (!facts.converged) return facts.impossible.empty() ? Finding::not_converged : Finding::impossible;
  if (facts.length_span && *facts.length_span < rules.least_length_span) return Finding::one_length;
  if (!facts.impossible.empty()) return Finding::impossible;
  if (!facts.bad_company.empty()) return Finding::bad_company;
  if (!facts.no_effect.empty()) return Finding::no_effect;
  if (!facts.determined) return Finding::undetermined;
  if (facts.shared_force) return Finding::shared_force;
  if (facts.r2 < rules.least_r2) return Finding::unexplained;
  if (facts.nuisance_gain) return Finding::as_the_prior;
  const Finding person = of_person(facts);
  return person != Finding::narrow && narrow_if_given(facts) ? Finding::narrow_if_given : person;
}

Verdict verdict_of(Finding finding) {
  switch (finding) {
    case Finding::not_converged:
    case Finding::bad_company:
    case Finding::no_effect:
    case Finding::undetermined:
    case Finding::unexplained:
    case Finding::too_wide:
    case Finding::far_from_prior:
    case Finding::cut_off:
      return Verdict::not_identifiable;
    case Finding::impossible:
      return Verdict::non_physical;
    case Finding::one_length:
    case Finding::shared_force:
    case Finding::as_the_prior:
      return Verdict::prior_dominated;
    case Finding::wide:
    case Finding::wrong_model:
    case Finding::narrow_and_far:
    case Finding::given_strength:
    case Finding::half_the_prior:
    case Finding::readings_apart:
    case Finding::range_ends:
      return Verdict::weak;
    case Finding::narrow_if_given:
      return Verdict::reproducible;
    case Finding::narrow:
      break;
  }
  return Verdict::identified;
}

std::string reason_of(Finding finding, const NumberFacts& facts) {
  if (std::string reason = without_width(finding, facts); !reason.empty()) return reason;
  std::string text = widths_text(facts);
  if (facts.contraction)
    text += fmt::format("; the recording takes {:.0f} % off the prior's variance",
                        100.0 * std::max(0.0, *facts.contraction));
  if (const std::string sources = sources_text(facts); !sources.empty()) text += "; it rests on " + sources;
  if (is_far(facts)) text += fmt::format("; {:.1f} standard deviations away from its prior", *facts.prior_distance);
  if (finding == Finding::impossible) text = facts.impossible + "; " + text;
  if (finding == Finding::given_strength)
    text =
        "if F_max is the value at which it was held: its error goes into every other number, and method force finds "
        "it along with them; " +
        text;
  if (finding == Finding::narrow_if_given) text = "compare sessions of this person by it, but not persons: " + text;
  if (finding == Finding::readings_apart)
    text = "the person's interval and the one given geometry and sensors exclude each other; " + text;
  if (finding == Finding::narrow_and_far)
    text = "a simplification of the model, or the EMG, may be what is fitted; " + text;
  if (finding == Finding::range_ends)
    text = "the recorded range ends here, and the maximum may lie beyond: record a wider range; " + text;
  if (finding == Finding::cut_off)
    text = "the interval ends at a bound: the recording pulls beyond what is physically possible; " + text;
  if (finding == Finding::wrong_model)
    text = fmt::format("the model errs by {:.0f} % in a way that depends on posture, effort and speed; {}",
                       100.0 * facts.model_error, text);
  if (finding == Finding::unexplained)
    text = fmt::format(
        "the fit explains little of the {} (R2 {:.2f}): a sign, a unit, an offset, a clock, the order of files or a "
        "column is wrong, or the EMG is not that of these muscles; {}",
        fitted(facts), facts.r2, text);
  if (facts.approximate) text += "; approximate: the normal approximation could not be checked";
  return text;
}

void judge(ParameterEstimate& estimate, const NumberFacts& facts) {
  const Finding found = finding(facts);
  estimate.verdict = verdict_of(found);
  estimate.reason = reason_of(found, facts);
}

std::string beside_the_maximum(std::string_view parameter, bool from_mvc) {
  if (from_mvc || parameter != "max_isometric_force") return "";
  return "; no maximal contraction was recorded, so this is the force at the study's largest EMG, not the muscle's "
         "maximum";
}

}  // namespace myoid::identification
