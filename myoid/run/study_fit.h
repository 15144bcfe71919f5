#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/methods/emg_clock.h"
#include "myoid/ground/core/progress.h"
#include "myoid/run/fit_input.h"
#include "myoid/run/informed_forces.h"
#include "myoid/run/mistaken_emg.h"
#include "myoid/run/other_choice.h"
#include "myoid/run/solver_contest.h"
#include "myoid/run/torque_scales.h"

namespace myoid::run {

/// The parameters of a study and the forces that follow from the parameters.
struct StudyFit {
  std::vector<fit::IdentificationResult> methods;
  std::optional<MistakenEmg> mistaken;      ///< Exchanged electrodes, or another gain or clock in a trial.
  std::optional<fit::ShiftedEmg> shifted;   ///< EMG of all trials on another clock than the torque.
  std::optional<TorqueScales> scales;       ///< Of trials with a dynamometer and without.
  std::optional<OtherChoice> other_choice;  ///< Of muscles without EMG.
  std::vector<SolverContest> contests;      ///< Solvers of method `paper`, if the study compares them.
  /// Forces and activations with the identified muscles, informed by the EMG, of the trials of the
  /// data. Empty without method torque.
  std::vector<InformedForces> informed;
};

/// Returns the result of the method of this name; nullptr if there is none.
[[nodiscard]] const fit::IdentificationResult* method_of(const StudyFit& fit, fit::Method method);

/// Returns the method by which a reader judges the muscles: torque, else force; null: only method `paper` was asked
/// for.
[[nodiscard]] const fit::IdentificationResult* best_method(const StudyFit& fit);

/// Returns the result of method torque; nullptr if there is none.
[[nodiscard]] const fit::IdentificationResult* torque_of(const StudyFit& fit);

/// Returns the first fit of a trial by a method; nullptr if there is none.
[[nodiscard]] const fit::TrialFit* trial_of(const fit::IdentificationResult& method, const std::string& trial);

/// Returns true if the study asks for method torque.
[[nodiscard]] bool wants_torque(const study::Study& study);

/// Returns true if force sharing made the forces of a fitted trial.
[[nodiscard]] bool shares_forces(const study::Study& study);

/// Computes the parameters by every method that the study names. `seed` is that of the solvers' comparison.
[[nodiscard]] StudyFit study_fit(const study::Study& study,
                                 const FitInput& input,
                                 std::uint64_t seed,
                                 const Progress& progress);

/// Returns the forces informed by the EMG, for `StudyFit::informed`.
[[nodiscard]] std::vector<InformedForces> informed_forces(const FitInput& input,
                                                          const std::vector<fit::IdentificationResult>& methods);

}  // namespace myoid::run
