#include "myoid/body/osim/osim_updater.h"

#include <algorithm>
#include <filesystem>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

/// Two models are the same: names and numbers of all parts, and at random postures the places of
/// all bodies and the lengths of all paths. `digits`: how far numbers may differ.
void expect_same(const BodyModel& a, const BodyModel& b, double digits = 0.0) {
  const auto names = [](const auto& list) {
    std::vector<std::string> result;
    for (const auto& item : list) result.push_back(item.name);
    return result;
  };
  EXPECT_EQ(names(a.bodies), names(b.bodies));
  EXPECT_EQ(names(a.joints), names(b.joints));
  ASSERT_EQ(names(a.coordinates), names(b.coordinates));
  EXPECT_EQ(names(a.markers), names(b.markers));
  EXPECT_EQ(names(a.wrap_objects), names(b.wrap_objects));
  ASSERT_EQ(names(a.muscles), names(b.muscles));
  EXPECT_EQ(names(a.actuators), names(b.actuators));
  EXPECT_EQ(names(a.passive_forces), names(b.passive_forces));
  EXPECT_EQ(names(a.couplers), names(b.couplers));
  EXPECT_EQ(names(a.constraints), names(b.constraints));
  EXPECT_EQ(a.force_order, b.force_order);
  EXPECT_EQ(a.unsupported, b.unsupported);
  EXPECT_EQ(a.gravity_G, b.gravity_G);
  for (std::size_t k = 0; k < std::min(a.bodies.size(), b.bodies.size()); ++k) {
    EXPECT_EQ(a.bodies[k].mass_kg, b.bodies[k].mass_kg);
    EXPECT_EQ(a.bodies[k].p_BBcm_B, b.bodies[k].p_BBcm_B);
    EXPECT_LE((a.bodies[k].I_BBcm_B - b.bodies[k].I_BBcm_B).cwiseAbs().maxCoeff(), digits);
  }
  for (std::size_t k = 0; k < a.coordinates.size(); ++k) {
    const Coordinate &x = a.coordinates[k], &y = b.coordinates[k];
    EXPECT_EQ(x.default_value, y.default_value) << x.name;
    EXPECT_EQ(x.lower, y.lower) << x.name;
    EXPECT_EQ(x.upper, y.upper) << x.name;
    EXPECT_EQ(x.clamped, y.clamped) << x.name;
    EXPECT_EQ(x.locked, y.locked) << x.name;
    EXPECT_EQ(x.motion, y.motion) << x.name;
  }
  for (std::size_t k = 0; k < a.muscles.size(); ++k) {
    const MuscleProperties &x = a.muscles[k].properties, &y = b.muscles[k].properties;
    EXPECT_EQ(x.max_isometric_force_n, y.max_isometric_force_n) << a.muscles[k].name;
    EXPECT_EQ(x.optimal_fiber_length_m, y.optimal_fiber_length_m);
    EXPECT_EQ(x.tendon_slack_length_m, y.tendon_slack_length_m);
    EXPECT_EQ(x.pennation_at_optimal_rad, y.pennation_at_optimal_rad);
    EXPECT_EQ(x.control.least, y.control.least) << a.muscles[k].name;
    EXPECT_EQ(a.muscles[k].applies_force, b.muscles[k].applies_force);
  }
  std::mt19937_64 engine(41);
  BodyState one = make_state(a), two = make_state(b);
  PathWorkspace workspace;
  PathResult first, second;
  for (int repeat = 0; repeat < 3; ++repeat) {
    Eigen::VectorXd q = a.default_q();
    for (double& x : q) x += 0.6 * (static_cast<double>(engine() >> 11) * 0x1.0p-53 - 0.5);
    compute_poses(a, q, one);
    compute_poses(b, q, two);
    for (std::size_t k = 0; k < a.bodies.size(); ++k)
      EXPECT_LE((one.X_GB[k].p - two.X_GB[k].p).norm(), digits) << a.bodies[k].name;
    for (std::size_t k = 0; k < a.muscles.size(); ++k) {
      compute_path(a, a.muscles[k].path, one, workspace, first);
      compute_path(b, b.muscles[k].path, two, workspace, second);
      EXPECT_LE(std::abs(first.length_m - second.length_m), digits) << a.muscles[k].name;
    }
  }
}

