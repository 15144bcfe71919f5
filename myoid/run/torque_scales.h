#pragma once

#include <optional>
#include <string>

#include "myoid/fit/intervals/result.h"
#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::run {

/// The scale of the dynamometer's torques over that of the torques by weight and inertia, as one set of muscles tells
/// it from trials of both kinds.
struct TorqueScales {
  double ratio = 1.0;            ///< 1.1: the dynamometer's torques are 10 % larger.
  double low = 1.0, high = 1.0;  ///< 95 % interval.
  double usual = 0.0;            ///< Relative spread of each scale that the study believes.

  /// Returns true if the interval has no ratio within the usual spread.
  [[nodiscard]] bool differ() const { return low > 1.0 + usual || high < 1.0 - usual; }
  [[nodiscard]] std::string sentence() const;
};

/// Returns the ratio by method torque; empty where the fitted trials are of one kind, or the fit is of exact data.
[[nodiscard]] std::optional<TorqueScales> torque_scales(const fit::StudyData& data,
                                                        const fit::EstimatorOptions& options,
                                                        const fit::IdentificationResult& torque);

}  // namespace myoid::run
