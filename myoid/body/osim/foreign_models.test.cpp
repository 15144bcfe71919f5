// Models as others write them: what OpenSim opens, opens.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/constraints.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/body/osim/osim_frames.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"

namespace myoid::body {
namespace {

using ::testing::HasSubstr;

std::string in_model(const std::string& content, int version = 40000) {
  return fmt::format("<OpenSimDocument Version=\"{}\"><Model name=\"m\">{}</Model></OpenSimDocument>", version,
                     content);
}

std::string body(const std::string& name, double mass_kg) {
  return fmt::format(
      "<Body name=\"{}\"><mass>{}</mass><mass_center>0 -0.1 0</mass_center><inertia>{} {} {} 0 0 0"
      "</inertia></Body>",
      name, mass_kg, 0.01 * mass_kg, 0.01 * mass_kg, 0.01 * mass_kg);
}

std::string pin(const std::string& name,
                const std::string& parent,
                const std::string& child,
                const std::string& coordinate) {
  return "<PinJoint name=\"" + name + "\"><socket_parent_frame>" + parent +
         "</socket_parent_frame><socket_child_frame>" + child +
         "</socket_child_frame><coordinates><Coordinate name=\"" + coordinate + "\"/></coordinates></PinJoint>";
}

std::string chain(double end_mass_kg) {
  return in_model("<BodySet><objects>" + body("upper", 2.0) + body("hand", end_mass_kg) +
                  "</objects></BodySet><JointSet><objects>" + pin("shoulder", "/ground", "/bodyset/upper", "q1") +
                  pin("wrist", "/bodyset/upper", "/bodyset/hand", "q2") + "</objects></JointSet>");
}

Eigen::VectorXd moments(const BodyModel& m) {
  BodyState state = make_state(m);
  const Eigen::Vector2d q(0.4, -0.7), qdot(1.5, -2.0), qddot(3.0, 4.0);
  return inverse_dynamics(m, q, qdot, qddot, {}, state);
}

// A body of 1e-9 kg differs from none by moments of the order of 1e-9 kg m (g + qddot) m.
TEST(ForeignModels, AnEndWithoutMassMovesAndNeedsNoMoment) {
  const Eigen::VectorXd none = moments(parse_osim(chain(0.0), "m.osim"));
  const Eigen::VectorXd little = moments(parse_osim(chain(1e-9), "m.osim"));
  EXPECT_LT((none - little).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_EQ(none[1], 0.0);
  EXPECT_GT(std::abs(none[0]), 0.1);
}

/// Numbers of a model that its elements decide.
std::string digest(const std::string& xml) {
  try {
    const BodyModel m = parse_osim(xml, "m.osim");
    BodyState state = make_state(m);
    compute_poses(m, m.default_q(), state);
    std::ostringstream text;
    text.precision(17);
    for (const Marker& marker : m.markers)
      text << (state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM).transpose() << '\n';
    for (const Body& b : m.bodies) text << b.name << b.mass_kg << b.p_BBcm_B.transpose() << b.I_BBcm_B << '\n';
    for (const Coordinate& c : m.coordinates)
      text << c.name << c.default_value << ' ' << c.lower << ' ' << c.upper << c.clamped << c.locked;
    PathWorkspace workspace;
    PathResult path;
    for (const Muscle& muscle : m.muscles) {
      const MuscleProperties& p = muscle.properties;
      for (const double v : {p.max_isometric_force_n, p.optimal_fiber_length_m, p.tendon_slack_length_m,
                             p.pennation_at_optimal_rad, p.max_contraction_velocity, p.control.least, p.control.most,
                             p.default_fiber_length_m, p.activation_time_s, p.concentric_shape})
        text << v << ' ';
      compute_path(m, muscle.path, state, workspace, path);
      text << path.length_m << '\n';
    }
    return text.str();
  } catch (const InvalidInput& error) {
    return error.what();
  }
}

// Whatever the element: without content it counts as absent.
TEST(ForeignModels, AnEmptyElementIsAnAbsentOne) {
  const std::string text = arm4_osim();
  const std::regex element(R"(<(\w+)>([^<>]*)</\1>)");
  std::set<std::string> seen;
  for (std::sregex_iterator it(text.begin(), text.end(), element), end; it != end; ++it) {
    const std::string name = (*it)[1];
    if (!seen.insert(name).second) continue;
    const auto at = static_cast<std::size_t>(it->position());
    const auto size = static_cast<std::size_t>(it->length());
    // The line of an error may differ by nothing: both keep the text's lines.
    std::string absent = text, empty = text, blank = text;
    absent.replace(at, size, "");
    empty.replace(at, size, "<" + name + "/>");
    blank.replace(at, size, "<" + name + "> <!-- none --> </" + name + ">");
    EXPECT_EQ(digest(empty), digest(absent)) << name;
    EXPECT_EQ(digest(blank), digest(absent)) << name;
  }
  EXPECT_GT(seen.size(), 15U);
}

TEST(ForeignModels, ConnectorsOfBetasNameTheBodiesOfAJoint) {
  const auto connector = [](const std::string& name, const std::string& target) {
    return "<Connector_PhysicalFrame_ name=\"" + name + "\"><connectee_name>" + target +
           "</connectee_name></Connector_PhysicalFrame_>";
  };
  const BodyModel m =
      parse_osim(in_model("<BodySet><objects>" + body("rod", 1.0) +
                              "</objects></BodySet><FrameSet><objects><PhysicalOffsetFrame name=\"tip\">"
                              "<connectors>" +
                              connector("parent", "rod") +
                              "</connectors><translation>0 -0.5 0</translation></PhysicalOffsetFrame>"
                              "</objects></FrameSet><JointSet><objects><PinJoint name=\"pin\"><connectors>" +
                              connector("parent_body", "../ground") + connector("child_body", "../rod") +
                              "</connectors><location_in_child>0 0.5 0</location_in_child><CoordinateSet>"
                              "<objects><Coordinate name=\"q\"/></objects></CoordinateSet></PinJoint></objects>"
                              "</JointSet><MarkerSet><objects><Marker name=\"end\"><connectors>" +
                              connector("parent_frame", "tip") + "</connectors></Marker></objects></MarkerSet>",
                          30501),
                 "m.osim");
  BodyState state = make_state(m);
  compute_poses(m, Eigen::VectorXd::Zero(1), state);
  const Vec3 end = state.X_GB[1] * m.markers.at(0).p_BM;
  EXPECT_LT((end - Vec3(0.0, -1.0, 0.0)).norm(), 1e-15);
}

TEST(ForeignModels, BodiesJointsMarkersAndConstraintsMayStandAmongTheComponents) {
  const std::string text =
      in_model("<components>" + body("upper", 2.0) + body("hand", 0.5) + pin("shoulder", "/ground", "/upper", "q1") +
                   pin("wrist", "/upper", "/hand", "q2") +
                   "<Marker name=\"k\"><socket_parent_frame>/hand</socket_parent_frame><location>0 0.1 0"
                   "</location></Marker><CoordinateCouplerConstraint "
                   "name=\"c\"><coupled_coordinates_function>"
                   "<LinearFunction><coefficients>2 0</coefficients></LinearFunction>"
                   "</coupled_coordinates_function><independent_coordinate_names>q1"
                   "</independent_coordinate_names><dependent_coordinate_name>q2</dependent_coordinate_name>"
                   "</CoordinateCouplerConstraint><Bhargava2004SmoothedMuscleMetabolics name=\"cost\"/>"
                   "</components>",
               40600);
  const BodyModel m = parse_osim(text, "m.osim");
  EXPECT_TRUE(m.muscles.empty());
  ASSERT_EQ(m.couplers.size(), 1U);
  ASSERT_EQ(m.markers.size(), 1U);
  BodyModel free = m;
  free.couplers.clear();
  EXPECT_EQ(moments(free), moments(parse_osim(chain(0.5), "m.osim")));
}

TEST(ForeignModels, CoordinatesOfOneNameAreToldApartByTheirJoints) {
  const std::string text = in_model(
      "<BodySet><objects>" + body("upper", 2.0) + body("hand", 0.5) + "</objects></BodySet><JointSet><objects>" +
      pin("shoulder", "/ground", "/bodyset/upper", "r") + pin("wrist", "/bodyset/upper", "/bodyset/hand", "r") +
      "</objects></JointSet><ConstraintSet><objects><CoordinateCouplerConstraint name=\"c\">"
      "<coupled_coordinates_function><LinearFunction><coefficients>2 0</coefficients>"
      "</LinearFunction></coupled_coordinates_function><independent_coordinate_names>"
      "/jointset/shoulder/r</independent_coordinate_names><dependent_coordinate_name>"
      "/jointset/wrist/r</dependent_coordinate_name></CoordinateCouplerConstraint></objects>"
      "</ConstraintSet>");
  const BodyModel m = parse_osim(text, "m.osim");
  EXPECT_EQ(m.find_coordinate("shoulder_r"), 0);
  EXPECT_EQ(m.find_coordinate("/jointset/shoulder/r"), 0);
  EXPECT_EQ(m.find_coordinate("wrist/r"), 1);
  EXPECT_EQ(m.find_coordinate("r"), std::nullopt);
  ASSERT_EQ(m.couplers.size(), 1U);
  EXPECT_EQ(m.couplers[0].dependent, 1);
  EXPECT_THAT(sentences(m.notes), ::testing::Contains(HasSubstr("2 joints have a coordinate 'r'")));
  // Without the joint, the first is meant.
  std::string bare = text;
  bare.replace(bare.find("/jointset/shoulder/r"), 20, "r");
  EXPECT_EQ(parse_osim(bare, "m.osim").couplers.at(0).independent, 0);
}

TEST(ForeignModels, OfTwoForcesWithOneNameTheModelsOwnActs) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "reserves.xml")
      << "<OpenSimDocument Version=\"40000\"><ForceSet><objects>"
         "<CoordinateActuator name=\"biceps\"><coordinate>elbow_flexion</coordinate>"
         "</CoordinateActuator><CoordinateActuator name=\"new\"><coordinate>elbow_flexion"
         "</coordinate><optimal_force>3</optimal_force></CoordinateActuator>"
         "<CoordinateActuator name=\"new\"><coordinate>elbow_flexion</coordinate>"
         "<optimal_force>5</optimal_force></CoordinateActuator></objects></ForceSet>"
         "</OpenSimDocument>";
  BodyModel arm = parse_osim(arm4_osim(), "arm4.osim");
  arm.muscles[0].name = arm.force_order[0] = "biceps";
  const BodyModel m = with_force_set(arm, folder / "reserves.xml");
  EXPECT_EQ(m.muscles.size(), arm.muscles.size());
  ASSERT_EQ(m.actuators.size(), arm.actuators.size() + 1);
  EXPECT_EQ(m.actuators.back().optimal_force, 3.0);
  EXPECT_THAT(m.notes.back().says, HasSubstr("'biceps', 'new'"));
}

// ActivationFiberLengthMuscle, Thelen2003Muscle and Millard2012EquilibriumMuscle construct their
// default_fiber_length from the class's optimal length, 0.1 m, before the file is read.
TEST(ForeignModels, WithoutADefaultFiberLengthOpenSimTakesTheClassesTenCentimeters) {
  std::string text = arm4_osim();
  text = std::regex_replace(text, std::regex("<default_fiber_length>[^<]*</default_fiber_length>"), "");
  const BodyModel exact = parse_osim(text, "m.osim");
  const BodyModel opensim = parse_osim(text, "m.osim", {.compat = kOpenSim452});
  for (std::size_t i = 0; i < exact.muscles.size(); ++i) {
    EXPECT_EQ(exact.muscles[i].properties.default_fiber_length_m, exact.muscles[i].properties.optimal_fiber_length_m);
    EXPECT_EQ(opensim.muscles[i].properties.default_fiber_length_m, 0.1);
  }
}

TEST(ForeignModels, FramesAreFoundByTheirPaths) {
  const test::TemporaryFolder folder;
  const auto path = folder / "m.osim";
  std::ofstream(path) << in_model(
      "<BodySet><objects>" + body("rod", 1.0) +
      "</objects></BodySet><JointSet><objects><PinJoint name=\"pin\"><socket_parent_frame>/ground"
      "</socket_parent_frame><socket_child_frame>rod_offset</socket_child_frame><coordinates>"
      "<Coordinate name=\"q\"/></coordinates><frames><PhysicalOffsetFrame name=\"rod_offset\">"
      "<socket_parent>/bodyset/rod</socket_parent><translation>0 0.5 0</translation>"
      "</PhysicalOffsetFrame></frames></PinJoint></objects></JointSet>");
  const BodyModel m = read_osim(path);
  for (const char* name : {"/jointset/pin/rod_offset", "pin/rod_offset", "jointset/pin/rod_offset"}) {
    const auto frame = find_frame(m, path, name);
    ASSERT_TRUE(frame) << name;
    EXPECT_EQ(frame->body, 1);
    EXPECT_EQ(frame->X_BF.p, Vec3(0.0, 0.5, 0.0));
  }
  EXPECT_FALSE(find_frame(m, path, "pin/none"));
}

TEST(ForeignModels, OpenAndMoveAsFarAsTheyAreInTheDataFolder) {
  const auto folder = test::data_folder() / "opensim-refused";
  MYOID_REQUIRE_DATA(folder);
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    for (const Compat& compat : {Compat{}, kOpenSim452}) {
      const BodyModel m = read_osim(entry.path(), {.compat = compat});
      BodyState state = make_state(m);
      const Eigen::VectorXd q = assemble(m, m.default_q()).q;
      const Eigen::VectorXd rest = Eigen::VectorXd::Zero(q.size());
      EXPECT_TRUE(inverse_dynamics(m, q, rest, rest, {}, state).allFinite()) << entry.path();
      EXPECT_GT(m.bodies.size(), 1U) << entry.path();
    }
  }
}

}  // namespace
}  // namespace myoid::body
