#pragma once

#include <optional>
#include <string>

namespace myoid::body {

/// Angles that people's joints reach.
struct PeopleRange {
  double low_rad = 0.0, high_rad = 0.0;
};

/// Returns the published range of the joint that a coordinate's name means (American Academy of Orthopaedic Surgeons,
/// Joint Motion, 1965: elbow 0 to 150 deg, knee 0 to 135, ankle -50 to 20 with dorsiflexion positive, ...) and 10 deg
/// at either end, two standard deviations of healthy people (Boone and Azen, J Bone Joint Surg 61-A, 1979). Elbow and
/// knee may flex in the negative direction: they do where the model's range reaches farther there. Empty for a name of
/// no such joint.
[[nodiscard]] std::optional<PeopleRange> people_range(const std::string& coordinate,
                                                      double lower_rad,
                                                      double upper_rad);

}  // namespace myoid::body
