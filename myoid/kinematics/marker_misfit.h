#pragma once

#include <optional>
#include <string>

#include "myoid/kinematics/inverse_kinematics.h"

namespace myoid::kinematics {

struct MarkerMisfit {
  double rms_m = 0.0;       ///< Of all distances, over the frames in which markers were seen.
  bool wrong_unit = false;  ///< The recording is not in the unit that its file says.
  /// What to tell a person where the markers lie more than 4 cm off; a unit that was probably meant
  /// is named, from distances within the segments of the model, and a shift that all have in
  /// common. Empty where they fit.
  std::string warning;
};

/// How far the markers lie from the model's after inverse kinematics.
[[nodiscard]] MarkerMisfit marker_misfit(const model::BodyModel& model,
                                         const recording::MarkerSeries& markers,
                                         const kinematics::IkResult& solved);

}  // namespace myoid::kinematics
