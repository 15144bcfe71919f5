#pragma once

#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::run {

/// Returns the gate of the warnings of `check`: faults of channels, and remarks on files that may make numbers wrong.
[[nodiscard]] page::Gate recordings_gate(const StudyResult& result);

/// Returns all faults of the recordings as a table with times and remedies, warnings first; the
/// report begins with this section.
[[nodiscard]] page::Section recordings_section(const StudyResult& result);

/// Returns the mistake with the EMG that is named; nullptr: none. A unit in doubt explains another gain of its own
/// trial, and a poor fit to all trials: these are no finding beside it.
[[nodiscard]] const MistakenEmg* named_mistake(const StudyResult& result);

/// Gives the warnings that follow from the named gain of a trial the remedy to mend it: efforts above the maximal
/// contractions, and torques' units where the gain is that of a maximal contraction.
void yield_to_mistake(StudyResult& result);

/// Returns the warnings, with their trials, that the unit of a joint's angle or torque is another than its header says.
[[nodiscard]] std::vector<Remark> doubtful_units(const StudyResult& result);

/// Returns the warnings of the trials beside the faults of their channels, each once with the trials that it is about.
[[nodiscard]] std::vector<Remark> trial_warnings(const StudyResult& result);

/// Returns all faults of the recordings; faults of the whole study come last.
[[nodiscard]] std::vector<Remark> all_faults(const StudyResult& result);

}  // namespace myoid::run
