#pragma once

#include <filesystem>

#include "myoid/report/report.h"
#include "myoid/report/workbench.h"

namespace myoid::report {

/// Writes report.html (one file that works offline: style, drawings and the workbench, if there is
/// one, inside), figures/ID.svg and ID.csv, tables/ID.csv and report.json into the folder; each
/// whole or not at all. Calls `validate`.
void write_report(const Report& report, const std::filesystem::path& directory, const Workbench* workbench = nullptr);

}  // namespace myoid::report
