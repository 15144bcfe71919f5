#pragma once

#include <filesystem>
#include <string>

#include "myoid/ground/core/time_series.h"

namespace myoid::inline ground {

/// Compares the columns in radians of a motion with the unit that its file states. Throws ReadError if the file says
/// radians and an angle exceeds two turns: the numbers are degrees. Returns a warning if the file says degrees and no
/// angle reaches 3.5 degrees although one moves by more than 0.2 degrees, or by 0.02 degrees and 30 % of the largest
/// angle: the numbers may be radians; empty otherwise. Of ten angles that move one may be larger.
[[nodiscard]] std::string check_angle_unit(const std::filesystem::path& path,
                                           bool says_degrees,
                                           const TimeSeries& motion);

}  // namespace myoid::inline ground
