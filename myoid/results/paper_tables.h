#pragma once

#include <string>
#include <vector>

#include "myoid/intervals/result.h"
#include "myoid/methods/solver_contest.h"
#include "myoid/report/report.h"
#include "myoid/run/study_fit.h"

namespace myoid {

/// Says how a search of method `paper` ended and how plain steps fared: "BIC, shortening: minimum of the published
/// criterion after 9 steps; plain steps: diverged after 5".
[[nodiscard]] std::string published_sentence(const identification::PublishedSearch& search);

/// Returns the source paper's tables I and II (shortening, lengthening) with its columns, start and estimate of each
/// muscle in two rows, and a table of the searches.
[[nodiscard]] std::vector<report::Table> paper_tables(const identification::IdentificationResult& method);

/// Returns the searches of the solvers that the study compares, with every digit: the content of solvers.csv.
[[nodiscard]] report::Table solver_table(const std::vector<identification::NamedContest>& contests);

/// Returns the section of the report, which is folded. `shared`: force sharing made the forces.
[[nodiscard]] report::Section paper_section(const StudyFit& fit, bool shared);

}  // namespace myoid
