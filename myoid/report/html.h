#pragma once

#include <string>

#include "myoid/report/report.h"

namespace myoid::report {

/// The report as one HTML page that needs nothing else: style and drawings are inside, no scripts,
/// no network. Quality gates come first. Fit for the screen and for print.
[[nodiscard]] std::string html(const Report& report);

}  // namespace myoid::report
