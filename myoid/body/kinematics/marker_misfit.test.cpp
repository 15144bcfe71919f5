#include "myoid/body/kinematics/marker_misfit.h"

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {
namespace {

/// Three frames of the built-in arm's markers at rest, times a factor and moved.
MarkerMisfit misfit_of(double factor, const Vec3& swapped = Vec3::Zero()) {
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  body::BodyState state = body::make_state(arm);
  body::compute_poses(arm, arm.default_q(), state);
  MarkerSeries markers;
  markers.time_s = Eigen::Vector3d(0.0, 0.01, 0.02);
  markers.positions_m.resize(3, 3 * static_cast<Eigen::Index>(arm.markers.size()));
  for (std::size_t i = 0; i < arm.markers.size(); ++i) {
    markers.names.push_back(arm.markers[i].name);
    const Vec3 p = state.X_GB[static_cast<std::size_t>(arm.markers[i].body)] * arm.markers[i].p_BM;
    const Vec3 there = factor * p + (i % 2 == 0 ? swapped : Vec3(-swapped));
    for (Eigen::Index frame = 0; frame < 3; ++frame)
      markers.positions_m.block(frame, 3 * static_cast<Eigen::Index>(i), 1, 3) = there.transpose();
  }
  return marker_misfit(arm, markers, body::inverse_kinematics(arm, markers));
}

TEST(MarkerMisfit, SaysNothingOfMarkersThatFit) {
  const MarkerMisfit m = misfit_of(1.0);
  EXPECT_LT(m.rms_m, 1e-6);
  EXPECT_TRUE(m.warning.empty()) << m.warning;
}

TEST(MarkerMisfit, NamesTheUnitThatWasProbablyMeant) {
  const MarkerMisfit m = misfit_of(1000.0);
  EXPECT_TRUE(m.wrong_unit);
  EXPECT_NE(m.warning.find("millimeters"), std::string::npos) << m.warning;
}

TEST(MarkerMisfit, AsksWhereTheUnitIsRight) {
  const MarkerMisfit m = misfit_of(1.0, Vec3(0.1, 0.0, 0.1));
  EXPECT_FALSE(m.wrong_unit);
  EXPECT_NE(m.warning.find("swapped labels"), std::string::npos) << m.warning;
  EXPECT_GT(m.rms_m, 0.04);
}

TEST(MarkerMisfit, NamesAShiftThatAllMarkersShare) {
  // The built-in arm hangs on ground and moves with it only if its root is free.
  body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  for (body::Coordinate& c : arm.coordinates) c.locked = c.name != "elbow_flexion";
  body::BodyState state = body::make_state(arm);
  body::compute_poses(arm, arm.default_q(), state);
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::Zero(1);
  markers.positions_m.resize(1, 3 * static_cast<Eigen::Index>(arm.markers.size()));
  const Vec3 shift(0.0, -0.8, 0.1);
  for (std::size_t i = 0; i < arm.markers.size(); ++i) {
    markers.names.push_back(arm.markers[i].name);
    const Vec3 p = state.X_GB[static_cast<std::size_t>(arm.markers[i].body)] * arm.markers[i].p_BM;
    markers.positions_m.block<1, 3>(0, 3 * static_cast<Eigen::Index>(i)) = (p + shift).transpose();
  }
  // A hinge may swing towards the shift; what is left of it is the same for all but little.
  body::IkOptions options;
  options.tasks.push_back({"elbow_flexion", arm.default_q()[arm.coordinate_index("elbow_flexion")], 1e3});
  const MarkerMisfit m = marker_misfit(arm, markers, body::inverse_kinematics(arm, markers, options));
  EXPECT_FALSE(m.wrong_unit);
  EXPECT_NE(m.warning.find("(0.000, -0.800, 0.100) m"), std::string::npos) << m.warning;
}

TEST(SpreadFrames, AreSixAtEvenDistancesOrAllOfFewer) {
  MarkerSeries markers{Eigen::VectorXd::LinSpaced(101, 0.0, 10.0), {"a"}, Eigen::MatrixXd::Zero(101, 3)};
  const MarkerSeries some = spread_frames(markers);
  EXPECT_EQ(some.time_s, Eigen::VectorXd::LinSpaced(6, 0.0, 10.0));
  EXPECT_EQ(spread_frames(some).frame_count(), 6);
  markers.time_s.conservativeResize(1);
  markers.positions_m.conservativeResize(1, 3);
  EXPECT_EQ(spread_frames(markers).frame_count(), 1);
}

TEST(SegmentsOf, AreTheBodiesThatCarryTwoMarkersOrMore) {
  const body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  MarkerSeries markers;
  for (const body::Marker& marker : model.markers) markers.names.push_back(marker.name);
  markers.names.emplace_back("of nobody");
  std::size_t known = 0;
  for (const recording::ExpectedSegment& e : segments_of(model, markers)) {
    ASSERT_GE(e.segment.markers.size(), 2U);
    ASSERT_EQ(static_cast<std::size_t>(e.local_m.cols()), e.segment.markers.size());
    for (std::size_t k = 0; k < e.segment.markers.size(); ++k) {
      const auto& marker = model.markers[static_cast<std::size_t>(e.segment.markers[k])];
      EXPECT_EQ(model.bodies[static_cast<std::size_t>(marker.body)].name, e.segment.name);
      EXPECT_EQ(marker.p_BM, e.local_m.col(static_cast<Eigen::Index>(k)));
      ++known;
    }
  }
  EXPECT_GE(known, 2U);
}

}  // namespace
}  // namespace myoid::body
