#pragma once

#include "myoid/ground/core/provenance.h"
#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// Returns the report of a run: quality gates, parameters with intervals and verdicts (the source paper's tables I and
/// II among them), the source paper's figures 2, 6 and 8-10, the held-out torque and the assumptions.
[[nodiscard]] page::Report study_report(const run::StudyResult& result, const Provenance& provenance);

}  // namespace myoid::results
