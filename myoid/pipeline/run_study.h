#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/core/progress.h"
#include "myoid/core/provenance.h"
#include "myoid/forces/force_sharing.h"
#include "myoid/identification/cross_validation.h"
#include "myoid/identification/force_loop.h"
#include "myoid/identification/paper.h"
#include "myoid/identification/torque.h"
#include "myoid/kinematics/inverse_kinematics.h"
#include "myoid/kinematics/muscle_kinematics.h"
#include "myoid/pipeline/design_study.h"
#include "myoid/pipeline/exchanged_electrodes.h"
#include "myoid/pipeline/phases.h"
#include "myoid/pipeline/study.h"
#include "myoid/pipeline/trial_input.h"
#include "myoid/recording/text_file.h"
#include "myoid/signals/emg_envelope.h"
#include "myoid/signals/fault.h"

namespace myoid::pipeline {

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
  TimeSeries muscle_torque;        ///< Of the study's coordinates: what the muscles provide [N m].
  forces::MuscleForces shared;     ///< Of the model's muscles.
  std::vector<std::string> notes;  ///< Repairs and remarks, with file and line.
  std::vector<std::string> warnings;   ///< Those of them that may make numbers wrong.
  std::vector<signals::Fault> faults;  ///< Of its recordings, as they came.
  std::string failure;                 ///< Why it could not be computed; empty: it could.

  [[nodiscard]] bool has_motion() const { return motion.q.sample_count() > 0 && failure.empty(); }
};

struct StageTime {
  std::string stage;
  double seconds = 0.0;
};

/// A true value of a virtual recording.
struct TrueValue {
  std::string muscle, parameter;
  double value = 0.0;
};

struct StudyResult {
  Study study;
  std::optional<double> start_s, end_s;             ///< As RunOptions had them.
  model::BodyModel model;                           ///< The study's model, without held mass.
  std::string model_text;                           ///< As read or made.
  std::vector<TrialResult> trials;                  ///< In the study's order.
  std::vector<signals::Fault> level_faults;         ///< Of EMG channels, over all trials.
  std::vector<signals::WhiteningFilter> whitening;  ///< Of raw EMG; empty if not whitened.
  std::vector<signals::ChannelNormalisation> normalisation;  ///< Empty if EMG came as activations.
  identification::StudyData data;                            ///< What the estimators saw.
  std::vector<identification::IdentificationResult> methods;
  std::vector<identification::Fold> folds;
  std::vector<TrialPhases> phases;  ///< Of the trials of `data`; empty: not searched.
  /// Forces and activations with the identified muscles, informed by the EMG; of the trials of
  /// `data`. Empty without method torque.
  std::vector<identification::InformedForces> informed;
  std::optional<identification::ForceLoop> force_loop;  ///< If the study asks for it.
  std::optional<ExchangedElectrodes> exchanged;  ///< Labels that fit better the other way round.
  /// Which movements would tell more; empty without method torque, or if none is asked for.
  std::optional<DesignStudyResult> next;
  std::vector<TrueValue> truth;
  std::vector<StageTime> times;
  std::vector<InputFile> inputs;
  int failed_trials = 0;
};

struct RunOptions {
  std::optional<double> start_s, end_s;  ///< Of every trial [s]; empty: as the study says.
  Progress progress;
  /// Forces of static optimization, which methods `paper` and `force` need; the torque method does
  /// not.
  bool share_forces = true;
  /// Where inverse kinematics is kept between runs; empty: nowhere.
  std::optional<std::filesystem::path> store;
};

/// What a study is computed from, as values.
struct StudyInputs {
  std::vector<TrialInput> trials;  ///< In the study's order.
  std::vector<TrueValue> truth;
  std::vector<InputFile> files;
};

/// Reads every file of a study; a trial that cannot be taken as one piece is replaced by its parts,
/// in the study too. Throws as `run_study`.
[[nodiscard]] StudyInputs read_inputs(Study& study);

/// All stages after reading, on inputs that may never have been files. As `run_study` otherwise.
[[nodiscard]] StudyResult analyse(const Study& study,
                                  StudyInputs inputs,
                                  const RunOptions& options = {});

/// All stages in order: EMG, motion, inverse dynamics, muscle paths, force sharing, identification,
/// cross-validation; trials in parallel, the same numbers for every number of threads. Throws
/// ReadError or InvalidInput for input that cannot be used (nothing is computed then: all files are
/// read first), Interrupted when stopped. A trial whose computation fails is marked and left out.
[[nodiscard]] StudyResult run_study(const Study& study, const RunOptions& options = {});

}  // namespace myoid::pipeline
