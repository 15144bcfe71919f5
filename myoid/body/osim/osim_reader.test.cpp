#include "myoid/body/osim/osim_reader.h"

#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/constraints.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/ground/core/error.h"
#include "myoid/recording/tables/storage_reader.h"

#include "tests/support/data_folder.h"
#include "tests/support/message_of.h"

namespace myoid::body {
namespace {

std::string message_of(const std::string& xml) {
  return test::message_of([&] { (void)parse_osim(xml, "m.osim"); });
}

TEST(ParseOsim, TakesTwoDotsForTheComponentThatHoldsAFrame) {
  const BodyModel m = parse_osim(
      R"(<OpenSimDocument Version="40000"><Model name="m">
<BodySet><objects><Body name="b"><mass>1</mass><inertia>1 1 1 0 0 0</inertia>
<components><PhysicalOffsetFrame name="f"><socket_parent>..</socket_parent>
<translation>0 0 0.5</translation></PhysicalOffsetFrame></components></Body></objects></BodySet>
<JointSet><objects><WeldJoint name="j"><socket_parent_frame>/ground</socket_parent_frame>
<socket_child_frame>/bodyset/b</socket_child_frame></WeldJoint></objects></JointSet>
<MarkerSet><objects><Marker name="k"><socket_parent_frame>/bodyset/b/f</socket_parent_frame>
<location>0.1 0 0</location></Marker></objects></MarkerSet></Model></OpenSimDocument>)",
      "m.osim");
  ASSERT_EQ(m.markers.size(), 1U);
  EXPECT_EQ(m.markers[0].body, 1);
  EXPECT_EQ(m.markers[0].p_BM, Vec3(0.1, 0.0, 0.5));
}

TEST(ParseOsim, ReadsOurOwnArm) {
  const BodyModel m = parse_osim(arm4_osim({}), "arm4.osim");
  EXPECT_EQ(m.muscles.size(), 4U);
  EXPECT_TRUE(m.find_coordinate("elbow_flexion").has_value());
  EXPECT_TRUE(m.find_marker("r_styloid_radial").has_value());
  EXPECT_TRUE(m.unsupported.empty());
}

TEST(ParseOsim, RefusesWhatIsNoModelWithTheRemedy) {
  EXPECT_NE(message_of("<OpenSimDocument Version=\"40000\"><Mod").find("not valid XML"), std::string::npos);
  EXPECT_NE(message_of("<html></html>").find("not an OpenSim file"), std::string::npos);
  EXPECT_NE(message_of("<OpenSimDocument Version=\"10500\"><Model/></OpenSimDocument>").find("save it again"),
            std::string::npos);
  EXPECT_NE(message_of("<OpenSimDocument Version=\"40000\">\n<Model>\n<BodySet><objects>\n<Body "
                       "name=\"b\"><mass>x</mass></Body></objects></BodySet></Model></OpenSimDocument>")
                .find("m.osim:4: <mass>: expected numbers, found 'x'"),
            std::string::npos);
}

/// Marker locations of OpenSim along a motion; the greatest distance to ours [m].
double worst_marker_error(const std::string& folder, const std::string& motion) {
  const auto root = test::data_folder() / "opensim" / folder;
  const BodyModel m = read_osim(root / "model.osim");
  const recording::Storage q_file = recording::read_storage(root / "opensim" / (motion + "_Kinematics_q.sto"));
  const recording::Storage reference = recording::read_storage(root / "opensim" / (motion + "_OutputsVec3.sto"));
  const TimeSeries q = recording::to_si(q_file, [&](const std::string& name) {
    const auto c = m.find_coordinate(name);
    return c && m.coordinates[static_cast<std::size_t>(*c)].motion == MotionType::rotational;
  });
  BodyState state = make_state(m);
  double worst = 0.0;
  for (Eigen::Index row = 0; row < q.sample_count(); ++row) {
    Eigen::VectorXd posture = m.default_q();
    for (std::size_t c = 0; c < m.coordinates.size(); ++c) {
      if (const auto column = q.find(m.coordinates[c].name))
        posture[static_cast<Eigen::Index>(c)] = q.values()(row, *column);
    }
    compute_poses(m, posture, state);
    for (const Marker& marker : m.markers) {
      const Vec3 p = state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM;
      for (int k = 0; k < 3; ++k) {
        const auto column = reference.data.find("/markerset/" + marker.name + "|location_" + std::to_string(k + 1));
        if (column) worst = std::max(worst, std::abs(reference.data.values()(row, *column) - p[k]));
      }
    }
  }
  return worst;
}

/// The built-in arm with a piece of its text replaced.
std::string arm_replacing(const std::string& old, const std::string& piece) {
  std::string text = arm4_osim();
  const auto at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  return text.replace(at, old.size(), piece);
}

TEST(ParseOsim, OpenNumbersOfMillardsCurvesAreTheClasss) {
  const auto curves = [](const std::string& fiber, const std::string& tendon) {
    std::string text = arm4_osim();
    const std::string old = "Thelen2003Muscle", kind = "Millard2012EquilibriumMuscle";
    for (auto at = text.find(old); at != std::string::npos; at = text.find(old, at + 1))
      text.replace(at, old.size(), kind);
    text.insert(text.find("</" + kind), "<FiberForceLengthCurve>" + fiber + "</FiberForceLengthCurve>" +
                                            "<TendonForceLengthCurve>" + tendon + "</TendonForceLengthCurve>");
    return std::get<MillardCurves>(parse_osim(text, "arm.osim").muscles.at(0).properties.curves);
  };
  const MillardCurves open = curves("<stiffness_at_one_norm_force>-1</stiffness_at_one_norm_force>", "");
  EXPECT_FALSE(open.passive_stiffness_at_one);
  EXPECT_EQ(open.shape.tendon.toe_force, 2.0 / 3.0);
  EXPECT_EQ(open.shape.active.minimum, 0.1);
  const MillardCurves given = curves("<stiffness_at_one_norm_force>7</stiffness_at_one_norm_force>",
                                     "<strain_at_one_norm_force>0.05</strain_at_one_norm_force>"
                                     "<stiffness_at_one_norm_force>30</stiffness_at_one_norm_force>"
                                     "<norm_force_at_toe_end>0.6</norm_force_at_toe_end>");
  EXPECT_EQ(given.passive_stiffness_at_one, 7.0);
  EXPECT_DOUBLE_EQ(given.shape.tendon.stiffness_at_one, 30.0 * 0.05);  // per e0
  EXPECT_EQ(given.shape.tendon.toe_force, 0.6);
}

// In OpenSim the least control of a muscle is 0, but for the classes that need an activation.
TEST(ParseOsim, TheLeastControlIsThatOfTheMusclesClass) {
  const auto least = [](const char* kind) {
    std::string text = arm4_osim();
    for (auto at = text.find("Thelen2003Muscle"); at != std::string::npos; at = text.find("Thelen2003Muscle", at + 1))
      text.replace(at, 16, kind);
    return parse_osim(text, "arm.osim").muscles.at(0).properties.control.least;
  };
  EXPECT_EQ(least("Thelen2003Muscle"), 0.01);
  EXPECT_EQ(least("Millard2012EquilibriumMuscle"), 0.01);
  EXPECT_EQ(least("DeGrooteFregly2016Muscle"), 0.0);
  EXPECT_EQ(least("Schutte1993Muscle_Deprecated"), 0.0);
  EXPECT_EQ(least("RigidTendonMuscle"), 0.0);
}

TEST(ParseOsim, MarkersMayStandInAFileOfTheirOwn) {
  const auto folder = std::filesystem::temp_directory_path() / "myoid_markers_apart";
  std::filesystem::create_directories(folder / "sets");
  std::ofstream(folder / "sets/m.xml")
      << "<OpenSimDocument Version=\"40000\"><MarkerSet><objects><Marker name=\"apart\">"
         "<socket_parent_frame>/bodyset/forearm_hand</socket_parent_frame>"
         "<location>0.1 0.2 0.3</location></Marker></objects></MarkerSet></OpenSimDocument>";
  const std::string text = arm4_osim();
  const auto begin = text.find("<MarkerSet"), end = text.find("</MarkerSet>");
  ASSERT_NE(end, std::string::npos);
  const BodyModel m = parse_osim(text.substr(0, begin) + "<MarkerSet file=\"sets\\m.xml\"/>" + text.substr(end + 12),
                                 folder / "arm.osim");
  ASSERT_EQ(m.markers.size(), 1U);
  EXPECT_EQ(m.markers[0].name, "apart");
  EXPECT_EQ(m.markers[0].p_BM, Vec3(0.1, 0.2, 0.3));
  EXPECT_EQ(m.bodies[static_cast<std::size_t>(m.markers[0].body)].name, "forearm_hand");
  EXPECT_TRUE(m.unsupported.empty());
  std::filesystem::remove_all(folder);
}

TEST(ParseOsim, CouplersByPolynomialsAndSplinesOfOneVariable) {
  const auto coupled = [](const std::string& function) {
    const BodyModel m =
        parse_osim(arm_replacing("</Model>",
                                 "<ConstraintSet><objects><CoordinateCouplerConstraint name=\"c\">"
                                 "<coupled_coordinates_function>" +
                                     function +
                                     "</coupled_coordinates_function><independent_coordinate_names>elbow_flexion"
                                     "</independent_coordinate_names><dependent_coordinate_name>shoulder_rotation"
                                     "</dependent_coordinate_name><scale_factor>2</scale_factor>"
                                     "</CoordinateCouplerConstraint></objects></ConstraintSet></Model>"),
                   "arm.osim");
    EXPECT_EQ(m.couplers.size(), 1U);
    return evaluate(m.couplers.at(0).function, 0.5).value;
  };
  // Lowest power first: 2 (1 + 2 x + 3 x^2) at 0.5.
  EXPECT_NEAR(coupled("<MultivariatePolynomialFunction><dimension>1</dimension><order>2</order>"
                      "<coefficients>1 2 3</coefficients></MultivariatePolynomialFunction>"),
              2.0 * 2.75, 1e-14);
  EXPECT_NEAR(coupled("<GCVSpline><half_order>1</half_order><x>0 1</x><y>1 3</y></GCVSpline>"), 4.0, 1e-14);
  EXPECT_NEAR(coupled("<PiecewiseLinearFunction><x>0 1 2</x><y>0 2 2</y></PiecewiseLinearFunction>"), 2.0, 1e-14);
}

// A point that moves in a frame turned and shifted against the body of a hinge: length by hand,
// moment arm as its derivative.
TEST(ParseOsim, AMovingPointMayLieInAnOffsetFrame) {
  for (const Compat& compat : {Compat{}, kOpenSim452}) {
    const BodyModel m = parse_osim(
        R"(<OpenSimDocument Version="40000"><Model name="m">
<BodySet><objects><Body name="b"><components><PhysicalOffsetFrame name="f"><socket_parent>..</socket_parent>
<translation>0.1 0.2 0</translation><orientation>0 0 0.5</orientation></PhysicalOffsetFrame></components>
<mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet>
<JointSet><objects><PinJoint name="hinge">
<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/b</socket_child_frame>
<coordinates><Coordinate name="q"/></coordinates></PinJoint></objects></JointSet>
<ForceSet><objects><Thelen2003Muscle name="muscle"><GeometryPath name="geometrypath"><PathPointSet><objects>
<PathPoint name="p1"><socket_parent_frame>/ground</socket_parent_frame><location>0 0.5 0.1</location></PathPoint>
<MovingPathPoint name="p2"><socket_parent_frame>/bodyset/b/f</socket_parent_frame>
<socket_x_coordinate>/jointset/hinge/q</socket_x_coordinate><socket_y_coordinate>/jointset/hinge/q</socket_y_coordinate>
<socket_z_coordinate>/jointset/hinge/q</socket_z_coordinate>
<x_location><LinearFunction><coefficients>0.1 0.3</coefficients></LinearFunction></x_location>
<y_location><Constant><value>0.05</value></Constant></y_location>
<z_location><Constant><value>0</value></Constant></z_location></MovingPathPoint>
</objects></PathPointSet></GeometryPath></Thelen2003Muscle></objects></ForceSet></Model></OpenSimDocument>)",
        "m.osim", {.compat = compat});
    EXPECT_TRUE(m.unsupported.empty());
    const auto length = [](double q) {
      const auto turned = [](double a, const Vec3& p) {
        return Vec3(std::cos(a) * p.x() - std::sin(a) * p.y(), std::sin(a) * p.x() + std::cos(a) * p.y(), p.z());
      };
      const Vec3 in_body = Vec3(0.1, 0.2, 0.0) + turned(0.5, Vec3(0.1 * q + 0.3, 0.05, 0.0));
      return (turned(q, in_body) - Vec3(0.0, 0.5, 0.1)).norm();
    };
    BodyState state = make_state(m);
    for (const double q : {-0.8, 0.0, 1.1}) {
      compute_poses(m, Eigen::VectorXd::Constant(1, q), state);
      compute_velocities(m, Eigen::VectorXd::Constant(1, 2.0), state);
      const PathResult path = compute_path(m, 0, state);
      const double slope = (length(q + 1e-5) - length(q - 1e-5)) / 2e-5;
      EXPECT_NEAR(path.length_m, length(q), 1e-15);
      EXPECT_NEAR(path.moment_arm_m[0], -slope, 1e-10);  // h^2 and round-off over h
      EXPECT_NEAR(path.speed_mps, 2.0 * slope, 1e-9);
    }
  }
}

