#pragma once

#include <filesystem>
#include <string>

#include "myoid/page/report.h"
#include "myoid/page/workbench.h"

namespace myoid::page {

/// Returns the report as JSON with the structure and names of `Report`, indented by two blanks.
/// Figures carry id, title and caption only; their numbers are in figures/ID.csv.
[[nodiscard]] std::string report_json(const Report& report);

/// Writes figures/ID.svg and figures/ID.csv.
void write_figure(const Figure& figure, const std::filesystem::path& directory);

/// Writes report.html (one file that works offline: style, drawings and the workbench, if there is
/// one, inside), figures/ID.svg and ID.csv, tables/ID.csv and report.json into the folder; each
/// whole or not at all. Calls `validate`.
void write_report(Report report, const std::filesystem::path& directory, const Workbench* workbench = nullptr);

}  // namespace myoid::page
