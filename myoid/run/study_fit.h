#pragma once

#include <optional>
#include <vector>

#include "myoid/core/progress.h"
#include "myoid/intervals/result.h"
#include "myoid/methods/exchanged_electrodes.h"
#include "myoid/methods/force_loop.h"
#include "myoid/run/fit_input.h"

namespace myoid {

/// The parameters of a study and the forces that follow from them.
struct StudyFit {
  std::vector<identification::IdentificationResult> methods;
  /// Labels that fit better the other way round.
  std::optional<identification::ExchangedElectrodes> exchanged;
  /// Forces and activations with the identified muscles, informed by the EMG, of the trials of the
  /// data. Empty without method torque.
  std::vector<identification::InformedForces> informed;
  std::optional<identification::ForceLoop> force_loop;  ///< If the study asks for it.
};

/// The result of method torque; nullptr without.
[[nodiscard]] const identification::IdentificationResult* torque_of(const StudyFit& fit);

/// True if the study asks for method torque.
[[nodiscard]] bool wants_torque(const Study& study);

/// The parameters by every method that the study names.
[[nodiscard]] StudyFit study_fit(const Study& study,
                                 const FitInput& input,
                                 const Progress& progress);

/// Forces informed by the EMG, for `StudyFit::informed`.
[[nodiscard]] std::vector<identification::InformedForces> informed_forces(
    const FitInput& input, const std::vector<identification::IdentificationResult>& methods);

/// Forces and parameters in turn until they agree, for `StudyFit::force_loop`.
[[nodiscard]] identification::ForceLoop force_loop(const FitInput& input);

}  // namespace myoid