TEST(ParseOsim, APathMayBeAPolynomialOfCoordinates) {
  const auto hinges = [](const std::string& path) {
    return parse_osim(
        R"(<OpenSimDocument Version="40500"><Model name="m">
<BodySet><objects><Body name="b"><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet>
<JointSet><objects><UniversalJoint name="hinge">
<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/b</socket_child_frame>
<coordinates><Coordinate name="p"/><Coordinate name="q"/></coordinates></UniversalJoint></objects></JointSet>
<ForceSet><objects><Thelen2003Muscle name="muscle"><path><FunctionBasedPath name="path">
<coordinates>/jointset/hinge/q /jointset/hinge/p</coordinates>)" +
            path + R"(</FunctionBasedPath></path></Thelen2003Muscle></objects></ForceSet></Model></OpenSimDocument>)",
        "m.osim");
  };
  const std::string length =
      "<length_function><MultivariatePolynomialFunction><coefficients>0.3 0.1 0.05 0.2 0.4 0.6"
      "</coefficients><dimension>2</dimension><order>2</order></MultivariatePolynomialFunction>"
      "</length_function>";
  const BodyModel m = hinges(length);
  EXPECT_TRUE(m.unsupported.empty());
  BodyState state = make_state(m);
  const double p = 0.2, q = -0.5;
  compute_poses(m, Eigen::Vector2d(p, q), state);
  compute_velocities(m, Eigen::Vector2d(1.5, 2.5), state);
  const PathResult path = compute_path(m, 0, state);
  EXPECT_NEAR(path.length_m, 0.3 + 0.1 * p + 0.05 * p * p + 0.2 * q + 0.4 * q * p + 0.6 * q * q, 1e-15);
  EXPECT_NEAR(path.moment_arm_m[0], -(0.1 + 0.1 * p + 0.4 * q), 1e-15);
  EXPECT_NEAR(path.moment_arm_m[1], -(0.2 + 0.4 * p + 1.2 * q), 1e-15);
  EXPECT_NEAR(path.speed_mps, -path.moment_arm_m.dot(Eigen::Vector2d(1.5, 2.5)), 1e-15);
  // Moment arms of their own count as they are.
  const std::string constant =
      "<MultivariatePolynomialFunction><coefficients>0.07</coefficients><dimension>2</dimension>"
      "<order>0</order></MultivariatePolynomialFunction>";
  const BodyModel own = hinges(length + "<moment_arm_functions>" + constant + constant + "</moment_arm_functions>");
  EXPECT_EQ(compute_path(own, 0, state).moment_arm_m, Eigen::Vector2d(0.07, 0.07));
  // What cannot be computed is named, and left out.
  const BodyModel other = hinges("<length_function><SimmSpline/></length_function>");
  ASSERT_EQ(other.unsupported.size(), 1U);
  EXPECT_TRUE(other.muscles.empty());
  EXPECT_THROW((void)hinges(length + "<moment_arm_functions>" + constant + "</moment_arm_functions>"), ReadError);
}

