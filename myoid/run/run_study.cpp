#include "myoid/run/run_study.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_for.h>

#include "myoid/checks/dynamometer_sign.h"
#include "myoid/core/error.h"
#include "myoid/dynamics/ground_support.h"
#include "myoid/intake/trial_quality.h"
#include "myoid/methods/basins.h"
#include "myoid/methods/force.h"
#include "myoid/run/estimator_input.h"
#include "myoid/run/quality_gates.h"
#include "myoid/run/resting_joints.h"
#include "myoid/run/stage_store.h"
#include "myoid/run/study_emg.h"
#include "myoid/run/study_phases.h"
#include "myoid/run/trial_stages.h"
#include "myoid/study/study_model.h"

namespace myoid {
namespace {

/// Measures the stages and tells how far the run is.
class Stages {
 public:
  Stages(const RunOptions& options, std::vector<StageTime>& times)
      : options_(options), times_(times) {}

  template <typename Work>
  void run(const std::string& name, double from, Work work) {
    options_.progress.check();
    options_.progress.tell(from, name);
    const auto begin = std::chrono::steady_clock::now();
    work();
    times_.push_back(
        {name, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count()});
  }

 private:
  const RunOptions& options_;
  std::vector<StageTime>& times_;
};

/// What would tell more than this recording did; without a dynamometer's movements, with the masses
/// that the laboratory has. Empty if the fit is none to go on from.
std::optional<DesignStudyResult> next_recording(const StudyResult& result, const RunOptions& run) {
  const Study& study = result.study;
  DesignStudyOptions options;
  options.choice.movements = study.identify.next_movements;
  options.catalogue.dynamometer = false;
  std::vector<double> masses{0.0};
  for (const TrialSpec& trial : study.trials) {
    if (std::find(masses.begin(), masses.end(), trial.held_mass_kg) == masses.end())
      masses.push_back(trial.held_mass_kg);
  }
  if (masses.size() > 1) options.catalogue.held_masses_kg = masses;
  options.progress.stop = run.progress.stop;
  for (const identification::IdentificationResult& method : result.methods) {
    if (method.method != "torque") continue;
    if (method.termination != math::Termination::converged || !method.covariance.allFinite())
      return std::nullopt;
    options.earlier = earlier_run(method);
  }
  return design_study(study, options);
}

/// The result of a study before its first stage.
StudyResult begun(const Study& study, const std::vector<TrialInput>& inputs) {
  StudyResult result;
  result.study = study;
  result.model_text = model_text(study);
  result.model = load_model(study);
  result.trials.resize(inputs.size());
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    result.trials[i].spec = study.trials[i];
    result.trials[i].notes = inputs[i].notes;
    result.trials[i].warnings = inputs[i].warnings;
    result.trials[i].emg_clock = inputs[i].emg_clock;
  }
  return result;
}

void find_faults(const Study& study, const std::vector<TrialInput>& inputs, StudyResult& result) {
  oneapi::tbb::parallel_for(std::size_t{0}, inputs.size(), [&](std::size_t i) {
    TrialResult& trial = result.trials[i];
    trial.faults = trial_faults(study, inputs[i], trial.activation);
  });
}

/// Throws InvalidInput where the sign of every dynamometer is reversed, warns of that of some.
void check_dynamometers(const Study& study,
                        const std::vector<TrialInput>& inputs,
                        StudyResult& result) {
  std::vector<EffortTrial> trials;
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const auto& torque = inputs[i].external_torque;
    if (!result.trials[i].activation.empty())
      trials.push_back(
          {&study.trials[i], torque ? &*torque : nullptr, result.trials[i].activation});
  }
  for (const Finding& f : grouped(dynamometer_signs(study, result.model, trials))) {
    if (f.level == Finding::Level::error)
      throw InvalidInput(fmt::format("{} (trial '{}')", f.message, f.where));
    for (TrialResult& trial : result.trials) {
      if (trial.spec.name == f.where) trial.warnings.push_back(f.message);
    }
  }
}

/// Marks the times in which a leg's torque lacks the ground reaction.
void find_uncarried(const Study& study, TrialResult& trial) {
  if (!trial.has_motion() || trial.spec.external_torque) return;
  const std::vector<std::string> names = study_coordinates(study.model);
  const bool bears = std::any_of(names.begin(), names.end(), [&](const std::string& name) {
    return dynamics::bears_the_body(trial.model, name, trial.motion.q.values().row(0).transpose(),
                                    study.subject.mass_kg.value_or(0.0));
  });
  if (!bears) return;
  trial.uncarried = dynamics::uncarried_time(trial.model, trial.generalized_forces);
  if (trial.uncarried) trial.warnings.push_back(trial.uncarried->sentence());
}

