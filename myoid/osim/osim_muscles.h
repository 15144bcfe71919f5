#pragma once

#include "myoid/osim/osim_frames.h"

namespace myoid::model {

/// Notes, by class, the muscles whose curves are not Thelen's, and who takes which.
void note_classes(BodyModel& model);

/// True if an element is a muscle of a kind that is read.
[[nodiscard]] bool is_muscle(pugi::xml_node node);
[[nodiscard]] Muscle read_muscle(OsimReading& reading, pugi::xml_node node);

}  // namespace myoid::model