TEST(ParseOsim, AConstantCurvatureJointBendsARod) {
  const BodyModel m = parse_osim(
      R"(<OpenSimDocument Version="40000"><Model name="m">
<BodySet><objects><Body name="b"><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet>
<JointSet><objects><ConstantCurvatureJoint name="spine">
<socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>/bodyset/b</socket_child_frame>
<coordinates><Coordinate name="x"/><Coordinate name="z"/><Coordinate name="y"/></coordinates>
<neutral_angle_x_z_y>0.1 0 0</neutral_angle_x_z_y><length>0.4</length>
</ConstantCurvatureJoint></objects></JointSet></Model></OpenSimDocument>)",
      "m.osim");
  EXPECT_TRUE(m.unsupported.empty());
  EXPECT_EQ(m.coordinates[0].motion, MotionType::rotational);
  BodyState state = make_state(m);
  // Bent about x by 0.5 rad, then twisted about its own y.
  compute_poses(m, Eigen::Vector3d(0.4, 0.0, 0.7), state);
  const Pose& pose = state.X_GB[1];
  EXPECT_LT((pose.p - 0.4 / 0.5 * Vec3(0.0, std::sin(0.5), 1.0 - std::cos(0.5))).norm(), 1e-15);
  EXPECT_LT((pose.R.col(1) - Vec3(0.0, std::cos(0.5), std::sin(0.5))).norm(), 1e-15);
  EXPECT_NEAR(pose.R(0, 0), std::cos(0.7), 1e-15);
}