/// Motion and forces of every trial. Throws if none of them can be computed.
void compute_trials(const Study& study,
                    const std::vector<TrialInput>& inputs,
                    const RunOptions& options,
                    StudyResult& result) {
  std::optional<StageStore> store;
  if (options.store) store.emplace(*options.store);
  std::atomic<int> done = 0;
  const auto compute = [&](std::size_t i) {
    options.progress.check();
    TrialResult& trial = result.trials[i];
    try {
      compute_trial(study, inputs[i], result.model_text, options.share_forces, result.resting,
                    store ? &*store : nullptr, trial);
      find_uncarried(study, trial);
    } catch (const InvalidInput& error) {
      trial.failure = error.what();
    }
    options.progress.tell(0.3 + 0.4 * ++done / static_cast<double>(study.trials.size()),
                          trial.spec.name);
  };
  // Relaxed joints first: what they do by themselves no muscle shares in the other trials.
  for (const bool relaxed : {true, false}) {
    oneapi::tbb::parallel_for(std::size_t{0}, study.trials.size(), [&](std::size_t i) {
      if ((study.trials[i].use == Use::passive) == relaxed) compute(i);
    });
    if (relaxed) result.resting = resting_joints(result);
  }
  for (const TrialResult& trial : result.trials) {
    if (!trial.failure.empty()) ++result.failed_trials;
  }
  if (store) store->remove_unused();
  if (result.failed_trials == static_cast<int>(result.trials.size()))
    throw InvalidInput(result.trials.front().failure);
}

/// What a fit of the study begins with.
struct FitInput {
  identification::StudyData data;  ///< Without the phases that the study excludes.
  identification::TorqueOptions options;
  std::vector<TrialPhases> phases;
};

/// Of the trials of `result` with the uses of `study` and these activations.
FitInput fit_input(const StudyResult& result,
                   const Study& study,
                   const StudyActivations& emg,
                   const Progress& progress) {
  FitInput input{.data = estimator_data(result, study, emg),
                 .options = torque_options(study, emg.normalisation, progress),
                 .phases = {}};
  input.options.multistart = study.identify.starts;
  if (study.phases.search && !input.data.trials.empty()) {
    input.phases = study_phases(result, study, emg, input.data, input.options);
    exclude_phases(study.phases.exclude, input.phases, input.data);
  }
  return input;
}

/// The parameters by every method that the study names, without the phases that it excludes.
void identify_parameters(const Study& study, const Progress& progress, StudyResult& result) {
  FitInput input = fit_input(result, study, activations_of(result), progress);
  result.data = std::move(input.data);
  result.phases = std::move(input.phases);
  const bool torque = std::find(study.identify.methods.begin(), study.identify.methods.end(),
                                "torque") != study.identify.methods.end();
  if (torque) {
    result.exchanged = identification::exchanged_electrodes(
        result.data,
        study.emg.delay_s.value_or(identification::TorqueOptions{}.delay_prior_mean_s));
  }
  for (const std::string& method : study.identify.methods) {
    if (method == "paper") {
      result.methods.push_back(
          identification::identify_paper(result.data, {.multistart = study.identify.starts,
                                                       .muscles = study.identify.muscles,
                                                       .shared_forces = true}));
    } else if (method == "force") {
      identification::EstimatorOptions estimator = torque_options(result, progress);
      estimator.intervals.profile = false;
      estimator.multistart = study.identify.starts;
      result.methods.push_back(identification::identify_force(
          result.data, {.estimator = std::move(estimator), .shared_forces = true}));
    } else {
      result.methods.push_back(identification::identify_torque(result.data, input.options));
      identification::look_around(result.data, input.options, result.methods.back());
    }
  }
}

void inform_forces(StudyResult& result) {
  for (const identification::IdentificationResult& method : result.methods) {
    if (method.method != "torque") continue;
    const std::size_t before = result.informed.size();
    const std::vector<identification::TrialData>& trials = result.data.trials;
    result.informed.resize(before + trials.size());
    oneapi::tbb::parallel_for(std::size_t{0}, trials.size(), [&](std::size_t i) {
      const identification::Prediction p =
          identification::predict(result.data, trials[i], method.values, method.lag);
      result.informed[before + i] =
          identification::informed_forces(trials[i], p.activation, method.values.muscles);
    });
  }
}

identification::FoldKind fold_kind(const std::string& left_out) {
  return left_out == "condition" ? identification::FoldKind::condition
         : left_out == "block"   ? identification::FoldKind::block
                                 : identification::FoldKind::trial;
}

