#pragma once

#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Finds names that two [[muscle]] tables share. A shared muscle of the model is an error, because its force would
/// count twice. A shared EMG channel is a warning, unless `same_as` says that one electrode stands for both.
[[nodiscard]] std::vector<Remark> shared_muscles(const Study& study);

/// Finds muscles of the study without a moment arm by any of the study's coordinates over their
/// whole range, such as those of the other leg. A [[muscle]] of none but such muscles is an error,
/// and a warning if others of its `osim` have an arm.
[[nodiscard]] std::vector<Remark> idle_muscles(const Study& study, const body::BodyModel& model);

}  // namespace myoid::study
