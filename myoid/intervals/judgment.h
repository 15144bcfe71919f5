#pragma once

#include <optional>
#include <string>

#include "myoid/intervals/result.h"
#include "myoid/intervals/verdict_rules.h"

namespace myoid::identification {

/// Facts that a verdict needs beyond the estimate itself.
struct VerdictContext {
  bool determined = true;  ///< Not in a direction that the data leave open.
  bool converged = true;
  std::string failure;            ///< Why not.
  bool from_mvc = true;           ///< EMG relative to a maximal contraction.
  bool plateau_is_flat = false;   ///< V_ml of the same muscle not clearly above 1.
  bool outside_physical = false;  ///< Value outside the physical bounds of its field.
  double prior_distance =
      0.0;  ///< |estimate - prior mean| in spreads of the prior; 0 without a prior.
  /// The source of the prior in words: "the literature's value" or another.
  std::string beforehand = "the literature's value";
  bool prior_of_logarithm = false;  ///< Its standard deviation is of the logarithm.
  bool prior_is_given = false;      ///< By the study.
  bool given_bound = false;         ///< The bound that was reached is the study's, not physics'.
  bool speed_is_free = false;       ///< v_max of the same muscle is an unknown.
  /// "lengthened" or "shortened": the motion in which alone the number acts and which the muscle
  /// never made while active; empty: the muscle made it.
  std::string never;
  /// Active lengths of the muscle over its optimal fiber length, of l0 and l_sh; empty: of another
  /// number, or the data are met exactly.
  std::optional<double> length_span;
  /// Share of the variance that comes from a tendon slack length that nobody measured.
  double tendon_share = 0.0;
  double muscle_distance = 0.0;  ///< PriorDistance::distance of the muscle.
  double relative_width = 0.0;   ///< Of l_sh: over l0 of the same fit; 0: of something else.
  double curve_width = 0.0;      ///< The same of the muscle that another number belongs to.
  bool width_leans = false;      ///< l_sh of that muscle leans on a bound of real muscles.
  std::string
      shares_electrode_with;  ///< Another muscle that acts as the same EMG says; empty: none.
  double model_error = 0.0;   ///< IdentificationResult::model_error.
  std::string rests_on;  ///< Trial without which the value would leave its interval; empty: none.
  bool shared_forces =
      false;  ///< The force that was fitted is an optimizer's share of a torque, not measured.
  bool given_strength = false;  ///< F_max was held where the user put it, and the fit is not exact.
  double r2 = 1.0;              ///< IdentificationResult::r2.
  std::string bad_company;      ///< Parameter of the same fit that left physiology; empty: none.
};

/// Distance from the value to the farther end of its 95 % interval: an interval that a bound cuts
/// short is no narrower for that. Needs both ends.
[[nodiscard]] double half_width(const ParameterEstimate& estimate);

/// The ground of a verdict, one for each sentence of `judgment_of`.
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

/// A verdict with its reason as a sentence, and the ground of both.
struct Judgment {
  Ground ground = Ground::no_number;
  Verdict verdict = Verdict::not_identifiable;
  std::string reason;
};
/// Returns the verdict by the first rule that applies to the estimate.
[[nodiscard]] Judgment judgment_of(const ParameterEstimate& estimate,
                                   const VerdictContext& context,
                                   const VerdictRules& rules);

/// A distance from the prior's mean in words, with the scale in which it is measured.
[[nodiscard]] std::string deviations(double distance, const VerdictContext& context);

}  // namespace myoid::identification
