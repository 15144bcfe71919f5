#pragma once

#include "myoid/model/body_model.h"
#include "myoid/muscle/thelen.h"

namespace myoid::model {

/// The numbers of a model's muscle that the laws of Thelen (2003) need, SI.
[[nodiscard]] muscle::ThelenParameters thelen_parameters(const MuscleProperties& properties);

}  // namespace myoid::model