/// An old document with a bit of everything that has another form by now.
const char* kOld = R"(<OpenSimDocument Version="20302"><Model name="m">
  <defaults><Thelen2003Muscle name="default"><max_isometric_force>321</max_isometric_force>
   <min_control>0</min_control></Thelen2003Muscle></defaults>
  <BodySet><objects>
   <Body name="ground"><WrapObjectSet><objects><WrapSphere name="ball"><radius>0.03</radius>
     <translation>0.2 0.1 0</translation></WrapSphere></objects></WrapObjectSet></Body>
   <Body name="rod"><mass>2</mass><mass_center>0 -0.1 0</mass_center>
    <inertia_xx>0.12345678</inertia_xx><inertia_yy>0.1</inertia_yy><inertia_zz>0.1</inertia_zz>
    <VisibleObject><GeometrySet><objects><DisplayGeometry><geometry_file>rod.vtp</geometry_file>
      <transform>0 0 0.5 1 2 3</transform><scale_factors>2 2 2</scale_factors></DisplayGeometry>
      </objects></GeometrySet><scale_factors>1.5 1 1</scale_factors></VisibleObject>
    <Joint><CustomJoint name="hinge"><parent_body>ground</parent_body>
     <location_in_parent>0.123456789 0 0</location_in_parent>
     <orientation_in_parent>0 0.3 0</orientation_in_parent><location>0 0.2 0</location>
     <orientation>0 0 0</orientation>
     <CoordinateSet><objects><Coordinate name="turn"><motion_type>rotational</motion_type>
       <initial_value>0.25</initial_value><range>-1 1</range></Coordinate></objects></CoordinateSet>
     <SpatialTransform><TransformAxis name="rotation1"><coordinates>turn</coordinates>
       <axis>0 0 1</axis></TransformAxis>
      <TransformAxis name="rotation2"><coordinates></coordinates><axis>0 1 0</axis></TransformAxis>
      <TransformAxis name="rotation3"><coordinates></coordinates><axis>1 0 0</axis></TransformAxis>
      <TransformAxis name="translation1"><function><NaturalCubicSpline><x>-1 0 1 2</x>
        <y>0 0.1 0.15 0.1</y></NaturalCubicSpline></function><coordinates>turn</coordinates>
        <axis>1 0 0</axis></TransformAxis></SpatialTransform></CustomJoint></Joint></Body>
   <Body name="tip"><mass>1</mass><Joint><PinJoint name="back"><parent_body>rod</parent_body>
     <location_in_parent>0 -0.3 0</location_in_parent><location>0.1 0 0</location>
     <CoordinateSet><objects><Coordinate name="bend"><locked>true</locked></Coordinate></objects>
     </CoordinateSet></PinJoint></Joint></Body>
   <Body name="stray"><mass>3</mass></Body>
  </objects></BodySet>
  <ConstraintSet><objects><WeldConstraint name="weld"><isDisabled>true</isDisabled>
     <body_1>rod</body_1><body_2>ground</body_2><location_body_1>1 2 3</location_body_1>
    </WeldConstraint>
    <PointConstraint name="pin"><body_1>ground</body_1><body_2>tip</body_2>
     <location_body_1>0 0 1</location_body_1></PointConstraint>
    <WeldConstraint name="hold"><body_1>tip</body_1><body_2>stray</body_2>
     <location_body_1>1 2 3</location_body_1><orientation_body_2>0.1 0.2 0.3</orientation_body_2>
    </WeldConstraint></objects></ConstraintSet>
  <MarkerSet><objects><Marker name="mark"><body>tip</body><location>0 1 0</location></Marker>
  </objects></MarkerSet>
  <ForceSet><objects><Thelen2003Muscle name="pull"><isDisabled>false</isDisabled>
    <GeometryPath><PathPointSet><objects>
      <PathPoint name="a"><body>ground</body><location>0.5 0.3 0</location></PathPoint>
      <ConditionalPathPoint name="b"><body>rod</body><location>0.05 0 0</location>
        <coordinate>turn</coordinate><range>-1 0.5</range></ConditionalPathPoint>
      <MovingPathPoint name="c"><body>rod</body>
        <x_location><PiecewiseLinearFunction><x>-1 1</x><y>0 0.1</y></PiecewiseLinearFunction>
        </x_location><x_coordinate>turn</x_coordinate></MovingPathPoint>
      <PathPoint name="d"><body>tip</body><location>0 -0.1 0</location></PathPoint></objects>
    </PathPointSet><PathWrapSet><objects><PathWrap name="w"><wrap_object>ball</wrap_object>
    </PathWrap></objects></PathWrapSet></GeometryPath></Thelen2003Muscle>
    <GeneralizedForce name="motor"><isDisabled>true</isDisabled><coordinate>turn</coordinate>
    </GeneralizedForce>
    <BushingForce name="rubber"><body_1>rod</body_1><body_2>tip</body_2>
     <location_body_1>0 1 0</location_body_1><orientation_body_1>0 0 0</orientation_body_1>
     <location_body_2>0 2 0</location_body_2><orientation_body_2>0 0.1 0</orientation_body_2>
     <rotational_stiffness>1 2 3</rotational_stiffness></BushingForce>
    <PointToPointSpring name="coil"><body1>rod</body1><body2>ground</body2><point1>0 0 1</point1>
     <stiffness>5</stiffness></PointToPointSpring></objects></ForceSet>
