#pragma once

#include <string>

namespace myoid::run {

/// The angles over which movements are proposed.
struct ProposedRange {
  double low_rad = 0.0, high_rad = 0.0;
  std::string says;  ///< Why the model's range is not used; empty where it is.
};

/// Returns the part of a coordinate's range in the model that people reach: the published range of the joint that the
/// name means (American Academy of Orthopaedic Surgeons, Joint Motion, 1965: elbow 0 to 150 deg, knee 0 to 135, ankle
/// -50 to 20 with dorsiflexion positive, ...) and 10 deg at either end, two standard deviations of healthy people
/// (Boone and Azen, J Bone Joint Surg 61-A, 1979). Elbow and knee may flex in the negative direction: they do where the
/// model's range reaches farther there. A name of no such joint, and a range that has nothing in common with people's,
/// give the model's range.
[[nodiscard]] ProposedRange human_range(const std::string& coordinate, double lower_rad, double upper_rad);

}  // namespace myoid::run
