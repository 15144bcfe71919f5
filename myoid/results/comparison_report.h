#pragma once

#include "myoid/page/report.h"
#include "myoid/results/compare_runs.h"

namespace myoid::results {

/// Returns the comparison as a report: the answer, both sessions of every number in one drawing, then a table for each
/// method. Numbers have plain names and units. Method `paper`, which is not compared, comes last.
[[nodiscard]] page::Report comparison_report(const RunComparison& comparison);

}  // namespace myoid::results
