#pragma once

#include "myoid/core/provenance.h"
#include "myoid/report/report.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Returns the report of a run: quality gates, parameters with intervals and verdicts (the source paper's tables I and
/// II among them), the source paper's figures 2, 6 and 8-10, the held-out torque and the assumptions.
[[nodiscard]] report::Report study_report(const StudyResult& result, const Provenance& provenance);

}  // namespace myoid
