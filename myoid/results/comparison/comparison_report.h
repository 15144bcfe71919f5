#pragma once

#include "myoid/page/report.h"
#include "myoid/results/comparison/compare_runs.h"

namespace myoid::results {

/// Returns the numbers of both sessions by one method. Without `all`, numbers that cannot be compared are left out.
[[nodiscard]] page::Table compared_table(const RunComparison& comparison, fit::Method of, bool all);

/// Returns the comparison as a report: the answer, both sessions of every number in one drawing, then a table for each
/// method. Numbers have plain names and units. Method `paper`, which is not compared, comes last.
[[nodiscard]] page::Report comparison_report(const RunComparison& comparison);

}  // namespace myoid::results
