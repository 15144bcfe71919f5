#pragma once

#include <set>
#include <string>

#include "myoid/model/osim_frames.h"

namespace myoid::model {

/// Reads the wrap objects of ground and of the bodies, in the order of the tree, so that the first
/// of a name is the one a path finds.
void read_wrap_objects(OsimReading& reading, pugi::xml_node model);

/// Reads the GeometryPath of a muscle or another force (in any version: <GeometryPath>,
/// <path><GeometryPath>, or the point and wrap sets themselves). Throws ReadError if there is none.
[[nodiscard]] MusclePath read_path(OsimReading& reading, pugi::xml_node node);

/// The kind of a path that is not made of points (FunctionBasedPath, Scholz2015GeometryPath), which
/// is not read; empty for others.
[[nodiscard]] std::string foreign_path(pugi::xml_node node);

/// Notes, by class, the muscles whose curves are not Thelen's, and who takes which.
void note_classes(BodyModel& model);

/// Whether an element is a muscle of a kind that is read.
[[nodiscard]] bool is_muscle(pugi::xml_node node);
[[nodiscard]] Muscle read_muscle(OsimReading& reading, pugi::xml_node node);

}  // namespace myoid::model
