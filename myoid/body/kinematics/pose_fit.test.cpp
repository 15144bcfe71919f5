#include "myoid/body/kinematics/pose_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {
namespace {

MarkerSeries one_frame(const body::BodyModel& m, const Eigen::VectorXd& q) {
  MarkerSeries series;
  series.time_s = Eigen::VectorXd::Zero(1);
  series.positions_m.resize(1, static_cast<Eigen::Index>(3 * m.markers.size()));
  body::BodyState state = body::make_state(m);
  body::compute_poses(m, q, state);
  for (std::size_t i = 0; i < m.markers.size(); ++i) {
    const body::Marker& marker = m.markers[i];
    series.names.push_back(marker.name);
    series.positions_m.block<1, 3>(0, static_cast<Eigen::Index>(3 * i)) =
        (state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM).transpose();
  }
  return series;
}

std::vector<PoseFit::Pair> all_pairs(const body::BodyModel& m) {
  std::vector<PoseFit::Pair> pairs;
  for (std::size_t i = 0; i < m.markers.size(); ++i)
    pairs.push_back({i, static_cast<Eigen::Index>(i), 1.0 + 0.1 * static_cast<double>(i)});
  return pairs;
}

/// A chain of two hinges whose second follows the first: q2 = 0.5 q1.
body::BodyModel coupled_chain() {
  return body::parse_osim(R"(<?xml version="1.0"?>
<OpenSimDocument Version="40000"><Model name="chain">
<Ground name="ground"/>
<BodySet name="b"><objects>
 <Body name="one"><mass>1</mass><inertia>0.1 0.1 0.1 0 0 0</inertia></Body>
 <Body name="two"><mass>1</mass><inertia>0.1 0.1 0.1 0 0 0</inertia></Body>
</objects></BodySet>
<JointSet name="j"><objects>
 <PinJoint name="j1"><socket_parent_frame>/ground</socket_parent_frame>
  <socket_child_frame>/bodyset/one</socket_child_frame>
  <coordinates><Coordinate name="q1"><range>-2 2</range><clamped>true</clamped></Coordinate></coordinates></PinJoint>
 <PinJoint name="j2"><socket_parent_frame>f</socket_parent_frame>
  <socket_child_frame>/bodyset/two</socket_child_frame>
  <coordinates><Coordinate name="q2"/></coordinates>
  <frames><PhysicalOffsetFrame name="f"><socket_parent>/bodyset/one</socket_parent>
   <translation>0.3 0 0</translation></PhysicalOffsetFrame></frames></PinJoint>
</objects></JointSet>
<ConstraintSet name="c"><objects><CoordinateCouplerConstraint name="k">
 <coupled_coordinates_function><LinearFunction><coefficients>0.5 0</coefficients></LinearFunction></coupled_coordinates_function>
 <independent_coordinate_names>q1</independent_coordinate_names>
 <dependent_coordinate_name>q2</dependent_coordinate_name></CoordinateCouplerConstraint></objects></ConstraintSet>
<MarkerSet name="m"><objects>
 <Marker name="tip"><socket_parent_frame>/bodyset/two</socket_parent_frame><location>0.4 0 0</location></Marker>
 <Marker name="mid"><socket_parent_frame>/bodyset/one</socket_parent_frame><location>0.2 0.05 0</location></Marker>
</objects></MarkerSet>
</Model></OpenSimDocument>)",
                          "chain.osim");
}

TEST(PoseFit, FindsThePostureThatMadeTheMarkers) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim(), "arm4.osim");
  Eigen::VectorXd q = m.default_q();
  for (Eigen::Index c = 0; c < q.size(); ++c)
    if (!m.coordinates[static_cast<std::size_t>(c)].locked) q[c] += 0.4;
  const MarkerSeries markers = one_frame(m, q);
  const IkOptions options;
  PoseFit fit(m, options, all_pairs(m));
  fit.set_targets(markers, 0);
  EXPECT_EQ(fit.seen_count(), static_cast<int>(m.markers.size()));
  const PoseFit::Pose pose = fit.solve(m.default_q());
  ASSERT_TRUE(pose.converged);
  EXPECT_LT((pose.q - q).cwiseAbs().maxCoeff(), 1e-8);
  EXPECT_LT(pose.cost, 1e-18);  // squares of nanometers
}

TEST(PoseFit, ADependentCoordinateFollowsItsCoupler) {
  const body::BodyModel m = coupled_chain();
  Eigen::VectorXd q(2);
  q << 0.9, 0.45;
  const MarkerSeries markers = one_frame(m, q);
  const IkOptions options;
  PoseFit fit(m, options, all_pairs(m));
  EXPECT_EQ(fit.free().size(), 1U);
  fit.set_targets(markers, 0);
  const PoseFit::Pose pose = fit.solve(Eigen::VectorXd::Zero(2));
  ASSERT_TRUE(pose.converged);
  EXPECT_NEAR(pose.q[0], 0.9, 1e-9);
  EXPECT_DOUBLE_EQ(pose.q[1], 0.5 * pose.q[0]);
}

