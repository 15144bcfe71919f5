#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/ground/core/numbers.h"

namespace myoid::fit {

/// A value, its 95 % interval and its standard deviation; NaN: not told.
struct Reading {
  double value = kNan, low = kNan, high = kNan, sd = kNan;
};

/// The facts about a fit that all of its numbers share.
struct FitFacts {
  bool converged = true;
  std::string failure;          ///< Reason why the search did not end at a minimum.
  bool of_force = false;        ///< The fit is to a force.
  bool shared_force = false;    ///< An optimizer shared the force that was fitted; nobody measured it.
  bool given_strength = false;  ///< F_max is held at the user's value.
  /// Method `paper`, a fit of exact data and a planned recording have one reading: the person's.
  bool one_reading = false;
  bool approximate = false;  ///< Intervals come from a normal approximation that could not be checked.
  double r2 = 1.0;           ///< R2 of the fitted torque or force.
  double model_error = 0.0;  ///< Relative size of the model's systematic error.
};

/// The scale of a width: a share of the value, or seconds, or radians.
enum class Scale { share, delay, angle };

/// The facts about one number, from which its verdict follows.
struct NumberFacts {
  FitFacts fit;
  Reading person;                  ///< The person's.
  Reading given;                   ///< With geometry and sensors exact.
  bool determined = true;          ///< False: it lies in a direction that the data leave open.
  std::string no_effect = {};      ///< Reason why nothing in the data depends on the number.
  std::string bad_company = {};    ///< Another number of the same fit that no muscle can have.
  std::string impossible = {};     ///< Reason why no muscle can have this value.
  std::string contradiction = {};  ///< What another fit of the same muscle says against it.
  bool nuisance_gain = false;      ///< The gain of an EMG channel: a scale that F_max shares.
  /// 1 - posterior variance / prior variance; empty: no prior.
  std::optional<double> contraction = {};
  std::optional<double> contraction_given = {};  ///< The same with geometry and sensors exact.
  /// Distance of the value from the prior's mean, in its standard deviations; empty: no prior.
  std::optional<double> prior_distance = {};
  /// The size of which widths are shares. A number that is 0 by nature has 1.96 standard deviations of its prior here;
  /// empty: widths are shares of the value.
  std::optional<double> usual_size = {};
  Scale scale = Scale::share;
  bool at_range_end = false;  ///< A place of a maximum, or its interval, ends where the recording ends.
  bool at_bound = false;      ///< An end of the interval is as good as a bound (VerdictRules::on_bound).
  /// For l0 and l_sh: range of lengths at which the muscle is active, over l0.
  std::optional<double> length_span = {};
  SourceShares shares{};
};

/// The answer to these questions: did the search converge; did the muscle act at more than one length; is the number
/// possible, does the fit determine it and explain the torque; is the interval narrow with geometry and sensors exact;
/// how much narrower than the prior is the person's; is it narrow enough to use; does the model hold; do both readings
/// agree.
enum class Finding {
  not_converged,
  one_length,  ///< VerdictRules::least_length_span: the interval is that of F_max's prior.
  impossible,
  bad_company,
  no_effect,
  undetermined,
  shared_force,
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
  given_strength,   ///< Narrow enough, if F_max is right.
  half_the_prior,   ///< Narrow enough, but contraction below VerdictRules::half_shrinkage.
  contradicted,     ///< Narrow enough, but another fit of the muscle contradicts it.
  late_emg,         ///< EMG that comes after the torque tells no delay (fit/methods/emg_clock.h).
  fault,            ///< A fault of the recording, or of the fit as a whole, touches it.
  narrow
};

/// Returns the first finding that holds.
[[nodiscard]] Finding finding(const NumberFacts& facts);
[[nodiscard]] Verdict verdict_of(Finding finding);
/// Returns a sentence with the finding, its numbers, and the sources that contribute a tenth or more of the variance.
[[nodiscard]] std::string reason_of(Finding finding, const NumberFacts& facts);

/// Fills both readings, verdict and reason of an estimate.
void judge(ParameterEstimate& estimate, const NumberFacts& facts);

/// Gives the last `count` estimates, which are one unknown of several owners, the worst of their
/// verdicts with its reason. A number of one owner stays unchanged.
void agree_on_tied(std::vector<ParameterEstimate>& estimates, std::size_t count);

/// Copies verdict and reason of the same number of an earlier run.
void keep_verdict(const ParameterEstimate& earlier, ParameterEstimate& estimate);

/// A fact beside the numbers' own: a number that it touches is at most as good as the finding says, however narrow its
/// interval is.
struct VerdictCap {
  std::string reason;                        ///< A sentence.
  std::vector<std::string> owners = {};      ///< Muscles and EMG channels whose numbers rest on it; empty: all.
  std::vector<std::string> parameters = {};  ///< Their parameters that rest on it; empty: all.
  std::optional<Method> method = {};         ///< Empty: all.
  Finding finding = Finding::fault;
  bool comes_first = false;  ///< A mistake that explains other reasons: it stands before them.
};

/// Gives the estimates that the caps name the verdict of their first cap and its reason, if their own is better. Else
/// the reason of the first cap that comes first stands before their own. The same for every method.
void apply(const std::vector<VerdictCap>& caps, IdentificationResult& result);

}  // namespace myoid::fit
