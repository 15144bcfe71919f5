#pragma once

#include <array>
#include <string>
#include <string_view>

#include "myoid/body/arm/arm4.h"

namespace myoid::body {

/// One head of a muscle across the elbow: its path is its lump's about the elbow, with its own name and constant part.
struct ArmHead : ArmMuscle {
  int lump = 0;  ///< Its muscle in the order of `planar_elbow`: BIC, BRA, BRD, TRI.
};

inline constexpr std::array<std::string_view, 7> kArm7Heads = {"BIClong", "BICshort", "BRA",   "BRD",
                                                               "TRIlong", "TRIlat",   "TRImed"};

/// Returns the seven heads: Holzbaur, Murray & Delp (2005) as OpenSim's models carry them, other numbers as
/// `muscle::literature_parameters`. Slack lengths are the published ones; the paths' constant parts are such that with
/// a rigid tendon every fiber is optimal at the angle of its lump (85, 75, 95 and 60 degrees of elbow flexion).
[[nodiscard]] std::array<ArmHead, 7> arm7_heads(const ArmOptions& options = {});

/// Returns `arm4_osim` with these seven muscles instead of the four.
[[nodiscard]] std::string arm7_osim(const Arm4Options& options = {});

}  // namespace myoid::body
