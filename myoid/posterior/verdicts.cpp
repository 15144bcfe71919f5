#include "myoid/posterior/verdicts.h"

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

std::string_view fitted(const PosteriorFacts& facts) { return facts.of_force ? "force" : "torque"; }

/// Returns the distance from the value to the farther end: of a delay in seconds, of an angle in radians, else as a
/// share.
double half_width(const PosteriorFacts& facts, double value, double low, double high) {
  const double half = std::max(value - low, high - value);
  const bool absolute = facts.is_delay || facts.is_angle;
  return absolute ? half : half / std::max(facts.usual_size.value_or(std::abs(value)), 1e-12);
}

double half_of_person(const PosteriorFacts& facts) { return half_width(facts, facts.value, facts.low, facts.high); }

double half_given(const PosteriorFacts& facts) {
  return half_width(facts, facts.given, facts.low_given, facts.high_given);
}

bool is_far(const PosteriorFacts& facts) {
  return facts.prior_distance && *facts.prior_distance > kVerdictRules.prior_conflict;
}

std::string size_text(double half, const PosteriorFacts& facts) {
  if (facts.is_delay) return fmt::format("± {:.0f} ms", 1000.0 * half);
  if (facts.is_angle) return fmt::format("± {:.2g}°", half / kDegree);
  return half < 0.995 ? fmt::format("± {:.2g} %", 100.0 * half) : fmt::format("± {:.0f} %", 100.0 * half);
}

double identified_half(const PosteriorFacts& facts) {
  return facts.is_delay   ? kVerdictRules.delay_identified_s
         : facts.is_angle ? kVerdictRules.angle_identified_rad
                          : kVerdictRules.identified_half_width;
}

double weak_half(const PosteriorFacts& facts) {
  return facts.is_delay   ? kVerdictRules.delay_weak_s
         : facts.is_angle ? kVerdictRules.angle_weak_rad
                          : kVerdictRules.weak_half_width;
}

std::string sources_text(const PosteriorFacts& facts) {
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

/// The finding about the person's interval, of a fit that may be judged by its widths.
Finding of_person(const PosteriorFacts& facts) {
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
  if (facts.contraction && *facts.contraction < rules.half_shrinkage) return Finding::half_the_prior;
  if (facts.high < facts.low_given || facts.high_given < facts.low) return Finding::readings_apart;
  return Finding::narrow;
}

/// Returns true if the number is narrow with geometry and sensors exact, and by the recording, not by its prior.
bool narrow_if_given(const PosteriorFacts& facts) {
  constexpr const VerdictRules& rules = kVerdictRules;
  const double half = half_given(facts);
  const bool told = !facts.contraction_given || *facts.contraction_given >= rules.half_shrinkage;
  return half > 0.0 && half <= identified_half(facts) && told && facts.model_error <= rules.model_error &&
         !is_far(facts) && !facts.at_bound && !facts.at_range_end;
}

}  // namespace

Finding finding(const PosteriorFacts& facts) {
  constexpr const VerdictRules& rules = kVerdictRules;
  if (!facts.converged) return Finding::not_converged;
  if (facts.length_span && *facts.length_span < rules.least_length_span) return Finding::one_length;
  if (!facts.possible) return Finding::impossible;
  if (facts.r2 < rules.least_r2) return Finding::unexplained;
  if (facts.nuisance_gain) return Finding::as_the_prior;
  const Finding person = of_person(facts);
  return person != Finding::narrow && narrow_if_given(facts) ? Finding::narrow_if_given : person;
}

Verdict verdict_of(Finding finding) {
  switch (finding) {
    case Finding::not_converged:
    case Finding::unexplained:
    case Finding::too_wide:
    case Finding::far_from_prior:
    case Finding::cut_off:
      return Verdict::not_identifiable;
    case Finding::impossible:
      return Verdict::non_physical;
    case Finding::one_length:
    case Finding::as_the_prior:
      return Verdict::prior_dominated;
    case Finding::wide:
    case Finding::wrong_model:
    case Finding::narrow_and_far:
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

std::string reason_of(Finding finding, const PosteriorFacts& facts) {
  if (finding == Finding::not_converged) return "the search for the posterior's mode did not end";
  if (finding == Finding::one_length) return one_length_text(*facts.length_span);
  std::string text =
      fmt::format("{} of the person, {} given geometry and sensors{}", size_text(half_of_person(facts), facts),
                  size_text(half_given(facts), facts), facts.usual_size ? ", as shares of what is usual" : "");
  if (facts.contraction)
    text += fmt::format("; the recording takes {:.0f} % off the prior's variance",
                        100.0 * std::max(0.0, *facts.contraction));
  if (const std::string sources = sources_text(facts); !sources.empty()) text += "; it rests on " + sources;
  if (is_far(facts)) text += fmt::format("; {:.1f} standard deviations away from its prior", *facts.prior_distance);
  if (finding == Finding::impossible)
    text = "no muscle has this ratio of l_sh to l0: the fit describes another thing; " + text;
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

}  // namespace myoid::identification
