#pragma once

#include <vector>

#include "myoid/core/remark.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// Finds muscles of the study without a moment arm by any of the study's coordinates over their
/// whole range, such as those of the other leg. A [[muscle]] of none but such muscles is an error,
/// and a warning if others of its `osim` have an arm.
[[nodiscard]] std::vector<Remark> idle_muscles(const Study& study, const model::BodyModel& model);

}  // namespace myoid