</Model></OpenSimDocument>)";

TEST(UpdatedOsim, HoldsTheSameModelInTheNewestForm) {
  const BodyModel old = parse_osim(kOld, "old.osim");
  const UpdatedOsim updated = updated_osim(kOld, "old.osim");
  EXPECT_EQ(updated.old_version, 20302);
  const BodyModel model = parse_osim(updated.text, "new.osim");
  EXPECT_EQ(model.document_version, kNewestOsimVersion);
  expect_same(old, model);
  EXPECT_EQ(model.muscles[0].properties.max_isometric_force_n, 321.0);
  EXPECT_EQ(model.muscles[0].properties.control.least, 0.01);
  for (const char* gone : {"isDisabled", "parent_body", "VisibleObject", "inertia_xx", "<defaults",
                           "NaturalCubicSpline", "<Joint>", "motion_type", "<body>"})
    EXPECT_EQ(updated.text.find(gone), std::string::npos) << gone;
  for (const char* there :
       {"<Ground name=\"ground\">", "<BodySet name=\"bodyset\">", "<ForceSet name=\"forceset\">",
        "<mesh_file>rod.vtp</mesh_file>", "<scale_factors>3 2 2</scale_factors>", "<isEnforced>false</isEnforced>",
        "<socket_parent_frame>/bodyset/tip</socket_parent_frame>"})
    EXPECT_NE(updated.text.find(there), std::string::npos) << there;
}

TEST(BringToNewestForm, AFaultKeepsTheLineAndTheNameThatTheFileHas) {
  const std::pair<const char*, const char*> faults[] = {{"<location_in_parent>", "0.123456789 0 0"},
                                                        {"<inertia_xx>", "0.12345678"},
                                                        {"<initial_value>", "0.25"},
                                                        {"<isDisabled>", "false"},
                                                        {"<orientation_body_2>", "0.1 0.2 0.3"}};
  for (const auto& [element, value] : faults) {
    std::string text = kOld;
    const std::size_t at = text.find(element + std::string(value));
    ASSERT_NE(at, std::string::npos) << element;
    text.replace(at + std::string_view(element).size(), std::string_view(value).size(), "one");
    try {
      (void)parse_osim(text, "old.osim");
      FAIL() << element;
    } catch (const ReadError& error) {
      EXPECT_EQ(error.line(), line_at(text, at)) << error.what();
      EXPECT_NE(std::string(error.what()).find(element), std::string::npos) << error.what();
    }
  }
}

TEST(BringToNewestForm, OldJointsOfOneNameKeepTheirPlaces) {
  std::string bodies;
  for (const char* body : {"left", "right"})
    bodies += fmt::format(
        "<Body name=\"{0}\"><mass>1</mass><inertia_xx>1</inertia_xx><Joint><PinJoint name=\"hinge\">"
        "<parent_body>ground</parent_body><location_in_parent>0 0 {1}</location_in_parent><CoordinateSet><objects>"
        "<Coordinate name=\"{0}_angle\"/></objects></CoordinateSet></PinJoint></Joint></Body>",
        body, body[0] == 'l' ? -1 : 1);
  const BodyModel model = parse_osim("<OpenSimDocument Version=\"20302\"><Model name=\"m\"><BodySet><objects>" +
                                         bodies + "</objects></BodySet></Model></OpenSimDocument>",
                                     "old.osim");
  ASSERT_EQ(model.joints.size(), 2U);
  EXPECT_EQ(model.joints[0].X_PF.p, Vec3(0.0, 0.0, -1.0));
  EXPECT_EQ(model.joints[1].X_PF.p, Vec3(0.0, 0.0, 1.0));
}

