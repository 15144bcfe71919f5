#pragma once

#include <optional>
#include <vector>

#include "myoid/core/remark.h"
#include "myoid/report/report.h"
#include "myoid/run/study_result.h"
#include "myoid/run/study_validation.h"

namespace myoid {

/// Returns the gates that tell whether the numbers of this run can be believed: input, inverse
/// kinematics, force sharing, EMG, fit and prediction, each with the result, the expectation and
/// the reason. The same list heads the report, goes to the terminal, and decides exit code 4.
[[nodiscard]] std::vector<report::Gate> quality_gates(const StudyResult& result);

/// The faults of all recordings as a table with their times and remedies, warnings first; the
/// report begins with it.
[[nodiscard]] report::Section recordings_section(const StudyResult& result);

/// Returns all faults of the recordings; faults of the whole study come last.
[[nodiscard]] std::vector<Remark> all_faults(const StudyResult& result);

/// True if a gate failed on which the motion rests (inverse kinematics, markers, angles): no
/// parameter can then be better than the motion it was computed from.
[[nodiscard]] bool motion_is_unreliable(const Study& study, const std::vector<TrialResult>& trials);

/// The methods with the warnings of the validation. Where the motion is unreliable, or electrodes
/// are exchanged, every `identified` parameter becomes `weak`, with that reason.
[[nodiscard]] std::vector<identification::IdentificationResult> judged(
    std::vector<identification::IdentificationResult> methods,
    const StudyValidation& validation,
    const Study& study,
    const std::vector<TrialResult>& trials,
    const std::optional<identification::ExchangedElectrodes>& exchanged);

}  // namespace myoid
