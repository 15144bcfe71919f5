#pragma once

#include <string>

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Reads the wrap objects of ground and of the bodies in the order of the tree: a path finds the
/// first object of a name.
void read_wrap_objects(OsimReading& reading, pugi::xml_node model);

/// Reads the path of a muscle or another force in any version: <GeometryPath>,
/// <path><GeometryPath>, the bare point and wrap sets, or a FunctionBasedPath of polynomials.
/// Throws ReadError without a path.
[[nodiscard]] MusclePath read_path(OsimReading& reading, pugi::xml_node node);

/// Returns the class of an unsupported path (Scholz2015GeometryPath, a FunctionBasedPath of
/// functions other than polynomials); empty for a supported path.
[[nodiscard]] std::string foreign_path(const OsimReading& reading, pugi::xml_node node);

}  // namespace myoid::model
