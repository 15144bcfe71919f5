#pragma once

#include <string>

namespace myoid::recording {

/// Returns the unit of a channel in a series that a run writes (`ik.mot`, `id.sto`,
/// `MuscleAnalysis_Length.sto`, ...), by the name of the file without its ending: "deg" or "rad",
/// "m", "m/s", "m^2", "N", "N m", "1" for an activation. Empty: the name is none of these.
[[nodiscard]] std::string result_unit(const std::string& series, const std::string& channel, bool in_degrees);

}  // namespace myoid::recording
