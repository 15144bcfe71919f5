#pragma once

#include <string>

#include "myoid/opensim/projects/project.h"

namespace myoid::opensim {

/// Returns the text of a subject file of the project's dialect, CEINMS or CEINMS-RT, that `read_ceinms_subject` reads
/// with the same values: numbers, curves, muscles of the degrees of freedom and, in CEINMS-RT, of the channels. Numbers
/// for which the dialect has no element are left out. The names of its muscles must have no blanks.
[[nodiscard]] std::string ceinms_subject_text(const Project& project);

}  // namespace myoid::opensim