/// The study's data as if the trials that a split leaves out had been held back for validation:
/// from the EMG on nothing rests on them.
FitInput without_left_out(const StudyResult& result,
                          const std::vector<TrialInput>& inputs,
                          const identification::StudyData& split,
                          const Progress& progress) {
  Study study = result.study;
  for (TrialSpec& trial : study.trials) {
    for (const identification::TrialData& data : split.trials) {
      if (data.name == trial.name && !data.calibration) trial.use = Use::validation;
    }
  }
  FitInput input =
      fit_input(result, study, activations_without_validation(study, inputs, result), progress);
  std::erase_if(input.data.trials, [&](const identification::TrialData& trial) {
    return std::none_of(split.trials.begin(), split.trials.end(),
                        [&](const auto& of_split) { return of_split.name == trial.name; });
  });
  return input;
}

/// Leaves trials, conditions or blocks out, with a fit that is the reported one on the others.
void leave_out(const std::vector<TrialInput>& inputs,
               const Progress& progress,
               StudyResult& result) {
  const identification::CrossValidationOptions how{.kind = fold_kind(result.study.identify.folds)};
  identification::TorqueOptions options = torque_options(result, progress);
  options.multistart = result.study.identify.starts;
  const auto fit = [&](identification::StudyData& data) {
    if (how.kind == identification::FoldKind::block)
      return identification::identify_torque(data, identification::of_a_fold(options));
    FitInput input = without_left_out(result, inputs, data, progress);
    data = std::move(input.data);
    return identification::identify_torque(data, identification::of_a_fold(input.options));
  };
  result.folds = identification::cross_validate(result.data, fit, options, how);
  std::string why_not;
  (void)identification::splits(result.data, how, &why_not);
  const std::string bad = identification::generalises_badly(result.folds);
  for (identification::IdentificationResult& method : result.methods) {
    if (method.method != "torque") continue;
    if (!why_not.empty())
      method.warnings.push_back("nothing was left out of the fit to be predicted: " + why_not);
    if (!bad.empty()) method.warnings.push_back(bad);
  }
}

}  // namespace

StudyResult run_study(const Study& whole, const RunOptions& options) {
  Study study = whole;
  restrict_trials(study, options.start_s, options.end_s);
  options.progress.tell(0.0, "reading");
  const auto begin = std::chrono::steady_clock::now();
  StudyInputs inputs = read_inputs(study);
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
  StudyResult result = analyse(study, std::move(inputs), options);
  result.start_s = options.start_s;
  result.end_s = options.end_s;
  result.times.insert(result.times.begin(), {"reading", elapsed.count()});
  return result;
}

StudyResult analyse(const Study& study, StudyInputs given, const RunOptions& options) {
  if (given.trials.size() != study.trials.size())
    throw InvalidInput(
        fmt::format("{} inputs are given for {} trials", given.trials.size(), study.trials.size()));
  const std::vector<TrialInput> inputs = std::move(given.trials);
  StudyResult result = begun(study, inputs);
  result.truth = std::move(given.truth);
  result.inputs = std::move(given.files);
  Stages stages(options, result.times);
  stages.run("EMG", 0.15, [&] { process_emg_of_trials(study, inputs, result); });
  check_dynamometers(study, inputs, result);
  stages.run("quality", 0.25, [&] { find_faults(study, inputs, result); });
  stages.run("motion and forces", 0.3, [&] { compute_trials(study, inputs, options, result); });
  stages.run("identification", 0.7, [&] { identify_parameters(study, options.progress, result); });
  if (options.inform_forces) inform_forces(result);
  if (study.identify.force_loop) {
    stages.run("forces and parameters", 0.8, [&] {
      identification::EstimatorOptions estimator = torque_options(result, options.progress);
      estimator.intervals = {};
      result.force_loop = identification::iterate_forces(
          result.data,
          {.force = {.estimator = std::move(estimator), .shared_forces = true}, .delay_s = 0.06});
    });
  }
  const bool torque = std::find(study.identify.methods.begin(), study.identify.methods.end(),
                                "torque") != study.identify.methods.end();
  if (study.identify.cross_validate && torque) {
    stages.run("cross-validation", 0.85, [&] { leave_out(inputs, options.progress, result); });
  }
  if (study.identify.next_movements > 0 && torque) {
    stages.run("next recording", 0.95, [&] { result.next = next_recording(result, options); });
  }
  demote_by_gates(result);
  options.progress.tell(1.0, "done");
  return result;
}

}  // namespace myoid
