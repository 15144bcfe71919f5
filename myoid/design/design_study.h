#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/core/progress.h"
#include "myoid/design/earlier_run.h"
#include "myoid/design/movement.h"
#include "myoid/intervals/result.h"
#include "myoid/methods/design.h"

namespace myoid {

/// Farther end of the 95 % interval (identification::half_width) as a percentage of the value; of
/// the EMG delay in ms; of a number that is 0 by nature as a percentage of its prior's half width.
[[nodiscard]] double relative_half_width(const identification::ParameterEstimate& estimate);
/// Median of relative_half_width over all that are percentages of a value; 0 if there are none.
[[nodiscard]] double median_half_width(
    const std::vector<identification::ParameterEstimate>& estimates);
/// Number of estimates with the verdict `identified`.
[[nodiscard]] int identified_count(const std::vector<identification::ParameterEstimate>& estimates);

struct DesignStudyOptions {
  identification::DesignOptions choice;
  CatalogueOptions catalogue;
  /// "all", a parameter ("max_isometric_force"), a muscle ("BIC") or both
  /// ("BIC.force_length_width").
  std::vector<std::string> targets = {"all"};
  int persons = 12;              ///< Number drawn from the priors or the earlier run.
  double torque_sd_nm = 0.3;     ///< Noise of the joint torque below 2 Hz.
  double emg_cv = 0.087;         ///< Relative noise of the EMG envelope below 2 Hz.
  double gain_sd = 0.05;         ///< Of ln(EMG gain), per channel: how well MVCs scale the EMG.
  double fatigued_share = 0.05;  ///< Greatest share of any muscle that may be fatigued at any time.
  std::uint64_t seed = 1;
  std::optional<EarlierRun> earlier;
  Progress progress;
};

/// One movement of the plan.
struct PlannedMovement {
  Movement movement;
  double rest_before_s = 0.0;   ///< So that fatigue stays within its budget.
  double fatigued_share = 0.0;  ///< Of the most tired muscle, at the end.
  /// Per target: the estimate and interval expected after this movement.
  std::vector<identification::ParameterEstimate> expected;
};

struct DesignStudyResult {
  std::vector<identification::ParameterEstimate> beforehand;  ///< Per target.
  std::vector<PlannedMovement> plan;                          ///< The most telling first.
  std::size_t catalogue_size = 0;
  std::size_t too_hard = 0;    ///< Movements that too few of the persons could do ...
  std::size_t too_tiring = 0;  ///< ... or that alone exceed the fatigue budget.
  int exchanges = 0;
};

/// Which movements to record so that the targets become identifiable: Bayesian D- or A-optimal over
/// a catalogue, for persons drawn from the priors (or from an earlier run's posterior), with the
/// estimator's own model, weights and effective number of samples. Fatigue by the three-compartment
/// model at the elbow's published rates; a movement that alone would tire a muscle beyond the
/// budget is left out, and rests are put before those that need them. The plan is empty if no
/// movement is within the muscles' strength. Throws InvalidInput for unknown targets.
[[nodiscard]] DesignStudyResult design_study(const Study& study,
                                             const DesignStudyOptions& options = {});
/// The same with the study's model, where that is read already.
[[nodiscard]] DesignStudyResult design_study(const Study& study,
                                             const model::BodyModel& model,
                                             const DesignStudyOptions& options);

}  // namespace myoid
