#include "myoid/study/checks/determined_joint.h"

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::study {
namespace {

/// Three frames of the built-in arm at its default, as the markers of one of its bodies see it.
std::optional<Remark> found(const std::string& body, const CalibrationSpec* calibrate = nullptr) {
  const body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  body::BodyState state = body::make_state(model);
  body::compute_poses(model, model.default_q(), state);
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(3, 0.0, 0.02);
  markers.positions_m.resize(3, 0);
  for (const body::Marker& marker : model.markers) {
    if (model.bodies[static_cast<std::size_t>(marker.body)].name != body) continue;
    markers.names.push_back(marker.name);
    markers.positions_m.conservativeResize(Eigen::NoChange, markers.positions_m.cols() + 3);
    markers.positions_m.rightCols(3).rowwise() =
        (state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM).transpose();
  }
  Study study;
  study.model.builtin = "arm4";
  if (calibrate != nullptr) study.ik.calibrate = *calibrate;
  TrialSpec trial;
  trial.name = "t";
  return open_joint(study, model, trial, markers);
}

TEST(OpenJoint, IsAnErrorWhereNoMarkerFollowsTheStudysJoint) {
  const auto upper = found("upper_arm");
  ASSERT_TRUE(upper);
  EXPECT_EQ(upper->code, RemarkCode::joint_undetermined);
  EXPECT_EQ(upper->severity, Severity::error);
  EXPECT_EQ(upper->about, "elbow_flexion");
  EXPECT_FALSE(found("forearm_hand"));
}

TEST(OpenJoint, OfACoordinateThatACalibrationHoldsIsNone) {
  const CalibrationSpec calibrate{.window_s = {}, .free = {"elbow_flexion"}, .hold = {"elbow_flexion"}};
  EXPECT_FALSE(found("upper_arm", &calibrate));
}

}  // namespace
}  // namespace myoid::study
