#pragma once

#include <string>

namespace myoid::run {

/// The angles over which movements are proposed.
struct ProposedRange {
  double low_rad = 0.0, high_rad = 0.0;
  std::string says;  ///< Why the model's range is not used; empty where it is.
};

/// Returns the part of a coordinate's range in the model that people reach (body::people_range). A name of no such
/// joint, and a range that has nothing in common with people's, give the model's range.
[[nodiscard]] ProposedRange human_range(const std::string& coordinate, double lower_rad, double upper_rad);

}  // namespace myoid::run
