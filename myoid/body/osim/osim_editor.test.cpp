#include "myoid/body/osim/osim_editor.h"

#include <string>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {
namespace {

double mass_of(const BodyModel& m) {
  double sum = 0.0;
  for (const Body& body : m.bodies) sum += body.mass_kg;
  return sum;
}

OsimEditor::Factors every(const BodyModel& m, const Vec3& f) {
  OsimEditor::Factors factors;
  for (const Body& body : m.bodies) factors[body.name] = f;
  return factors;
}

double path_length(const BodyModel& m, int muscle) {
  BodyState state = make_state(m);
  compute_poses(m, m.default_q(), state);
  return compute_path(m, muscle, state).length_m;
}

TEST(OsimEditor, AModelTwiceAsLargeHasEveryLengthDoubled) {
  const BodyModel before = parse_osim(arm4_osim(), "arm4.osim");
  OsimEditor editor(arm4_osim(), "arm4.osim");
  editor.scale_geometry(every(before, Vec3::Constant(2.0)));
  editor.scale_masses(every(before, Vec3::Constant(2.0)), false, -1.0);
  const BodyModel after = parse_osim(editor.text(), "scaled.osim");
  // Volume 8, and inertia mass times length squared.
  EXPECT_NEAR(mass_of(after), 8.0 * mass_of(before), 1e-12);
  for (std::size_t b = 1; b < before.bodies.size(); ++b) {
    EXPECT_LT((after.bodies[b].I_BBcm_B - 32.0 * before.bodies[b].I_BBcm_B).norm(),
              1e-13 * (1.0 + after.bodies[b].I_BBcm_B.norm()));
    EXPECT_LT((after.bodies[b].p_BBcm_B - 2.0 * before.bodies[b].p_BBcm_B).norm(), 1e-15);
  }
  for (std::size_t m = 0; m < before.muscles.size(); ++m) {
    const int muscle = static_cast<int>(m);
    EXPECT_NEAR(path_length(after, muscle), 2.0 * path_length(before, muscle), 1e-12);
  }
  for (std::size_t k = 0; k < before.markers.size(); ++k)
    EXPECT_LT((after.markers[k].p_BM - 2.0 * before.markers[k].p_BM).norm(), 1e-15);
}

TEST(OsimEditor, KeepsTheSharesOfMassWhereAsked) {
  const BodyModel before = parse_osim(arm4_osim(), "arm4.osim");
  OsimEditor::Factors factors = every(before, Vec3::Ones());
  factors[before.bodies.back().name] = Vec3(1.0, 1.3, 1.0);
  OsimEditor editor(arm4_osim(), "arm4.osim");
  editor.scale_geometry(factors);
  editor.scale_masses(factors, true, 12.0);
  const BodyModel after = parse_osim(editor.text(), "scaled.osim");
  EXPECT_NEAR(mass_of(after), 12.0, 1e-12);
  for (std::size_t b = 1; b < before.bodies.size(); ++b) {
    EXPECT_NEAR(after.bodies[b].mass_kg / mass_of(after), before.bodies[b].mass_kg / mass_of(before), 1e-14);
  }
}

TEST(OsimEditor, MultipliesTheLengthsOfAMuscleAndNamesTheModel) {
  OsimEditor editor(arm4_osim(), "arm4.osim");
  const BodyModel before = parse_osim(arm4_osim(), "arm4.osim");
  editor.scale_lengths(before.muscles[0].name, 1.25);
  editor.set_name("someone");
  const BodyModel after = parse_osim(editor.text(), "scaled.osim");
  EXPECT_EQ(after.name, "someone");
  EXPECT_NEAR(after.muscles[0].properties.optimal_fiber_length_m,
              1.25 * before.muscles[0].properties.optimal_fiber_length_m, 1e-16);
  EXPECT_NEAR(after.muscles[0].properties.tendon_slack_length_m,
              1.25 * before.muscles[0].properties.tendon_slack_length_m, 1e-16);
}

constexpr const char* kTranslating = R"(<?xml version="1.0"?>
<OpenSimDocument Version="40000"><Model name="slider">
<Ground name="ground"/>
<BodySet name="b"><objects>
 <Body name="upper"><mass>1</mass><inertia>0.1 0.1 0.1 0 0 0</inertia></Body>
 <Body name="lower"><mass>1</mass><inertia>0.1 0.1 0.1 0 0 0</inertia></Body>
</objects></BodySet>
<JointSet name="j"><objects>
 <WeldJoint name="base"><socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/upper</socket_child_frame></WeldJoint>
 <CustomJoint name="knee"><socket_parent_frame>/bodyset/upper</socket_parent_frame>
  <socket_child_frame>/bodyset/lower</socket_child_frame>
  <coordinates><Coordinate name="angle"/><Coordinate name="shift"/></coordinates>
  <SpatialTransform>
   <TransformAxis name="rotation1"><coordinates>angle</coordinates><axis>0 0 1</axis><LinearFunction name="function"><coefficients>1 0</coefficients></LinearFunction></TransformAxis>
   <TransformAxis name="rotation2"><axis>0 1 0</axis><Constant name="function"><value>0</value></Constant></TransformAxis>
   <TransformAxis name="rotation3"><axis>1 0 0</axis><Constant name="function"><value>0</value></Constant></TransformAxis>
   <TransformAxis name="translation1"><coordinates>angle</coordinates><axis>1 0 0</axis><SimmSpline name="function"><x>-1 0 1 2</x><y>0.1 0.2 0.15 0.1</y></SimmSpline></TransformAxis>
   <TransformAxis name="translation2"><axis>0 1 0</axis><Constant name="function"><value>-0.4</value></Constant></TransformAxis>
   <TransformAxis name="translation3"><coordinates>shift</coordinates><axis>0 0 1</axis><LinearFunction name="function"><coefficients>1 0</coefficients></LinearFunction></TransformAxis>
  </SpatialTransform></CustomJoint>
</objects></JointSet></Model></OpenSimDocument>)";

