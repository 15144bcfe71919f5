#pragma once

#include <vector>

#include "myoid/core/remark.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// Finds a total mass of the model's bodies that is larger than the person's of the study or, of a model that stands,
/// smaller. Masses that no person has are those of model::implausible.
[[nodiscard]] std::vector<Remark> unlikely_mass(const Study& study, const model::BodyModel& model);

}  // namespace myoid
