#pragma once

#include "myoid/page/report.h"
#include "myoid/run/design/design_study.h"

namespace myoid::run {

/// Returns the section on the next recording: the plan, movement by movement, with the interval
/// expected after each, and every target before and after the whole plan.
[[nodiscard]] page::Section next_recording_section(const DesignStudyResult& design);

}  // namespace myoid::run
