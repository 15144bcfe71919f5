#pragma once

#include <string>

#include "myoid/report/report.h"

namespace myoid::report {

/// Returns the report as one HTML page for screen and print. Style and drawings are inside; the
/// page needs no scripts and no network. Quality gates come first.
[[nodiscard]] std::string html(const Report& report);

}  // namespace myoid::report
