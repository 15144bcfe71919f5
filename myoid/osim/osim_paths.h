#pragma once

#include <string>

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Reads the wrap objects of ground and of the bodies, in the order of the tree, so that the first
/// of a name is the one a path finds.
void read_wrap_objects(OsimReading& reading, pugi::xml_node model);

/// Reads the path of a muscle or another force (in any version: <GeometryPath>,
/// <path><GeometryPath>, the point and wrap sets themselves; or a FunctionBasedPath of
/// polynomials). Throws ReadError if there is none.
[[nodiscard]] MusclePath read_path(OsimReading& reading, pugi::xml_node node);

/// The kind of a path that is not read (Scholz2015GeometryPath, a FunctionBasedPath of other
/// functions than polynomials); empty for others.
[[nodiscard]] std::string foreign_path(const OsimReading& reading, pugi::xml_node node);

}  // namespace myoid::model
