#pragma once

#include <optional>
#include <string>

#include "myoid/intervals/result.h"
#include "myoid/intervals/variance_sources.h"

namespace myoid::identification {

/// What the posterior says of one number.
struct PosteriorFacts {
  bool converged = true;
  bool approximate = false;    ///< The interval is that of the normal approximation.
  bool nuisance_gain = false;  ///< The gain of an EMG channel: a scale that F_max shares.
  double value = 0.0, low = 0.0, high = 0.0;  ///< Of the person, 95 %.
  double low_given = 0.0, high_given = 0.0;   ///< The same, geometry and sensors exact.
  /// 1 - posterior variance / prior variance; empty: no prior.
  std::optional<double> contraction;
  bool possible = true;  ///< A muscle can have it.
  bool is_delay = false;
  /// Of l0 and l_sh: the lengths of the muscle while it is active, over l0.
  std::optional<double> length_span;
  double r2 = 1.0;  ///< Of the fitted torque.
  SourceShares shares{};
};

/// The answer to five questions: did the search converge; did the muscle act at more than one
/// length; is the number possible and does the fit explain the torque; how much narrower than the
/// prior is the interval; is it narrow enough to use.
enum class Finding {
  not_converged,
  one_length,  ///< VerdictRules::least_length_span: the interval is that of F_max's prior.
  impossible,
  unexplained,     ///< R2 of the fit below VerdictRules::least_r2.
  as_the_prior,    ///< Contraction below VerdictRules::least_shrinkage.
  too_wide,        ///< Beyond VerdictRules::weak_half_width.
  half_the_prior,  ///< Narrow enough, but contraction below VerdictRules::half_shrinkage.
  wide,            ///< Beyond VerdictRules::identified_half_width.
  narrow
};

/// The first that holds.
[[nodiscard]] Finding finding(const PosteriorFacts& facts);
[[nodiscard]] Verdict verdict_of(Finding finding);
/// A sentence: the finding with its numbers, and the sources that make a tenth or more of the
/// variance.
[[nodiscard]] std::string reason_of(Finding finding, const PosteriorFacts& facts);

}  // namespace myoid::identification
