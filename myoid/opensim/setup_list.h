#pragma once

#include <filesystem>
#include <vector>

#include "myoid/opensim/opensim_setup.h"

namespace myoid::opensim {

/// A set-up file with the name by which tables and folders of results call it.
struct NamedSetup {
  std::filesystem::path file;
  /// "walk1/ik_setup": below the given folder, without ".xml". Of a given file its stem, behind the name of its folder
  /// if several have that stem.
  std::filesystem::path name;
};

/// Returns set-up files: those given, and of each given folder, with its folders, every .xml that holds a tool, by
/// name. Throws InvalidInput for a folder without a set-up and for two set-ups whose names are equal.
[[nodiscard]] std::vector<NamedSetup> list_setups(const std::vector<std::filesystem::path>& given);

/// Returns the place of a set-up in the order of a study: scaling and placing of sensors 0, inverse kinematics 1, all
/// tools that read a motion 2, and analyses that read forces of another analysis (<forces_file>) 3. No set-up reads a
/// result of a set-up of its own place.
[[nodiscard]] int place_in_study(const OpensimSetup& setup);

}  // namespace myoid::opensim
