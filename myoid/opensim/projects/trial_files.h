#pragma once

#include <vector>

#include "myoid/opensim/projects/project.h"

namespace myoid::opensim {

/// Reads the tables of all trials for their times, rates and angle units. Adds a remark for a file that is missing or
/// cannot be read, and for a time that counts from 1970.
void read_trial_tables(Project& project);

}  // namespace myoid::opensim
