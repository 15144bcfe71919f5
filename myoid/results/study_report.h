#pragma once

#include "myoid/core/provenance.h"
#include "myoid/report/report.h"
#include "myoid/run/study_result.h"

namespace myoid {

/// Everything a person needs of a run: quality gates, the parameters with intervals and verdicts
/// (the source paper's tables I and II among them), its figures 2, 6 and 8-10, the held-out torque,
/// what was assumed.
[[nodiscard]] report::Report study_report(const StudyResult& result, const Provenance& provenance);

}  // namespace myoid
