#include "myoid/run/study_fit.h"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "myoid/fit/methods/force.h"
#include "myoid/fit/methods/paper.h"
#include "myoid/fit/methods/prediction.h"
#include "myoid/fit/methods/torque.h"
#include "myoid/ground/core/parallel.h"
#include "myoid/ground/core/progress_part.h"
#include "myoid/recording/signals/quality_limits.h"

namespace myoid::run {

using fit::IdentificationResult;
using fit::Method;

const IdentificationResult* method_of(const StudyFit& fit, Method method) {
  const auto found = std::ranges::find(fit.methods, method, &IdentificationResult::method);
  return found == fit.methods.end() ? nullptr : &*found;
}

const IdentificationResult* best_method(const StudyFit& fit) {
  const IdentificationResult* torque = method_of(fit, Method::torque);
  return torque != nullptr ? torque : method_of(fit, Method::force);
}

const IdentificationResult* torque_of(const StudyFit& fit) { return method_of(fit, Method::torque); }

const fit::TrialFit* trial_of(const IdentificationResult& method, const std::string& trial) {
  const auto found = std::ranges::find(method.trials, trial, &fit::TrialFit::trial);
  return found == method.trials.end() ? nullptr : &*found;
}

bool wants_torque(const study::Study& study) {
  const std::vector<fit::Method>& methods = study.identify.methods;
  return std::ranges::find(methods, fit::Method::torque) != methods.end();
}

namespace {

// Shares of the stage's time at which the fit, the search for mistakes and the fit of the other choice end.
constexpr double kFitEnds = 0.6, kMistakesEnd = 0.9, kChoiceEnds = 0.98;

/// Returns the options of a fit that tells its progress as this part of the stage's.
fit::EstimatorOptions telling(fit::EstimatorOptions options, const Progress& progress, double from, double to) {
  options.progress = part_of(progress, from, to);
  return options;
}

/// Compares the solvers of method `paper`, whose result is the last; their minima join its basins.
void compare_solvers(
    std::optional<int> starts, const FitInput& input, std::uint64_t seed, const Progress& progress, StudyFit& found) {
  ContestOptions options{.seed = seed, .progress = progress};
  options.starts = starts.value_or(options.starts);
  found.contests = solver_contests(input.data, options);
  for (const SolverContest& contest : found.contests) {
    if (contest.runs.empty()) continue;
    found.methods.back().basins.push_back(contest.basins);
    found.methods.back().basins.back().fit = contest.fit + ", Levenberg-Marquardt";
  }
}

}  // namespace

bool shares_forces(const study::Study& study) {
  return std::ranges::any_of(study.trials,
                             [&](const study::TrialSpec& trial) { return study.fits(trial) && !trial.given.forces; });
}

StudyFit study_fit(const study::Study& study, const FitInput& input, std::uint64_t seed, const Progress& progress) {
  StudyFit found;
  if (wants_torque(study)) {
    progress.tell(0.0, "compares the clocks of EMG and torque");
    found.shifted = fit::shifted_emg(
        input.data, {recording::kLimits.clocks.earliest_offset_s, recording::kLimits.clocks.latest_offset_s});
  }
  const bool shared = shares_forces(study);
  for (const fit::Method method : study.identify.methods) {
    progress.check();
    if (method == fit::Method::paper) {
      progress.tell(0.0, "fits the forces by method paper");
      found.methods.push_back(fit::identify_paper(input.data, {.multistart = study.identify.starts.value_or(1),
                                                               .muscles = study.identify.muscles,
                                                               .shared_forces = shared}));
      if (study.identify.compare_solvers) compare_solvers(study.identify.starts, input, seed, progress, found);
    } else if (method == fit::Method::force) {
      found.methods.push_back(fit::identify_force(
          input.data, {.estimator = input.options, .shared_forces = shared, .detect_exact = !shared}));
    } else {
      // EMG that is given as activation may be that of a simulation, without noise.
      std::optional<IdentificationResult> exact;
      const fit::EstimatorOptions fits = telling(input.options, progress, 0.0, kFitEnds);
      if (study.emg.kind == study::EmgKind::activation) exact = fit::identify_exactly(input.data, input.options);
      found.methods.push_back(exact ? std::move(*exact) : fit::identify_torque(input.data, fits));
      found.mistaken =
          mistaken_emg(input.data, telling(input.options, progress, kFitEnds, kMistakesEnd), found.methods.back());
      found.other_choice =
          other_choice(input.data, telling(input.options, progress, kMistakesEnd, kChoiceEnds), found.methods.back());
      progress.tell(kChoiceEnds, "compares dynamometer and masses");
      found.scales = torque_scales(input.data, input.options, found.methods.back());
    }
  }
  return found;
}

std::vector<InformedForces> informed_forces(const FitInput& input, const std::vector<IdentificationResult>& methods) {
  std::vector<InformedForces> found;
  for (const IdentificationResult& method : methods) {
    if (method.method != fit::Method::torque) continue;
    const std::size_t before = found.size();
    const std::vector<fit::TrialData>& trials = input.data.trials;
    found.resize(before + trials.size());
    parallel_each(trials.size(), [&](std::size_t i) {
      const fit::Prediction p = fit::predict(input.data, trials[i], method.values, method.lag);
      found[before + i] = informed_forces(trials[i], p.activation, method.values.muscles);
    });
  }
  return found;
}

}  // namespace myoid::run
