#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::model {

/// One number (or row of numbers) of a model file to change.
struct OsimChange {
  std::string set;             ///< "ForceSet", "BodySet", "MarkerSet", "JointSet", ...
  std::string object;          ///< Name of the object in the set.
  std::string property;        ///< Element of the object, e.g. "max_isometric_force".
  std::vector<double> values;  ///< SI and radians, as the file has them.
};

/// The text of an .osim in which only these numbers differ; all else stays byte for byte, and a
/// number that is the same already keeps its digits. New numbers have the fewest digits that read
/// back the same. An element that the object omits is added after its opening tag, indented as its
/// siblings. Throws ReadError if the text is no model, ModelError if there is no such object or a
/// value is not finite.
[[nodiscard]] std::string changed_osim(std::string_view text,
                                       const std::filesystem::path& path,
                                       const std::vector<OsimChange>& changes);

}  // namespace myoid::model
