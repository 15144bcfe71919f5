#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/core/fault.h"
#include "myoid/core/provenance.h"
#include "myoid/design/design_study.h"
#include "myoid/dynamics/ground_support.h"
#include "myoid/forces/force_sharing.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/methods/cross_validation.h"
#include "myoid/methods/exchanged_electrodes.h"
#include "myoid/methods/force_loop.h"
#include "myoid/methods/paper.h"
#include "myoid/methods/resting_torque.h"
#include "myoid/methods/torque.h"
#include "myoid/phases/phases.h"
#include "myoid/run/study_inputs.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/study/study.h"

namespace myoid {

/// Everything that was found about one trial, stage by stage.
struct TrialResult {
  TrialSpec spec;
  model::BodyModel model;  ///< With the trial's held mass and calibrated coordinates.
  std::optional<kinematics::IkResult> ik;          ///< If it began with markers.
  std::optional<recording::MarkerSeries> markers;  ///< As inverse kinematics saw them.
  bool ik_reused = false;  ///< Taken from an earlier run with the same input.
  kinematics::JointMotion
      motion;  ///< On the clock of the analysis; empty for an MVC trial without motion.
  std::optional<signals::EmgStages> emg;  ///< If its EMG was raw.
  std::optional<TrialClock> emg_clock;    ///< How its EMG came onto the motion's clock.
  TimeSeries activation;                  ///< Per EMG channel, 0..1.
  TimeSeries generalized_forces;          ///< Inverse dynamics, all coordinates.
  kinematics::MuscleKinematics muscles;   ///< Of the model's muscles.
  TimeSeries muscle_torque;     ///< Of the study's coordinates: what the muscles provide [N m].
  forces::MuscleForces shared;  ///< Of the model's muscles.
  std::optional<dynamics::UncarriedTime>
      uncarried;                      ///< What of it has torques that lack a ground reaction.
  std::vector<std::string> notes;     ///< Repairs and remarks, with file and line.
  std::vector<std::string> warnings;  ///< Those of them that may make numbers wrong.
  std::vector<Fault> faults;          ///< Of its recordings, as they came.
  std::string failure;                ///< Why it could not be computed; empty: it could.

  [[nodiscard]] bool has_motion() const { return motion.q.sample_count() > 0 && failure.empty(); }
};

struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

/// Everything that was found in a study, whole: what the writers of files and reports take.
struct StudyResult {
  Study study;
  std::optional<double> start_s, end_s;  ///< As RunOptions had them.
  model::BodyModel model;                ///< The study's model, without held mass.
  std::string model_text;                ///< As read or made.
  std::vector<TrialResult> trials;       ///< In the study's order.
  std::vector<Fault> level_faults;       ///< Of EMG channels, over all trials.
  signals::Whitening whitening;          ///< Of raw EMG: one answer for all of it.
  std::vector<signals::ChannelNormalisation> normalisation;  ///< Empty if EMG came as activations.
  std::vector<identification::RestingJoint> resting;  ///< Joints whose passive torque was measured.
  identification::StudyData data;                     ///< What the estimators saw.
  std::vector<identification::IdentificationResult> methods;
  std::vector<identification::Fold> folds;
  std::vector<TrialPhases> phases;  ///< Of the trials of `data`; empty: not searched.
  /// Forces and activations with the identified muscles, informed by the EMG; of the trials of
  /// `data`. Empty without method torque.
  std::vector<identification::InformedForces> informed;
  std::optional<identification::ForceLoop> force_loop;  ///< If the study asks for it.
  std::optional<identification::ExchangedElectrodes>
      exchanged;  ///< Labels that fit better the other way round.
  /// Which movements would tell more; empty without method torque, or if none is asked for.
  std::optional<DesignStudyResult> next;
  std::vector<TrueValue> truth;
  std::vector<StageTime> times;
  std::vector<InputFile> inputs;
  int failed_trials = 0;
};

/// The activations of a study's trials and what they are measured against.
struct StudyActivations {
  std::vector<TimeSeries> of_trial;  ///< In the study's order; empty: no EMG.
  signals::Whitening whitening;
  std::vector<signals::ChannelNormalisation> normalisation;
};

/// The activations that stand in a result.
[[nodiscard]] inline StudyActivations activations_of(const StudyResult& result) {
  StudyActivations found{{}, result.whitening, result.normalisation};
  for (const TrialResult& trial : result.trials) found.of_trial.push_back(trial.activation);
  return found;
}

}  // namespace myoid