// shoulder_rotation = 2 (0.1 + 0.2 e + 0.3 e^2 + 0.4 s + 0.5 s e + 0.6 s^2), s the first of the two
// independent coordinates.
TEST(ParseOsim, ACouplerMayHaveSeveralIndependentCoordinates) {
  const auto coupled = [](const std::string& function) {
    return parse_osim(arm_replacing("</Model>",
                                    "<ConstraintSet><objects><CoordinateCouplerConstraint name=\"c\">"
                                    "<coupled_coordinates_function>" +
                                        function +
                                        "</coupled_coordinates_function><independent_coordinate_names>shoulder_flexion "
                                        "elbow_flexion</independent_coordinate_names><dependent_coordinate_name>"
                                        "shoulder_rotation</dependent_coordinate_name><scale_factor>2</scale_factor>"
                                        "</CoordinateCouplerConstraint></objects></ConstraintSet></Model>"),
                      "arm.osim");
  };
  const BodyModel m = coupled(
      "<MultivariatePolynomialFunction><dimension>2</dimension><order>2</order><coefficients>"
      "0.1 0.2 0.3 0.4 0.5 0.6</coefficients></MultivariatePolynomialFunction>");
  EXPECT_TRUE(m.unsupported.empty());
  const int s = m.coordinate_index("shoulder_flexion"), e = m.coordinate_index("elbow_flexion");
  const int r = m.coordinate_index("shoulder_rotation");
  EXPECT_TRUE(m.is_constrained(r));
  Eigen::VectorXd q = m.default_q();
  q[s] = 0.3;
  q[e] = 0.9;
  const AssemblyResult assembled = assemble(m, q);
  EXPECT_TRUE(assembled.converged);
  EXPECT_EQ(assembled.q[s], 0.3);  // the independent ones stay
  EXPECT_EQ(assembled.q[e], 0.9);
  EXPECT_NEAR(assembled.q[r], 2.0 * (0.1 + 0.18 + 0.243 + 0.12 + 0.135 + 0.054), 1e-13);
  BodyState state = make_state(m);
  compute_poses(m, assembled.q, state);
  const Eigen::MatrixXd A = constraint_jacobian(m, state);
  EXPECT_NEAR(A(0, r), 1.0, 0.0);
  EXPECT_NEAR(A(0, s), -2.0 * (0.4 + 0.45 + 0.36), 1e-13);
  EXPECT_NEAR(A(0, e), -2.0 * (0.2 + 0.54 + 0.15), 1e-13);
  // By slopes and intercept.
  const BodyModel line = coupled("<LinearFunction><coefficients>0.5 -0.25 0.125</coefficients></LinearFunction>");
  EXPECT_NEAR(assemble(line, q).q[r], 2.0 * (0.15 - 0.225 + 0.125), 1e-14);
  EXPECT_THROW((void)coupled("<LinearFunction><coefficients>1 2</coefficients></LinearFunction>"), ReadError);
  EXPECT_EQ(coupled("<SimmSpline><x>0 1</x><y>0 1</y></SimmSpline>").unsupported.size(), 1U);
}

