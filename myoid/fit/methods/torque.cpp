#include "myoid/fit/methods/torque.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/fit/intervals/verdict_rules.h"
#include "myoid/fit/measurement/told_by_motion.h"
#include "myoid/fit/measurement/unseen_activations.h"
#include "myoid/fit/methods/emg_clock.h"
#include "myoid/fit/methods/plain_fit.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/posterior/drive.h"
#include "myoid/fit/posterior/posterior.h"

namespace myoid::fit {
namespace {

void add_predictions(const StudyData& data, const EstimatorOptions& options, IdentificationResult& result) {
  ModelValues literature = result.values;
  for (std::size_t k = 0; k < data.muscles.size(); ++k)
    literature.muscles[k] = muscle_values(data.muscles[k].start, data.muscles[k].extras);
  for (ChannelValues& channel : literature.channels) {
    channel[kDelay] = options.usual_delay_s();
    channel[kGain] = 1.0;
    channel[kShape] = 0.0;
    channel[kExponent] = 1.0;
  }
  const TrialPredictions predictions(data, options, result);
  for (const TrialData& whole : data.trials) {
    for (std::size_t j = 0; j < joint_count(whole); ++j) {
      const TrialData trial = of_joint(whole, j);
      TrialFit& fit = result.trials.emplace_back(predictions.of(trial));
      Prediction before = predict(data, trial, literature, options.law);
      fit.literature_force_n = std::move(before.force_n);
      fit.literature_torque_nm = std::move(before.torque_nm);
    }
  }
}

/// Returns the measured muscles that pull with a muscle without EMG about a joint of which it makes a tenth of the
/// strength or more, by the starting values: its torque may be counted as theirs.
std::vector<std::string> pulling_with(std::size_t hidden, const StudyData& data) {
  constexpr double kMuch = 0.1;
  std::vector<std::string> found;
  for (const TrialData& trial : data.trials) {
    for (std::size_t j = 0; j < joint_count(trial); ++j) {
      const Eigen::RowVectorXd arm_m = joint_at(trial, j).moment_arm_m.colwise().mean();
      Eigen::RowVectorXd strength_nm = arm_m * (arm_m[static_cast<Eigen::Index>(hidden)] > 0.0 ? 1.0 : -1.0);
      for (std::size_t k = 0; k < data.muscles.size(); ++k)
        strength_nm[static_cast<Eigen::Index>(k)] *= data.muscles[k].start.max_isometric_force_n;
      const double all_nm = strength_nm.cwiseMax(0.0).sum();
      if (!(strength_nm[static_cast<Eigen::Index>(hidden)] >= kMuch * all_nm)) continue;
      for (std::size_t k = 0; k < data.muscles.size(); ++k) {
        const MuscleSetup& muscle = data.muscles[k];
        if (!muscle.unseen && strength_nm[static_cast<Eigen::Index>(k)] > 0.0 && !fit::contains(found, muscle.name))
          found.push_back(muscle.name);
      }
    }
  }
  return found;
}

/// Caps the numbers of muscles without EMG: nothing tells F_max, and every other number is weak at best, as those of
/// the muscles that pull with them.
void add_muscles_without_emg(const StudyData& data, std::vector<VerdictCap>& caps) {
  for (std::size_t k = 0; k < data.muscles.size(); ++k) {
    const MuscleSetup& muscle = data.muscles[k];
    if (!muscle.unseen) continue;
    const std::string says = without_emg_says(muscle.name);
    caps.push_back({.reason = says,
                    .owners = {muscle.name},
                    .parameters = {"max_isometric_force"},
                    .finding = Finding::no_effect});
    caps.push_back({.reason = says, .owners = {muscle.name}});
    std::vector<std::string> others = pulling_with(k, data);
    if (others.empty()) continue;
    caps.push_back({.reason = fmt::format(
                        "{} pulls with it and has no EMG: torque of one may be counted as the other's", muscle.name),
                    .owners = std::move(others)});
  }
}

}  // namespace

EstimatorOptions remembering_drives(EstimatorOptions options) {
  if (!options.drives) options.drives = std::make_shared<DriveMemory>();
  return options;
}

std::vector<VerdictCap> caps_of_torque(const StudyData& data,
                                       const EstimatorOptions& options,
                                       IdentificationResult& result) {
  std::vector<VerdictCap> caps;
  const std::optional<double> share = told_by_motion_alone(data);
  if (share && *share >= kVerdictRules.motion_alone) {
    std::string says = fmt::format(
        "angle, rate and acceleration alone tell {:.1f} % of the torque's variance, as of a spring and an inertia: "
        "intervals may miss the truth. Record efforts against several loads, or at held angles",
        100.0 * *share);
    result.warnings.push_back({.code = RemarkCode::motion_alone, .says = std::move(says)});
    caps.push_back({.reason = fmt::format("motion alone tells {:.1f} % of the torque", 100.0 * *share)});
  }
  add_muscles_without_emg(data, caps);
  if (!options.predictions) return caps;
  if (const std::optional<LateEmg> late = late_emg_of_no_delay(data, options, result)) {
    result.warnings.push_back({.code = RemarkCode::late_emg, .says = "emg_delay: " + late->sentence()});
    caps.push_back({.reason = late->sentence(), .parameters = {"emg_delay"}, .finding = Finding::late_emg});
  }
  return caps;
}

IdentificationResult identify_torque(const StudyData& data, const EstimatorOptions& options) {
  const EstimatorOptions remembering = remembering_drives(options);
  IdentificationResult result = identify_by_posterior(data, remembering);
  if (options.predictions) add_predictions(data, remembering, result);
  if (!options.measured_is_force) fit::apply(caps_of_torque(data, options, result), result);
  return result;
}

std::optional<IdentificationResult> identify_exactly(const StudyData& data, const EstimatorOptions& options) {
  std::optional<IdentificationResult> exact = exact_fit(data, options);
  if (exact && options.predictions) add_predictions(data, options, *exact);
  return exact;
}

}  // namespace myoid::fit
