#pragma once

#include <string>

#include "myoid/page/report.h"
#include "myoid/page/workbench.h"

namespace myoid::page {

/// Returns the report as one HTML page for screen and print. Style and drawings are inside; the page needs no network.
/// The answer comes first: headline, light of the gates, forest plot. With a workbench, and if the program has a viewer
/// (has_viewer), the page holds it with its script; without script the page shows the static figures.
[[nodiscard]] std::string html(const Report& report, const Workbench* workbench = nullptr);

}  // namespace myoid::page
