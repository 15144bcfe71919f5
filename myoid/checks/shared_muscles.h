#pragma once

#include <vector>

#include "myoid/core/remark.h"
#include "myoid/study/study.h"

namespace myoid {

/// Finds names that two [[muscle]] tables share. A shared muscle of the model is an error, because its force would
/// count twice. A shared EMG channel is a warning, unless `same_as` says that one electrode stands for both.
[[nodiscard]] std::vector<Remark> shared_muscles(const Study& study);

}  // namespace myoid
