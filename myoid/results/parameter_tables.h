#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// An estimate and its owners: tied numbers are one unknown and one line.
struct EstimateLine {
  const fit::ParameterEstimate* estimate = nullptr;
  std::string owners;  ///< "BIC", or "BIC, BRA, BRD, TRI"; "all muscles" if all share it.
};

/// Returns the estimates in reading order: first the muscles' and the person's, then the nuisances
/// (`is_nuisance`), without the greatest voluntary torques, which have lines of their own (voluntary_report.h). Equal
/// tied numbers have one line. `muscle_count` counts the study's muscles.
[[nodiscard]] std::vector<EstimateLine> estimate_lines(const fit::IdentificationResult& method,
                                                       std::size_t muscle_count);

/// Returns the owners for people: "Biceps" of one muscle BIC, "Person" of the subject, else the owners.
[[nodiscard]] std::string plain_owner(const EstimateLine& line);

/// Returns true if the 95 % interval is a thousand times as wide as the number, or as the usual spread of a number that
/// is 0 by nature. The fit does not bound such a number, and the interval is printed as "not determined".
[[nodiscard]] bool is_undetermined(const fit::ParameterEstimate& e);

/// Returns the number's true value in a virtual recording; empty: unknown.
[[nodiscard]] std::optional<double> truth_of(const run::StudyResult& result, const fit::ParameterEstimate& e);

/// Returns the tables of method torque or force: first the muscles' and the person's parameters
/// with prior, estimate, 95 % interval, truth (of a virtual recording), verdict and
/// reason; then, if there are any, gains and exponents of the channels and the joint's own torque.
[[nodiscard]] std::vector<page::Table> estimate_tables(const run::StudyResult& result,
                                                       const fit::IdentificationResult& method);

/// Returns a table of the minima at which searches from several starts ended; none without such searches.
[[nodiscard]] std::vector<page::Table> basin_tables(const fit::IdentificationResult& method);

/// Returns the rows of the forest plot: the numbers of `estimate_lines` in plain names and units, with the truth of a
/// virtual recording. A number that the recording leaves open has no interval.
[[nodiscard]] std::vector<page::ForestRow> forest_rows(const run::StudyResult& result,
                                                       const fit::IdentificationResult& method);

}  // namespace myoid::results
