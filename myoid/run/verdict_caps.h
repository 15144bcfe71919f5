#pragma once

#include <vector>

#include "myoid/fit/intervals/verdicts.h"
#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::run {

/// Returns the caps that follow from what was found about a run: gates that failed (those of the motion first; a gate
/// that concerns one method caps that method), mistaken EMG, EMG on another clock than the torque, contacts of
/// another foot in a fitted trial that the study does not exclude, and faults of EMG channels. A channel's fault in the
/// trial of its activation 1 caps the strengths that rest on it, in a fitted trial all numbers of its muscles.
[[nodiscard]] std::vector<fit::VerdictCap> verdict_caps(const StudyResult& result,
                                                        const std::vector<page::Gate>& gates);

}  // namespace myoid::run
