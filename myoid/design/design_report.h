#pragma once

#include "myoid/design/design_study.h"
#include "myoid/report/report.h"

namespace myoid {

/// Returns the section on the next recording: the plan, movement by movement, with the interval
/// expected after each, and every target before and after the whole plan.
[[nodiscard]] report::Section next_recording_section(const DesignStudyResult& design);

}  // namespace myoid
