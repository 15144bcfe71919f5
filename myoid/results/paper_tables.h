#pragma once

#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/page/report.h"
#include "myoid/run/solver_contest.h"
#include "myoid/run/study_fit.h"

namespace myoid::results {

/// Returns the source paper's tables I and II (shortening, lengthening) with its columns, start and estimate of each
/// muscle in two rows, and a table of the searches.
[[nodiscard]] std::vector<page::Table> paper_tables(const fit::IdentificationResult& method);

/// Returns the searches of the solvers that the study compares, with every digit: the content of solvers.csv.
[[nodiscard]] page::Table solver_table(const std::vector<run::SolverContest>& contests);

/// Returns the section of the report, which is folded. `shared`: force sharing made the forces.
[[nodiscard]] page::Section paper_section(const run::StudyFit& fit, bool shared);

}  // namespace myoid::results
