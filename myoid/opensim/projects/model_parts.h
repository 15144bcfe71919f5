#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "myoid/opensim/projects/project.h"

namespace myoid::opensim {

/// The parts of an OpenSim model that projects use.
struct ModelParts {
  std::vector<ProjectMuscle> muscles;                      ///< Lengths and forces.
  std::map<std::string, std::vector<std::string>> groups;  ///< Muscles of an ObjectGroup.
};

/// Reads the parts. Throws ReadError with the line if the file is no model, or a number of a muscle is none.
[[nodiscard]] ModelParts read_model_parts(const std::filesystem::path& path);

}  // namespace myoid::opensim
