#pragma once

#include <string>

#include "myoid/report/report.h"
#include "myoid/report/workbench.h"

namespace myoid::report {

/// Returns the report as one HTML page for screen and print. Style and drawings are inside; the page needs no network.
/// The answer comes first: headline, light of the gates, forest plot. With a workbench, and if the program has a viewer
/// (has_viewer), the page holds it with its script; without script the page shows the static figures.
[[nodiscard]] std::string html(const Report& report, const Workbench* workbench = nullptr);

}  // namespace myoid::report
