#include "myoid/fit/intervals/verdicts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/ground/core/units.h"

namespace myoid::fit {
namespace {

/// The names of the sources; "{}" is the torque or the force.
constexpr std::array<std::string_view, kSourceCount> kSourceNames = {
    "noise of the {}", "prior belief", "geometry", "electrodes", "scale of the {}", "error of the model"};

std::string_view fitted(const NumberFacts& facts) { return facts.fit.of_force ? "force" : "torque"; }

/// Returns the distance from the value to the farther end: of a delay in seconds, of an angle in radians, else as a
/// share.
double half_width(const NumberFacts& facts, const Reading& of) {
  const double half = std::max(of.value - of.low, of.high - of.value);
  return facts.scale != Scale::share ? half : half / std::max(facts.usual_size.value_or(std::abs(of.value)), 1e-12);
}

bool is_far(const NumberFacts& facts) {
  return facts.prior_distance && *facts.prior_distance > kVerdictRules.prior_conflict;
}

std::string size_text(double half, const NumberFacts& facts) {
  if (facts.scale == Scale::delay) return fmt::format("± {:.0f} ms", 1000.0 * half);
  if (facts.scale == Scale::angle) return fmt::format("± {:.2g}°", half / kDegree);
  return half < 0.995 ? fmt::format("± {:.2g} %", 100.0 * half) : fmt::format("± {:.0f} %", 100.0 * half);
}

double identified_half(const NumberFacts& facts) {
  return facts.scale == Scale::delay   ? kVerdictRules.delay_identified_s
         : facts.scale == Scale::angle ? kVerdictRules.angle_identified_rad
                                       : kVerdictRules.identified_half_width;
}

double weak_half(const NumberFacts& facts) {
  return facts.scale == Scale::delay   ? kVerdictRules.delay_weak_s
         : facts.scale == Scale::angle ? kVerdictRules.angle_weak_rad
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
  const std::string person = size_text(half_width(facts, facts.person), facts);
  return facts.fit.one_reading ? person + usual
                               : fmt::format("{} of the person, {} given geometry and sensors{}", person,
                                             size_text(half_width(facts, facts.given), facts), usual);
}

/// Returns the reason of a finding beside which no width matters; else empty.
std::string without_width(Finding finding, const NumberFacts& facts) {
  const std::string failed = facts.fit.failure.empty() ? "the search for the posterior's mode did not end"
                                                       : "the fit did not converge: " + facts.fit.failure;
  switch (finding) {
    case Finding::not_converged:
      return failed;
    case Finding::one_length:
      return fmt::format(
          "while active the muscle's length changed by {:.1f} % of the optimal one: at one length F_max and the "
          "force-length curve are one number; record other joint angles",
          100.0 * *facts.length_span);
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
      if (!facts.fit.converged) return fmt::format("{}; it stopped where no muscle can be: that says nothing", failed);
      return facts.fit.one_reading ? facts.impossible : "";
    default:
      return "";
  }
}

bool exclude_each_other(const Reading& a, const Reading& b) { return a.high < b.low || b.high < a.low; }

/// The finding about the person's interval, of a fit that may be judged by its widths.
Finding of_person(const NumberFacts& facts) {
  constexpr const VerdictRules& rules = kVerdictRules;
  if (facts.contraction && *facts.contraction < rules.least_shrinkage)
    return is_far(facts) ? Finding::far_from_prior : Finding::as_the_prior;
  const double half = half_width(facts, facts.person);
  if (half > weak_half(facts) && !facts.usual_size) return Finding::too_wide;
  if (half > identified_half(facts)) return Finding::wide;
  if (facts.fit.model_error > rules.model_error) return Finding::wrong_model;
  if (is_far(facts)) return Finding::narrow_and_far;
  if (facts.at_bound) return Finding::cut_off;
  if (facts.at_range_end) return Finding::range_ends;
  if (facts.fit.given_strength) return Finding::given_strength;
  if (facts.contraction && *facts.contraction < rules.half_shrinkage) return Finding::half_the_prior;
  if (exclude_each_other(facts.person, facts.given)) return Finding::readings_apart;
  return facts.contradiction.empty() ? Finding::narrow : Finding::contradicted;
}

/// Returns true if the number is narrow with geometry and sensors exact, and by the recording, not by its prior.
bool narrow_if_given(const NumberFacts& facts) {
  constexpr const VerdictRules& rules = kVerdictRules;
  if (facts.fit.one_reading || exclude_each_other(facts.person, facts.given)) return false;
  const double half = half_width(facts, facts.given);
  const bool told = !facts.contraction_given || *facts.contraction_given >= rules.half_shrinkage;
  return half > 0.0 && half <= identified_half(facts) && told && facts.fit.model_error <= rules.model_error &&
         !is_far(facts) && !facts.at_bound && !facts.at_range_end;
}

/// Returns the number's owners: of a joint's torque the muscles that make it, too.
std::vector<std::string> owners_of(const ParameterEstimate& e, const IdentificationResult& result) {
  std::vector<std::string> owners{e.muscle};
  for (const VoluntaryCurve& curve : result.voluntary) {
    if (curve.of_joint && curve.owner == e.muscle && e.parameter.ends_with(curve.ending))
      owners.insert(owners.end(), curve.muscles.begin(), curve.muscles.end());
  }
  return owners;
}

/// Returns true if the cap is of this parameter. What is wrong with a strength is wrong with the torque that it makes.
bool is_of(const VerdictCap& cap, const std::string& parameter) {
  const bool follows = is_voluntary(parameter) && !is_voluntary_angle(parameter);
  return covers(cap.parameters, parameter) || (follows && covers(cap.parameters, "max_isometric_force"));
}

}  // namespace

Finding finding(const NumberFacts& facts) {
  constexpr const VerdictRules& rules = kVerdictRules;
  // Where a search ran away to numbers of no muscle, that is the finding.
  if (!facts.fit.converged) return facts.impossible.empty() ? Finding::not_converged : Finding::impossible;
  if (facts.length_span && *facts.length_span < rules.least_length_span) return Finding::one_length;
  if (!facts.impossible.empty()) return Finding::impossible;
  if (!facts.bad_company.empty()) return Finding::bad_company;
  if (!facts.no_effect.empty()) return Finding::no_effect;
  if (!facts.determined) return Finding::undetermined;
  if (facts.fit.shared_force) return Finding::shared_force;
  if (facts.fit.r2 < rules.least_r2) return Finding::unexplained;
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
    case Finding::late_emg:
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
    case Finding::contradicted:
    case Finding::fault:
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
    text = "if F_max is the value at which it was held, whose error goes into every other number; " + text;
  if (finding == Finding::narrow_if_given) text = "compare sessions of this person by it, but not persons: " + text;
  if (exclude_each_other(facts.person, facts.given))
    text = "the person's interval excludes the one given geometry and sensors: these are not as assumed; " + text;
  if (finding == Finding::narrow_and_far)
    text = "a simplification of the model, or the EMG, may be what is fitted; " + text;
  if (finding == Finding::range_ends)
    text = "the recorded range ends here, and the maximum may lie beyond: record a wider range; " + text;
  if (finding == Finding::cut_off)
    text = "the interval ends at a bound: the recording pulls beyond what is physically possible; " + text;
  if (finding == Finding::wrong_model)
    text = fmt::format("the model errs by {:.0f} % in a way that depends on posture, effort and speed; {}",
                       100.0 * facts.fit.model_error, text);
  if (finding == Finding::unexplained)
    text = fmt::format(
        "the fit explains little of the {} (R2 {:.2f}): a sign, a unit, an offset, a clock, the order of files or a "
        "column is wrong, or the EMG is not that of these muscles; {}",
        fitted(facts), facts.fit.r2, text);
  if (finding == Finding::contradicted) text += ", but " + facts.contradiction;
  if (facts.fit.approximate) text += "; approximate: the normal approximation could not be checked";
  return text;
}

void judge(ParameterEstimate& estimate, const NumberFacts& facts) {
  const auto told = [](double value) { return std::isnan(value) ? std::nullopt : std::optional(value); };
  estimate.estimate = facts.person.value;
  estimate.std_error = told(facts.person.sd);
  estimate.ci_low = told(facts.person.low);
  estimate.ci_high = told(facts.person.high);
  estimate.given_estimate = told(facts.given.value);
  estimate.given_ci_low = told(facts.given.low);
  estimate.given_ci_high = told(facts.given.high);
  const Finding found = finding(facts);
  estimate.verdict = verdict_of(found);
  estimate.reason = reason_of(found, facts);
}

void keep_verdict(const ParameterEstimate& earlier, ParameterEstimate& estimate) {
  estimate.verdict = earlier.verdict;
  estimate.reason = earlier.reason;
}

void agree_on_tied(std::vector<ParameterEstimate>& estimates, std::size_t count) {
  if (count < 2 || estimates.size() < count || estimates.back().tied_to.empty()) return;
  const auto first = estimates.end() - static_cast<std::ptrdiff_t>(count);
  const ParameterEstimate worst = *std::max_element(
      first, estimates.end(), [](const auto& a, const auto& b) { return severity(a.verdict) < severity(b.verdict); });
  std::for_each(first, estimates.end(), [&](ParameterEstimate& e) { keep_verdict(worst, e); });
}

void apply(const std::vector<VerdictCap>& caps, IdentificationResult& result) {
  for (ParameterEstimate& e : result.estimates) {
    const std::vector<std::string> owners = owners_of(e, result);
    const auto touches = [&](const VerdictCap& c) {
      return c.method.value_or(result.method) == result.method && is_of(c, e.parameter) &&
             std::ranges::any_of(owners, [&](const std::string& owner) { return covers(c.owners, owner); });
    };
    const auto cap = std::ranges::find_if(
        caps, [&](const VerdictCap& c) { return severity(e.verdict) < severity(verdict_of(c.finding)) && touches(c); });
    if (cap != caps.end()) {
      e.verdict = verdict_of(cap->finding);
      e.reason = cap->reason;
      continue;
    }
    const auto first = std::ranges::find_if(caps, [&](const VerdictCap& c) { return c.comes_first && touches(c); });
    if (first != caps.end() && !e.reason.starts_with(first->reason))
      e.reason = fmt::format("{} {}", first->reason, e.reason);
  }
}

}  // namespace myoid::fit
