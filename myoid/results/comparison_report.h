#pragma once

#include "myoid/report/report.h"
#include "myoid/results/compare_runs.h"

namespace myoid {

/// Returns the comparison as a report: the answer, both sessions of every number in one drawing, then a table for each
/// method. Numbers have plain names and units. Method `paper`, which is not compared, comes last.
[[nodiscard]] report::Report comparison_report(const RunComparison& comparison);

}  // namespace myoid
