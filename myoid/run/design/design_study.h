#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/ground/core/progress.h"
#include "myoid/run/design/earlier_run.h"
#include "myoid/run/design/movement.h"
#include "myoid/run/design/movement_choice.h"

namespace myoid::run {

/// Returns the farther end of the 95 % interval (fit::half_width) as a percentage of the value; for the EMG
/// delay in ms; for a number that is 0 by nature as a percentage of its prior's half width.
[[nodiscard]] double relative_half_width(const fit::ParameterEstimate& estimate);
/// Returns the median of relative_half_width over all percentages of a value; 0 if there are none.
[[nodiscard]] double median_half_width(const std::vector<fit::ParameterEstimate>& estimates);
/// Counts the estimates with the verdict `identified`.
[[nodiscard]] int identified_count(const std::vector<fit::ParameterEstimate>& estimates);

struct DesignStudyOptions {
  DesignOptions choice;
  CatalogueOptions catalogue;
  /// "all", a parameter ("max_isometric_force"), a muscle ("BIC") or both
  /// ("BIC.force_length_width").
  std::vector<std::string> targets = {"all"};
  int persons = 12;              ///< Number drawn from the priors or the earlier run.
  double torque_sd_nm = 0.3;     ///< Noise of the joint torque below 2 Hz.
  double emg_cv = 0.087;         ///< Relative noise of the EMG envelope below 2 Hz.
  double gain_sd = 0.05;         ///< Spread of ln(EMG gain) per channel: the error of scaling EMG by MVCs.
  double fatigued_share = 0.05;  ///< Greatest share of any muscle that may be fatigued at any time.
  std::uint64_t seed = 1;
  std::optional<EarlierRun> earlier;
  Progress progress;
};

/// One movement of the plan.
struct PlannedMovement {
  Movement movement;
  double rest_before_s = 0.0;   ///< Keeps fatigue within its budget.
  double fatigued_share = 0.0;  ///< Share of the most tired muscle at the end.
  /// For each target: the estimate and interval expected after this movement.
  std::vector<fit::ParameterEstimate> expected;
};

struct DesignStudyResult {
  std::vector<fit::ParameterEstimate> beforehand;  ///< One for each target.
  std::vector<PlannedMovement> plan;               ///< In the order of their information.
  std::size_t catalogue_size = 0;
  std::string range;           ///< Says why the angles are not those of the model (human_range); empty: they are.
  std::size_t too_hard = 0;    ///< Number of movements that too few of the persons could do.
  std::size_t too_tiring = 0;  ///< Number of movements that alone exceed the fatigue budget.
  int exchanges = 0;
};

/// Chooses movements to record so that the targets become identifiable. The choice is Bayesian D- or A-optimal over a
/// catalogue, for persons drawn from the priors (or from an earlier run's posterior), with the information that the
/// posterior takes from a recording by its likelihood, in which moment arms, tendons, electrodes and the scale of the
/// torque are unknown, too. Fatigue follows the three-compartment model at the elbow's published rates: a movement that
/// alone would tire a muscle beyond the budget is left out, and rests are put before movements that need them. The plan
/// is empty if no movement is within the muscles' strength. Throws InvalidInput for unknown targets.
[[nodiscard]] DesignStudyResult design_study(const study::Study& study, const DesignStudyOptions& options = {});
/// Chooses movements with the study's model, read by the caller.
[[nodiscard]] DesignStudyResult design_study(const study::Study& study,
                                             const body::BodyModel& model,
                                             const DesignStudyOptions& options);

}  // namespace myoid::run
