#pragma once

#include <chrono>
#include <string>

namespace myoid::inline ground {

/// Returns a day as "2026-03-01"; empty if the calendar has no such day.
[[nodiscard]] std::string day_text(const std::chrono::year_month_day& day);

}  // namespace myoid::inline ground
