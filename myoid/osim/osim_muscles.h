#pragma once

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Adds a note for each class of muscles with curves other than Thelen's, with the commands that use them.
void note_classes(BodyModel& model);

/// Returns true if an element is a muscle of a kind that is read.
[[nodiscard]] bool is_muscle(pugi::xml_node node);
[[nodiscard]] Muscle read_muscle(OsimReading& reading, pugi::xml_node node);

}  // namespace myoid::model
