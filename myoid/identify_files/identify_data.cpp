#include "myoid/identify_files/identify_data.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "myoid/checks/same_recording.h"
#include "myoid/core/error.h"
#include "myoid/identification/options.h"
#include "myoid/identify_files/identify_trial.h"
#include "myoid/methods/exchanged_electrodes.h"
#include "myoid/run/given_check.h"
#include "myoid/run/joint_of_arms.h"

namespace myoid {
namespace {

using identification::MuscleSetup;
using identification::StudyData;
using identification::TrialData;

/// Remarks on a recording that is in two trials. Computed data may be equal for good reason.
void compare_trials(const StudyData& data, const IdentifySources& sources, const TellRemark& remark) {
  constexpr double kAlike = 0.1;
  std::vector<Stretches> activations, lengths;
  for (const TrialData& trial : data.trials) {
    std::vector<Channel> names;
    for (const identification::MuscleSetup& muscle : data.muscles) names.push_back({muscle.name, Unit::meter});
    activations.push_back(stretches_of(trial.activation));
    lengths.push_back(stretches_of({trial.time_s, std::move(names), trial.length_m}));
    const std::size_t b = activations.size() - 1;
    for (std::size_t a = 0; a < b; ++a) {
      const double shared = common_share(activations[a], activations[b]);
      if (shared <= kAlike) continue;
      const bool moved = common_share(lengths[a], lengths[b]) <= kAlike;
      remark(fmt::format("{}: {:.0f} % of its activations are those of {}{}; was a file named twice by mistake?",
                         sources.activations[b], 100.0 * shared, sources.activations[a],
                         moved ? ", but the lengths are others" : ", and the lengths, too: one effort counts twice"));
    }
  }
}

/// Refuses a joint without torque and muscles without force in all trials.
void require_something_to_fit(const StudyData& data, const IdentifySources& sources) {
  const auto nothing = [](const auto& values) { return !(values.cwiseAbs().maxCoeff() > 0.0); };
  const std::string_view remedy = "there is nothing to fit; is it the right file and column, or was the channel off?";
  if (!sources.torque) {
    if (std::ranges::all_of(data.trials, [&](const TrialData& trial) { return nothing(trial.force_n); }))
      throw InvalidInput(fmt::format("{}: every force is 0 in all trials: {}", sources.forces.front(), remedy));
    return;
  }
  for (std::size_t j = 0; j < identification::joint_count(data.trials.front()); ++j) {
    if (std::ranges::all_of(
            data.trials, [&](const TrialData& trial) { return nothing(identification::of_joint(trial, j).torque_nm); }))
      throw InvalidInput(fmt::format("{}: the torque{} is 0 in all trials: {}", sources.torques.front(),
                                     sources.coordinates.empty() ? "" : fmt::format(" '{}'", sources.coordinates[j]),
                                     remedy));
  }
}

/// Remarks on activations that never change or are equal: the fit would give the work of one muscle to the others.
void compare_activations(const StudyData& data, const IdentifySources& sources, const TellRemark& remark) {
  std::vector<std::string> channels;
  for (const MuscleSetup& muscle : data.muscles) {
    if (std::ranges::find(channels, muscle.emg_channel) == channels.end()) channels.push_back(muscle.emg_channel);
  }
  const auto in_all = [&](const auto& holds) { return std::ranges::all_of(data.trials, holds); };
  const std::string& file = sources.activations.front();
  for (std::size_t c = 0; c < channels.size(); ++c) {
    // A table with a row for each maximal contraction has the activation 1 throughout.
    constexpr double kEffort = 0.5;
    if (in_all([&](const TrialData& trial) {
          const Eigen::VectorXd a = trial.activation.column(channels[c]);
          return !(a.maxCoeff() > a.minCoeff());
        })) {
      if (in_all([&](const TrialData& trial) { return trial.activation.column(channels[c]).minCoeff() >= kEffort; }))
        continue;
      remark(
          fmt::format("{}: activation '{}' never changes in any trial: was the electrode connected? The work of its "
                      "muscles is given to the others; leave them out of muscles.csv only if they were at rest",
                      file, channels[c]));
      continue;
    }
    for (std::size_t other = 0; other < c; ++other) {
      if (in_all([&](const TrialData& trial) {
            return trial.activation.column(channels[c]) == trial.activation.column(channels[other]);
          }))
        remark(
            fmt::format("{}: activations '{}' and '{}' are the same in all trials: was a column copied? If one "
                        "electrode stands for both, name it for both in the column emg of muscles.csv",
                        file, channels[other], channels[c]));
    }
  }
}

void hold_back(const IdentifySources& sources, StudyData& data) {
  for (const std::string& name : sources.held_back) data.trials[trial_named(name, sources.lengths)].calibration = false;
  if (std::ranges::none_of(data.trials, [](const TrialData& trial) { return trial.calibration; }))
    throw InvalidInput("--validate names every trial; leave out one at least for the fit");
}

}  // namespace

StudyData read_identify_data(const IdentifySources& sources, const MuscleTable& table, const TellRemark& remark) {
  require_counts(sources);
  for (const std::string& note : table.notes) remark(note);
  StudyData data;
  data.muscles = table.muscles;
  data.rules = table.rules;
  for (std::size_t i = 0; i < sources.lengths.size(); ++i) {
    TrialData trial = read_identify_trial(sources, i, data.muscles, remark);
    for (const std::string& text : check_given_trial(data, trial, files_of(sources, i))) remark(text);
    for (const std::string& text : check_joint_of_arms(data, trial, files_of(sources, i))) remark(text);
    data.trials.push_back(std::move(trial));
  }
  if (sources.torque) hold_back(sources, data);
  require_something_to_fit(data, sources);
  compare_activations(data, sources, remark);
  compare_trials(data, sources, remark);
  if (sources.torque) {
    if (const auto exchanged =
            identification::exchanged_electrodes(data, identification::EstimatorOptions{}.delay_prior_mean_s))
      remark(fmt::format("{}: {}", sources.activations.front(), exchanged->sentence()));
  }
  return data;
}

}  // namespace myoid