// What is in the newest form stays so: a second update changes nothing.
TEST(UpdatedOsim, IsUpdatedOnce) {
  const UpdatedOsim once = updated_osim(kOld, "old.osim");
  const UpdatedOsim twice = updated_osim(once.text, "new.osim");
  EXPECT_EQ(once.text, twice.text);
  EXPECT_EQ(twice.old_version, kNewestOsimVersion);
  EXPECT_TRUE(twice.notes.empty());
}

TEST(UpdatedOsim, RoundsToSixDigitsAsOpensimWhereAsked) {
  const UpdatedOsim rounded = updated_osim(kOld, "old.osim", {.six_digits = true});
  EXPECT_NE(rounded.text.find("<translation>0.123457 0 0</translation>"), std::string::npos);
  expect_same(parse_osim(kOld, "old.osim", {.compat = kOpenSim452}),
              parse_osim(rounded.text, "new.osim", {.compat = kOpenSim452}));
}

TEST(UpdatedOsim, UpdatesSetUpsAndSets) {
  const std::string tool = updated_osim(
                               "<AnalyzeTool name=\"a\"><actuator_set_files>x.xml</actuator_set_files>"
                               "<replace_actuator_set>true</replace_actuator_set></AnalyzeTool>",
                               "s.xml")
                               .text;
  EXPECT_NE(tool.find("<OpenSimDocument Version=\"40500\">"), std::string::npos) << tool;
  EXPECT_NE(tool.find("<force_set_files>x.xml</force_set_files>"), std::string::npos);
  EXPECT_NE(tool.find("<replace_force_set>true</replace_force_set>"), std::string::npos);
  const std::string set = updated_osim(
                              "<OpenSimDocument Version=\"20302\"><ForceSet><objects><CoordinateActuator name=\"r\">"
                              "<isDisabled>false</isDisabled><coordinate>q</coordinate></CoordinateActuator></objects>"
                              "</ForceSet></OpenSimDocument>",
                              "r.xml")
                              .text;
  EXPECT_NE(set.find("<appliesForce>true</appliesForce>"), std::string::npos);
  const std::string controller =
      updated_osim(
          "<OpenSimDocument Version=\"20302\"><ForwardTool><ControllerSet><objects>"
          "<ControlSetController><isDisabled>true</isDisabled></ControlSetController></objects>"
          "</ControllerSet></ForwardTool></OpenSimDocument>",
          "f.xml")
          .text;
  EXPECT_NE(controller.find("<enabled>false</enabled>"), std::string::npos) << controller;
  EXPECT_THROW((void)updated_osim("no xml", "n.xml"), ReadError);
}

// Every public model: the reader makes the same of the old and of the updated document, and
// OpenSim's own conversion of it, where that is there, differs by the digits that OpenSim writes.
TEST(UpdatedOsim, IsTheSameForEveryPublicModel) {
  const auto folder = test::data_folder();
  MYOID_REQUIRE_DATA(folder / "opensim");
  MYOID_REQUIRE_DATA(folder / "opensim-refused");
  int count = 0, compared = 0;
  for (const char* part : {"opensim", "opensim-refused"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / part)) {
      if (entry.path().extension() != ".osim") continue;
      SCOPED_TRACE(entry.path().string());
      const std::string text = read_text_file(entry.path());
      BodyModel old;
      try {
        old = parse_osim(text, entry.path());
      } catch (const InvalidInput&) {
        continue;  // the reader has tests of its own
      }
      const UpdatedOsim updated = updated_osim(text, entry.path());
      expect_same(old, parse_osim(updated.text, entry.path()));
      ++count;
      if (entry.path().filename() != "model.osim" || old.document_version >= 30500) continue;
      for (const auto& theirs :
           {entry.path().parent_path() / "model_v4.osim", entry.path().parent_path() / "opensim" / "model_v4.osim"}) {
        if (!std::filesystem::exists(theirs)) continue;
        const UpdatedOsim rounded = updated_osim(text, entry.path(), {.six_digits = true});
        // OpenSim writes the points of functions with six digits: 1e-6 rad moves what they place.
        expect_same(parse_osim(rounded.text, entry.path()), read_osim(theirs), 1e-5);
        ++compared;
      }
    }
  }
  EXPECT_GT(count, 10);
  EXPECT_GT(compared, 1);
}

}  // namespace
}  // namespace myoid::body
