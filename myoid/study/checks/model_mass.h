#pragma once

#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Finds a total mass of the model's bodies that is larger than the person's of the study or, of a model that stands,
/// smaller. Masses that no person has are those of body::implausible.
[[nodiscard]] std::vector<Remark> unlikely_mass(const Study& study, const body::BodyModel& model);

}  // namespace myoid::study
