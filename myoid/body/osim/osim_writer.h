#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::body {

/// One number (or row of numbers) of a model file to change.
struct OsimChange {
  std::string set;             ///< "ForceSet", "BodySet", "MarkerSet", "JointSet", ...
  std::string object;          ///< Name of the object in the set.
  std::string property;        ///< Element of the object, e.g. "max_isometric_force".
  std::vector<double> values;  ///< In the units of the file: SI and radians.
};

/// Returns the text of an .osim with these numbers; every other byte stays, and a number that is already equal keeps
/// its digits. Elements that stand in files of their own come into the text, byte for byte (osim_document.h). New
/// numbers have the fewest digits that read back the same. An element that the object omits is added after the object's
/// opening tag with the indentation of its siblings. Throws ReadError if the text is no model, ModelError for an
/// unknown object or a value that is not finite.
[[nodiscard]] std::string changed_osim(std::string_view text,
                                       const std::filesystem::path& path,
                                       const std::vector<OsimChange>& changes);

}  // namespace myoid::body
