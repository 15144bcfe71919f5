#pragma once

#include <filesystem>

namespace myoid {

/// Files that replace the files named in a set-up; an empty path leaves the set-up's own.
struct SetupFiles {
  std::filesystem::path model;
  /// The recorded motion: coordinates or states, for inverse kinematics and scaling the markers.
  std::filesystem::path motion;
  std::filesystem::path external_loads;
  std::filesystem::path out;  ///< Folder of all results.
};

}  // namespace myoid
