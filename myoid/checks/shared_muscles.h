#pragma once

#include <vector>

#include "myoid/core/remark.h"
#include "myoid/study/study.h"

namespace myoid {

/// What the [[muscle]] tables name twice: a muscle of the model in two of them is an error, its
/// force would count twice; an EMG channel of two of them is a warning, unless `same_as` says that
/// one electrode stands for both.
[[nodiscard]] std::vector<Remark> shared_muscles(const Study& study);

}  // namespace myoid
