#pragma once

#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Compares the body mass and height that the trials' .c3d files state (`recording::stated_body`) with each other and
/// with [subject] mass_kg. Warns of a difference above a tenth in mass or a twentieth in height; notes a mass that the
/// study does not give. Files that cannot be read are left to their readers.
[[nodiscard]] std::vector<Remark> unlike_stated_bodies(const Study& study);

}  // namespace myoid::study
