#pragma once

#include "myoid/fit/measurement/options.h"

namespace myoid::test {

/// Geometry, tendons and sensors without any error that residuals do not show.
inline fit::UnseenSpreads no_unseen_errors() {
  return {.moment_arm = 0.0,
          .moment_arm_slope = 0.0,
          .tendon_strain = 0.0,
          .torque_scale = 0.0,
          .crosstalk = 0.0,
          .gain_drift = 0.0,
          .effort = 0.0};
}

}  // namespace myoid::test
