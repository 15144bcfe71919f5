#pragma once

#include <string>

#include "myoid/report/report.h"

namespace myoid::report {

/// Returns the report as JSON with the structure and names of `Report`, indented by two blanks.
/// Figures carry id, title and caption only; their numbers are in figures/ID.csv.
[[nodiscard]] std::string report_json(const Report& report);

}  // namespace myoid::report