TEST(ParseOsim, MarkersOfArm26LieWhereOpenSimPutsThem) {
  MYOID_REQUIRE_DATA(test::data_folder() / "opensim/arm26");
  // The motion file holds 8 decimals of a degree: 2e-10 rad over half a meter.
  EXPECT_LT(worst_marker_error("arm26", "smooth"), 1e-8);
  EXPECT_LT(worst_marker_error("arm26", "random"), 1e-8);
}

TEST(RequireLengthsInM, RefusesAModelInMillimetersAndNamesTheSegments) {
  BodyModel arm = parse_osim(arm4_osim(), "arm4.osim");
  EXPECT_NO_THROW(require_lengths_in_m(arm, "arm4.osim"));
  for (Joint& joint : arm.joints) {
    joint.X_PF.p *= 1000.0;
    joint.X_BM.p *= 1000.0;
  }
  try {
    require_lengths_in_m(arm, "arm4.osim");
    FAIL() << "not refused";
  } catch (const ReadError& error) {
    const std::string text = error.what();
    EXPECT_EQ(text.find("arm4.osim: the origin of the model's "), 0U) << text;
    EXPECT_NE(text.find("are the model's lengths in mm?"), std::string::npos) << text;
  }
}

// Both couplers of one coordinate hold: r = 2 e and r = 1 + f meet at f = 2 e - 1.
TEST(ParseOsim, TwoCouplersOfOneCoordinateBothHold) {
  const auto coupler = [](const char* name, const char* independent, const char* coefficients) {
    return fmt::format(
        "<CoordinateCouplerConstraint name=\"{}\"><coupled_coordinates_function><LinearFunction><coefficients>{}"
        "</coefficients></LinearFunction></coupled_coordinates_function><independent_coordinate_names>{}"
        "</independent_coordinate_names><dependent_coordinate_name>shoulder_rotation</dependent_coordinate_name>"
        "</CoordinateCouplerConstraint>",
        name, coefficients, independent);
  };
  const BodyModel m = parse_osim(
      arm_replacing("</Model>", "<ConstraintSet><objects>" + coupler("one", "elbow_flexion", "2 0") +
                                    coupler("two", "shoulder_flexion", "1 1") +
                                    coupler("again", "elbow_flexion", "(2, 0)") + "</objects></ConstraintSet></Model>"),
      "arm.osim");
  EXPECT_EQ(m.couplers.size(), 1U);
  EXPECT_EQ(m.constraints.size(), 1U);  // the third says what the first says
  Eigen::VectorXd q = m.default_q();
  q[m.coordinate_index("elbow_flexion")] = 0.6;
  q[m.coordinate_index("shoulder_flexion")] = 0.1;
  const AssemblyResult posed = assemble(m, q);
  EXPECT_TRUE(posed.converged);
  const double e = posed.q[m.coordinate_index("elbow_flexion")], f = posed.q[m.coordinate_index("shoulder_flexion")];
  EXPECT_NEAR(posed.q[m.coordinate_index("shoulder_rotation")], 2.0 * e, 1e-9);
  EXPECT_NEAR(f, 2.0 * e - 1.0, 1e-9);
  // The nearest: (e - 0.6)^2 + (f - 0.1)^2 is least on that line, at e = 0.6 - 2 (0.1 / 5) = 0.56.
  EXPECT_NEAR(e, 0.56, 1e-6);
  // Rates and accelerations: e and f move as the line says.
  BodyState state = make_state(m);
  compute_poses(m, posed.q, state);
  const Eigen::MatrixXd A = constraint_jacobian(m, state);
  Eigen::VectorXd rate = Eigen::VectorXd::Zero(4);
  rate[m.coordinate_index("elbow_flexion")] = 1.0;
  rate[m.coordinate_index("shoulder_rotation")] = rate[m.coordinate_index("shoulder_flexion")] = 2.0;
  EXPECT_LT((A * rate).norm(), 1e-12);
}

}  // namespace
}  // namespace myoid::body
