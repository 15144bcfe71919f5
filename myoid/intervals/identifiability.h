#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "myoid/intervals/result.h"

namespace myoid::identification {

/// The facts beside the estimate on which its verdict depends.
struct VerdictContext {
  bool determined = true;  ///< False: it lies in a direction that the data leave open.
  bool converged = true;
  std::string failure;            ///< Reason why the search did not converge.
  bool from_mvc = true;           ///< EMG is relative to a maximal contraction.
  bool plateau_is_flat = false;   ///< V_ml of the same muscle is not clearly above 1.
  bool outside_physical = false;  ///< Value is outside the physical bounds of its field.
  double prior_distance = 0.0;    ///< |estimate - prior mean| in spreads of the prior; 0 without a prior.
  /// The source of the prior in words: "the literature's value" or another.
  std::string beforehand = "the literature's value";
  bool prior_of_logarithm = false;  ///< The prior's standard deviation is that of the logarithm.
  bool prior_is_given = false;      ///< The study gives the prior.
  bool given_bound = false;         ///< The study, not physics, gives the bound that was reached.
  bool speed_is_free = false;       ///< v_max of the same muscle is an unknown.
  /// "lengthened" or "shortened": the only motion in which the number acts and which the active
  /// muscle never made; empty: the muscle made this motion.
  std::string never;
  /// For l0 and l_sh: range of the muscle's active lengths over its optimal fiber length. Empty for
  /// another number and where the data are met exactly.
  std::optional<double> length_span;
  /// Share of the variance that an unmeasured tendon slack length causes.
  double tendon_share = 0.0;
  double muscle_distance = 0.0;       ///< PriorDistance::distance of the muscle.
  double relative_width = 0.0;        ///< For l_sh: its ratio to l0 of the same fit; 0 for other numbers.
  double curve_width = 0.0;           ///< For other numbers: the ratio l_sh / l0 of their muscle.
  bool width_leans = false;           ///< l_sh of that muscle is on a bound of real muscles.
  std::string shares_electrode_with;  ///< Another muscle that acts as the same EMG says; empty: none.
  double model_error = 0.0;           ///< IdentificationResult::model_error.
  std::string rests_on;               ///< Trial without which the value would leave its interval; empty: none.
  bool shared_forces = false;         ///< The force that was fitted is an optimizer's share of a torque, not measured.
  bool given_strength = false;        ///< F_max is held at the user's value, and the fit is not exact.
  double r2 = 1.0;                    ///< IdentificationResult::r2.
  std::string bad_company;            ///< Parameter of the same fit that left physiology; empty: none.
};

/// Returns the distance from the value to the farther end of its 95 % interval, because a bound
/// that cuts an interval adds no information. Needs both ends.
[[nodiscard]] double half_width(const ParameterEstimate& estimate);

/// The fact beside the interval's width that a reason tells already.
enum class Tells { nothing, distance, curve };

/// A verdict and its reason as a sentence.
struct Judgment {
  Verdict verdict = Verdict::not_identifiable;
  std::string reason;
  Tells tells = Tells::nothing;
};

/// Returns the verdict by the first rule that applies to the estimate.
[[nodiscard]] Judgment judgment_of(const ParameterEstimate& estimate, const VerdictContext& context);

/// Describes a distance from the prior's mean in words, with the scale of its measure.
[[nodiscard]] std::string deviations(double distance, const VerdictContext& context);

/// Returns the end of the reason of F_max where no maximal contraction was recorded, else nothing.
[[nodiscard]] std::string beside_the_maximum(std::string_view parameter, bool from_mvc);

/// Fills `verdict` and `reason` of an estimate whose other fields are complete.
void judge(ParameterEstimate& estimate, const VerdictContext& context);

/// Returns the rank of a verdict; a greater rank is worse.
[[nodiscard]] int severity(Verdict verdict);

/// Returns the |N(0, 1)| that is as improbable as a sum of `count` squares of at least this size
/// (chi-square): several deviations as one number of standard deviations.
[[nodiscard]] double equivalent_deviations(double sum_of_squares, int count);

}  // namespace myoid::identification
