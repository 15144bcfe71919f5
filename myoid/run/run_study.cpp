#include "myoid/run/run_study.h"

#include <algorithm>
#include <chrono>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "myoid/fit/methods/torque.h"
#include "myoid/ground/core/error.h"
#include "myoid/run/fit_input.h"
#include "myoid/run/given_trials.h"
#include "myoid/run/next_recording.h"
#include "myoid/run/quality_gates.h"
#include "myoid/run/recording_faults.h"
#include "myoid/run/stage_store.h"
#include "myoid/run/study_fit.h"
#include "myoid/run/study_forces.h"
#include "myoid/run/study_validation.h"
#include "myoid/run/trial_motion.h"
#include "myoid/run/verdict_caps.h"
#include "myoid/study/checks/recording_findings.h"

namespace myoid::run {
namespace {

using fit::IdentificationResult;

/// Measures the time of the stages and reports the progress of the run.
class Stages {
 public:
  explicit Stages(const RunOptions& options) : progress_(options.progress), ended_(options.stage_ended) {}

  /// Runs a stage, which takes the run from share `from` to share `to`. `does` says for people what it does.
  template <typename Work>
  auto run(const std::string& name, std::string_view does, double from, double to, Work work) {
    progress_.check();
    progress_.tell(from, does);
    Progress of_stage{.report = nullptr, .stop = progress_.stop};
    if (progress_.report)
      of_stage.report = [this, from, to](double share, std::string_view what) {
        progress_.tell(from + (to - from) * share, what);
      };
    const auto begin = std::chrono::steady_clock::now();
    auto found = work(of_stage);
    times_.push_back({name, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()});
    if (ended_) ended_(does, times_.back().seconds);
    return found;
  }
  [[nodiscard]] std::vector<StageTime> times() && { return std::move(times_); }

