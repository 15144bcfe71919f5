#pragma once

#include <span>
#include <string>
#include <vector>

#include <pugixml.hpp>

#include "myoid/body/osim/osim_xml.h"
#include "myoid/opensim/projects/project.h"
#include "myoid/opensim/setup_elements.h"

namespace myoid::opensim {

/// A number of a muscle in .osimx, its unit, and the range of the optimizer.
struct OsimxNumber {
  const char* element;
  MuscleQuantity quantity;
  double unit;               ///< In SI.
  const char* flag;          ///< Of a task that varies the quantity; empty: no task does.
  CalibrationBounds bounds;  ///< In SI, or factors of the start.
  bool is_length = false;
};

/// Returns the numbers of a muscle, in the order of the file.
[[nodiscard]] std::span<const OsimxNumber> osimx_numbers();
/// Returns the elements of a file.
[[nodiscard]] const ElementTable& osimx_elements();

/// Returns <OsimxModel>; an empty node in a document of another kind.
[[nodiscard]] pugi::xml_node osimx_model(const body::OsimXml& xml);

/// Reads the muscles, in SI. Throws ReadError with the line for a muscle without name or with the name of another, and
/// for a length or force that is not positive.
[[nodiscard]] std::vector<ProjectMuscle> read_osimx(const body::OsimXml& xml);

/// Returns the text of an .osimx file with the muscles of the project and the name of its model, in the units of the
/// NMSM Pipeline.
[[nodiscard]] std::string osimx_text(const Project& project);

}  // namespace myoid::opensim
