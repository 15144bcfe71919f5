#pragma once

#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Tells whether a length of a muscle with its tendon leaves room for the fibers.
struct FiberRoom {
  bool none = false;  ///< The tendon is as long as the muscle with it.
  std::string says;   ///< A sentence if there is no room or fibers have an unlikely length, else empty.
};

/// Compares a length of a muscle with its tendon with the tendon's slack length and the optimal fiber length.
[[nodiscard]] FiberRoom fiber_room(const std::string& muscle, double length_m, double tendon_m, double optimal_m);

/// Finds the muscles of a study whose tendons leave no room for fibers, or whose fibers have an unlikely length, at
/// every angle in the range of the study's coordinates.
[[nodiscard]] std::vector<Remark> tendons_too_long(const Study& study, const body::BodyModel& model);

}  // namespace myoid::study
