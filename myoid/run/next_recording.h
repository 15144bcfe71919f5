#pragma once

#include <optional>
#include <vector>

#include "myoid/ground/core/progress.h"
#include "myoid/ground/core/remark.h"
#include "myoid/run/design/design_study.h"
#include "myoid/run/study_fit.h"
#include "myoid/run/study_inputs.h"

namespace myoid::run {

/// Returns movements that would determine more than this recording; without a dynamometer the movements use the
/// laboratory's masses. Empty if the fit is no basis for a design, or no model can move; a run that plans nothing for
/// another reason keeps its numbers, and a remark says why.
[[nodiscard]] std::optional<DesignStudyResult> next_recording(const StudySource& source,
                                                              const StudyFit& fit,
                                                              const Progress& progress,
                                                              std::vector<Remark>& remarks);

}  // namespace myoid::run
