#pragma once

#include <filesystem>

#include "myoid/report/report.h"

namespace myoid::report {

/// Writes report.html (one file that works offline: style and drawings inside), figures/ID.svg and
/// ID.csv, tables/ID.csv and report.json into the folder; each whole or not at all. Calls
/// `validate`.
void write_report(const Report& report, const std::filesystem::path& directory);

}  // namespace myoid::report
