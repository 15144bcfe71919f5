#pragma once

#include <map>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/checks/relaxed_joint.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Finds the trials whose dynamometer's torque is in another unit than in the others: the torque over that of the
/// active muscles, by their EMG, is 6 times the other trials' median, or 12 times less. Three other trials are needed.
/// Torques beyond any person's have an error of their own. A trial in which muscles work against each other tells no
/// torque that is too small.
[[nodiscard]] std::vector<Remark> unlike_torques(const Study& study,
                                                 const body::BodyModel& model,
                                                 const std::vector<EffortTrial>& trials);

/// The least and the greatest angle of a coordinate [rad].
struct AngleSpan {
  double least_rad = 1e300, greatest_rad = -1e300;
};

/// The angles of a coordinate in a trial.
struct TrialAngles {
  std::string trial;
  bool held = false;  ///< A device or the person may hold the joint still.
  AngleSpan span;
};
using AnglesOfStudy = std::map<std::string, std::vector<TrialAngles>>;  ///< By coordinate.

/// Returns the span over all trials.
[[nodiscard]] AngleSpan span_of(const std::vector<TrialAngles>& trials);

/// Finds the trials whose angles are radians that are called degrees: they are as near to 0 as radians are, lie among
/// the other trials' angles if they are radians, and have a range that is 15 times as small as that of every other
/// trial of its kind, held or moved. Two others are needed.
[[nodiscard]] std::vector<Remark> unlike_angles(const AnglesOfStudy& angles);

}  // namespace myoid::study
