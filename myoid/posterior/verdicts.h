#pragma once

#include <optional>
#include <string>

#include "myoid/intervals/result.h"

namespace myoid::identification {

/// The posterior's facts about one number, from which its verdict follows.
struct PosteriorFacts {
  bool converged = true;
  bool approximate = false;                   ///< The interval comes from the normal approximation.
  bool nuisance_gain = false;                 ///< The gain of an EMG channel: a scale that F_max shares.
  double value = 0.0, low = 0.0, high = 0.0;  ///< The person's value and 95 % interval.
  /// Value and 95 % interval with geometry and sensors exact.
  double given = 0.0, low_given = 0.0, high_given = 0.0;
  /// 1 - posterior variance / prior variance; empty: no prior.
  std::optional<double> contraction;
  std::optional<double> contraction_given;  ///< The same with geometry and sensors exact.
  /// Distance of the value from the prior's mean, in its standard deviations; empty: no prior.
  std::optional<double> prior_distance;
  /// The size of which widths are shares. A number that is 0 by nature has 1.96 standard deviations of its prior here;
  /// empty: widths are shares of the value.
  std::optional<double> usual_size;
  bool possible = true;  ///< A muscle can have this value.
  bool is_delay = false;
  bool is_angle = false;      ///< Its width is absolute, as a delay's.
  bool at_range_end = false;  ///< A place of a maximum, or its interval, ends where the recording ends.
  bool at_bound = false;      ///< An end of the interval is as good as a bound (VerdictRules::on_bound).
  /// For l0 and l_sh: range of lengths at which the muscle is active, over l0.
  std::optional<double> length_span;
  bool of_force = false;     ///< The fit is to a force.
  double r2 = 1.0;           ///< R2 of the fitted torque or force.
  double model_error = 0.0;  ///< Relative size of the model's systematic error.
  SourceShares shares{};
};

/// The answer to these questions: did the search converge; did the muscle act at more than one length; is the number
/// possible and does the fit explain the torque; is the interval narrow with geometry and sensors exact; how much
/// narrower than the prior is the person's; is it narrow enough to use; does the model hold; do both readings agree.
enum class Finding {
  not_converged,
  one_length,  ///< VerdictRules::least_length_span: the interval is that of F_max's prior.
  impossible,
  unexplained,      ///< R2 of the fit below VerdictRules::least_r2.
  narrow_if_given,  ///< Narrow with geometry and sensors exact, and not for the person.
  readings_apart,   ///< Narrow, but the person's interval and the one with exact geometry exclude each other.
  as_the_prior,     ///< Contraction below VerdictRules::least_shrinkage.
  far_from_prior,   ///< So, and farther from the prior than VerdictRules::prior_conflict.
  too_wide,         ///< Beyond VerdictRules::weak_half_width.
  wide,             ///< Beyond VerdictRules::identified_half_width.
  wrong_model,      ///< Narrow enough, but the model errs by more than VerdictRules::model_error.
  narrow_and_far,   ///< Narrow enough, but farther than VerdictRules::prior_conflict.
  cut_off,          ///< Narrow enough, but by a bound.
  range_ends,       ///< Narrow enough, but the recorded range ends there: the maximum may lie beyond.
  half_the_prior,   ///< Narrow enough, but contraction below VerdictRules::half_shrinkage.
  narrow
};

/// Returns the first finding that holds.
[[nodiscard]] Finding finding(const PosteriorFacts& facts);
[[nodiscard]] Verdict verdict_of(Finding finding);
/// Returns a sentence with the finding, its numbers, and the sources that contribute a tenth or more of the variance.
[[nodiscard]] std::string reason_of(Finding finding, const PosteriorFacts& facts);

}  // namespace myoid::identification