TEST(PoseFit, AClampedCoordinateStaysWithinItsRange) {
  const body::BodyModel m = coupled_chain();
  Eigen::VectorXd q(2);
  q << 2.5, 1.25;
  const MarkerSeries markers = one_frame(m, q);
  const IkOptions options;
  PoseFit fit(m, options, all_pairs(m));
  fit.set_targets(markers, 0);
  const PoseFit::Pose pose = fit.solve(Eigen::VectorXd::Constant(2, 1.5));
  EXPECT_TRUE(pose.converged);
  EXPECT_DOUBLE_EQ(pose.q[0], 2.0);
}

TEST(PoseFit, ATaskPullsACoordinateByItsWeight) {
  // Along one hinge with one marker at distance r: J = ((1 - cos d) r^2 + W (q - q*)^2 / 2), whose
  // derivative vanishes where r^2 sin(q - m) = W (q* - q).
  body::BodyModel m = coupled_chain();
  m.couplers.clear();
  m.coordinates[1].locked = true;
  Eigen::VectorXd q(2);
  q << 0.3, 0.0;
  const MarkerSeries markers = one_frame(m, q);
  IkOptions options;
  options.tasks.push_back({"q1", 0.8, 0.05});
  PoseFit fit(m, options, {{1, 1, 1.0}});
  fit.set_targets(markers, 0);
  const PoseFit::Pose pose = fit.solve(Eigen::VectorXd::Zero(2));
  ASSERT_TRUE(pose.converged);
  const double r2 = 0.2 * 0.2 + 0.05 * 0.05;
  EXPECT_NEAR(r2 * std::sin(pose.q[0] - 0.3), 0.05 * (0.8 - pose.q[0]), 1e-12);
}

TEST(PoseFit, ABarrierBalancesTheMarkersPullToTheEndOfARange) {
  // One hinge with one marker at distance r, as above:
  // r^2 sin(q - m) = mu (1/(q - lower) - 1/(upper - q)).
  body::BodyModel m = coupled_chain();  // q1 from -2 to 2
  m.couplers.clear();
  m.coordinates[1].locked = true;
  Eigen::VectorXd q(2);
  q << 2.2, 0.0;  // beyond the end
  const MarkerSeries markers = one_frame(m, q);
  const IkOptions options;
  PoseFit fit(m, options, {{1, 1, 1.0}});
  fit.set_targets(markers, 0);
  const double mu = 1e-3, r2 = 0.2 * 0.2 + 0.05 * 0.05;
  const PoseFit::Pose pose = fit.solve_inside(Eigen::VectorXd::Zero(2), mu);
  ASSERT_TRUE(pose.converged);
  EXPECT_LT(pose.q[0], 2.0);
  EXPECT_NEAR(r2 * std::sin(pose.q[0] - 2.2), mu * (1.0 / (pose.q[0] + 2.0) - 1.0 / (2.0 - pose.q[0])), 1e-10);
  // Afterwards there is none.
  EXPECT_DOUBLE_EQ(fit.solve(Eigen::VectorXd::Zero(2)).q[0], 2.0);
}

TEST(PoseFit, UnderABarrierWhatNoMarkerDeterminesStandsInTheMiddle) {
  body::BodyModel m = coupled_chain();
  m.couplers.clear();
  m.coordinates[1].clamped = true;
  m.coordinates[1].lower = -0.5;
  m.coordinates[1].upper = 1.5;
  Eigen::VectorXd q(2);
  q << 0.3, 0.0;
  const MarkerSeries markers = one_frame(m, q);
  const IkOptions options;
  PoseFit fit(m, options, {{1, 1, 1.0}});  // only the marker on the first body
  fit.set_targets(markers, 0);
  const PoseFit::Pose pose = fit.solve_inside(Eigen::VectorXd::Zero(2), 1e-5);
  EXPECT_TRUE(pose.converged);
  EXPECT_NEAR(pose.q[1], 0.5, 1e-6);
  // Pulled towards the middle of -2..2 by mu (1/1.7 - 1/2.3) / r^2 = 3.6e-5.
  EXPECT_NEAR(pose.q[0], 0.3 - 1e-5 * (1.0 / 1.7 - 1.0 / 2.3) / 0.0425, 1e-7);
}

TEST(PoseFit, MarksWhatTheMarkersLeaveOpen) {
  body::BodyModel m = coupled_chain();
  m.couplers.clear();
  const MarkerSeries markers = one_frame(m, Eigen::VectorXd::Zero(2));
  const IkOptions options;
  PoseFit fit(m, options, {{1, 1, 1.0}});  // only the marker on the first body
  fit.set_targets(markers, 0);
  const PoseFit::Pose pose = fit.solve(Eigen::VectorXd::Constant(2, 0.1));
  fit.place(pose.q);
  std::vector<bool> open(2, false);
  fit.collect_undetermined(open);
  EXPECT_FALSE(open[0]);
  EXPECT_TRUE(open[1]);
}

}  // namespace
}  // namespace myoid::body