TEST(OsimEditor, TranslationsOfAJointFollowTheParentButFreedomsDoNot) {
  OsimEditor editor(kTranslating, "slider.osim");
  editor.scale_geometry({{"upper", Vec3(1.5, 2.0, 3.0)}});
  const BodyModel before = parse_osim(kTranslating, "slider.osim");
  const BodyModel after = parse_osim(editor.text(), "scaled.osim");
  BodyState a = make_state(before), b = make_state(after);
  const Eigen::Vector2d q(0.6, 0.07);
  compute_poses(before, q, a);
  compute_poses(after, q, b);
  EXPECT_NEAR(b.X_GB[2].p[0], 1.5 * a.X_GB[2].p[0], 1e-15);
  EXPECT_NEAR(b.X_GB[2].p[1], 2.0 * -0.4, 1e-15);
  EXPECT_NEAR(b.X_GB[2].p[2], 0.07, 1e-15);  // the coordinate itself is meters already
}

TEST(OsimEditor, MarkersAreMovedInTheFrameOfTheirBody) {
  OsimEditor editor(arm4_osim(), "arm4.osim");
  const BodyModel before = parse_osim(arm4_osim(), "arm4.osim");
  const std::string name = before.markers[0].name;
  editor.move_marker(name, Vec3(0.01, 0.02, 0.03));
  editor.remove_markers([&](const std::string& other) { return other != name; });
  const BodyModel after = parse_osim(editor.text(), "moved.osim");
  ASSERT_EQ(after.markers.size(), 1U);
  EXPECT_LT((after.markers[0].p_BM - Vec3(0.01, 0.02, 0.03)).norm(), 1e-16);
  EXPECT_NE(editor.marker_set_text().find("<MarkerSet"), std::string::npos);
}

}  // namespace
}  // namespace myoid::body
