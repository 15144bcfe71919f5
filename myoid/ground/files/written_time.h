#pragma once

#include <optional>
#include <string_view>

namespace myoid::inline ground {

/// Reads a time of the day, "10:02:03.250", "10:02:03:250", "10:02:03 PM" or "02:03.250" (minutes) [s]: the seconds
/// since midnight, or, behind a date of the form "2026-05-01T", since the begin of 1970. Other dates ("1.5.2026 ") and
/// a zone behind the time are passed over.
[[nodiscard]] std::optional<double> written_time_s(std::string_view cell);

}  // namespace myoid::inline ground