 private:
  const Progress& progress_;
  const std::function<void(std::string_view, double)>& ended_;
  std::vector<StageTime> times_;
};

/// Returns the findings. Throws InvalidInput if the sign of every dynamometer is reversed, or a
/// trial's EMG is in another unit than the maximal contraction.
study::RecordingFindings findings_of(const StudyInputs& inputs, const study::StudyActivation& activation) {
  study::RecordingFindings found =
      study::recording_findings(inputs.source.study, *inputs.source.model, inputs.trials, activation);
  for (const Remark& f : found.levels) {
    if (f.severity == Severity::error) throw InvalidInput(sentence(f));
  }
  for (const Remark& f : found.dynamometers) {
    if (f.severity == Severity::error) throw InvalidInput(fmt::format("{} (trial '{}')", sentence(f), f.where));
  }
  return found;
}

std::vector<TrialMotion> motion_of(const StudyInputs& inputs, const RunOptions& options, const Progress& progress) {
  std::optional<StageStore> store;
  if (options.store) store.emplace(*options.store);
  std::vector<TrialMotion> motion = study_motion(inputs, store ? &*store : nullptr, progress);
  if (store) store->remove_unused();
  return motion;
}

/// Throws InvalidInput if no trial could be computed.
void require_one(const std::vector<TrialResult>& trials) {
  if (!trials.empty() && failed_trials(trials) == static_cast<int>(trials.size()))
    throw InvalidInput(trials.front().failure());
}

/// Joins the findings of all stages about each trial.
std::vector<TrialResult> joined(const study::Study& study,
                                std::vector<study::TrialInput> inputs,
                                std::vector<study::TrialActivation> emg,
                                std::vector<TrialMotion> motion,
                                std::vector<TrialForces> forces,
                                const study::RecordingFindings& findings) {
  std::vector<TrialResult> trials(inputs.size());
  for (std::size_t i = 0; i < trials.size(); ++i) {
    TrialResult& trial = trials[i];
    trial.spec = study.trials[i];
    trial.input = std::move(inputs[i]);
    trial.emg = std::move(emg[i]);
    trial.motion = std::move(motion[i]);
    trial.forces = std::move(forces[i]);
    trial.faults = findings.of_trials[i];
    std::vector<Remark>& remarks = trial.remarks;
    remarks = trial.input.remarks;
    std::ranges::copy_if(findings.dynamometers, std::back_inserter(remarks),
                         [&](const Remark& remark) { return remark.where == trial.spec.name; });
    if (trial.emg.stages) std::ranges::copy(trial.emg.stages->findings, std::back_inserter(remarks));
    remarks.insert(remarks.end(), trial.motion.remarks.begin(), trial.motion.remarks.end());
    remarks.insert(remarks.end(), trial.forces.remarks.begin(), trial.forces.remarks.end());
  }
  require_one(trials);
  return trials;
}

StudyInputs read_stage(const study::Study& whole, const RunOptions& options, Stages& stages) {
  study::Study study = whole;
  study::restrict_trials(study, options.start_s, options.end_s);
  StudyInputs inputs =
      stages.run("reading", "reads the recordings", 0.0, 0.15, [&](const Progress&) { return read_inputs(study); });
  if (options.files_read) options.files_read(inputs.source.files);
  return inputs;
}

/// Runs the stages from the activation to the data.
StudyResult up_to_data(StudyInputs inputs, const RunOptions& options, Stages& stages) {
  const study::Study& study = inputs.source.study;
  study::StudyActivation activation =
      stages.run("activation", "makes activations of the EMG", 0.15, 0.25,
                 [&](const Progress&) { return study::study_activation(study, study::emg_of(inputs.trials)); });
  study::RecordingFindings recordings = stages.run("recordings", "checks the recordings", 0.25, 0.3,
                                                   [&](const Progress&) { return findings_of(inputs, activation); });
  std::vector<TrialMotion> motion =
      stages.run("motion", "finds angles and muscle paths", 0.3, 0.5,
                 [&](const Progress& progress) { return motion_of(inputs, options, progress); });
  StudyForces forces = stages.run("forces", "finds torques and shares forces", 0.5, 0.7, [&](const Progress& progress) {
    return study_forces(inputs, activation, motion, options.share_forces, progress);
  });
  StudyResult result;
  result.start_s = options.start_s;
  result.end_s = options.end_s;
  result.trials = joined(study, std::move(inputs.trials), std::move(activation.trials), std::move(motion),
                         std::move(forces.trials), recordings);
  result.source = std::move(inputs.source);
  result.emg = std::move(activation.scale);
  result.level_faults = std::move(recordings.levels);
  result.resting = std::move(forces.resting);
  result.fit_input = stages.run("data", "gathers the data of the fit", 0.7, 0.72,
                                [&](const Progress& progress) { return fit_input(fit_source(result), progress); });
  check_given(result.source.study, result.fit_input.data, result.trials);
  return result;
}

/// Runs the stages from the fit on.
void fit_and_validate(StudyResult& result, const RunOptions& options, Stages& stages) {
  const study::Study& study = result.source.study;
  FitInput& input = result.fit_input;
  input.options = fit::remembering_drives(std::move(input.options));
  StudyFit fit = stages.run("fit", "fits the muscles", 0.72, 0.85,
                            [&](const Progress& progress) { return study_fit(study, input, options.seed, progress); });
  if (options.inform_forces) fit.informed = informed_forces(input, fit.methods);
  StudyValidation validation;
  const IdentificationResult* best = best_method(fit);
  if (study.identify.cross_validate && best != nullptr && (best == torque_of(fit) || !shares_forces(study)))
    validation = stages.run(
        "validation", "predicts parts left out of the fit", 0.85, 0.95,
        [&](const Progress& progress) { return study_validation(fit_source(result), input, *best, progress); });
  result.fit = std::move(fit);
  const auto warn = [&](std::vector<Remark> remarks) {
    for (IdentificationResult& method : result.fit.methods)
      if (&method == best_method(result.fit)) std::ranges::move(remarks, std::back_inserter(method.warnings));
  };
  result.folds = std::move(validation.folds);
  warn(std::move(validation.remarks));
  yield_to_mistake(result);
  // Movements that are planned on numbers that failed may tell nothing.
  const std::vector<page::Gate> gates = quality_gates(result);
  const bool failed = std::ranges::find(gates, page::GateStatus::fail, &page::Gate::status) != gates.end();
  if (study.identify.next_movements > 0 && wants_torque(study) && !failed) {
    std::vector<Remark> remarks;
    result.next = stages.run(
        "next recording", "looks for the next recording", 0.95, 1.0,
        [&](const Progress& progress) { return next_recording(result.source, result.fit, progress, remarks); });
    warn(std::move(remarks));
  }
  input.options.drives.reset();
  const std::vector<fit::VerdictCap> caps = verdict_caps(result, quality_gates(result));
  for (IdentificationResult& method : result.fit.methods) fit::apply(caps, method);
}

/// Runs all stages behind the reading.
StudyResult finished(StudyInputs inputs, const RunOptions& options, Stages& stages) {
  StudyResult result = up_to_data(std::move(inputs), options, stages);
  fit_and_validate(result, options, stages);
  options.progress.tell(1.0, "done");
  result.times = std::move(stages).times();
  return result;
}

}  // namespace

StudyResult study_data(const study::Study& study, const RunOptions& options) {
  Stages stages(options);
  StudyResult result = up_to_data(read_stage(study, options, stages), options, stages);
  result.times = std::move(stages).times();
  return result;
}

StudyResult run_study(const study::Study& study, const RunOptions& options) {
  Stages stages(options);
  return finished(read_stage(study, options, stages), options, stages);
}

StudyResult analyse(StudyInputs inputs, const RunOptions& options) {
  Stages stages(options);
  return finished(std::move(inputs), options, stages);
}

}  // namespace myoid::run
