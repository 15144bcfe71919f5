#include <array>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/body/osim/osim_parts.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

/// The built-in arm with more forces, components or contact geometry.
BodyModel arm_with(const std::string& forces, const std::string& in_model = "") {
  std::string text = arm4_osim();
  const auto set = text.rfind("</objects>", text.find("</ForceSet>"));
  EXPECT_NE(set, std::string::npos);
  text.insert(set, forces);
  text.insert(text.find("</Model>"), in_model);
  return parse_osim(text, "arm.osim", {.compat = kOpenSim452});
}

template <typename Law>
const Law& last(const BodyModel& m) {
  return std::get<Law>(m.passive_forces.back().law);
}

TEST(ReadForces, FormulasOfACoordinateAndBetweenTwoPoints) {
  const BodyModel m = arm_with(
      "<ExpressionBasedCoordinateForce name=\"stop\"><coordinate>elbow_flexion</coordinate>"
      "<expression> -10*exp(20*(q-2.3)) - 0.5*qdot </expression></ExpressionBasedCoordinateForce>"
      "<ExpressionBasedPointToPointForce name=\"band\"><body1>ground</body1>"
      "<body2>forearm_hand</body2><point1>0.1 0 0</point1><point2>0 0.2 0</point2>"
      "<expression>100*(d-0.3)+2*ddot</expression></ExpressionBasedPointToPointForce>");
  EXPECT_TRUE(m.unsupported.empty());
  const auto& pair = last<PointFormula>(m);
  EXPECT_EQ(pair.p_B2, Vec3(0.0, 0.2, 0.0));
  EXPECT_DOUBLE_EQ(pair.force(std::array<double, 2>{0.5, 3.0}), 26.0);
  const auto& stop = std::get<CoordinateFormula>(m.passive_forces[m.passive_forces.size() - 2].law);
  EXPECT_DOUBLE_EQ(stop.force(std::array<double, 2>{2.3, 1.0}), -10.5);
  EXPECT_EQ(m.force_order.back(), "band");
  try {
    (void)arm_with(
        "<ExpressionBasedCoordinateForce name=\"wrong\"><coordinate>elbow_flexion</coordinate>"
        "<expression>2*angle</expression></ExpressionBasedCoordinateForce>");
    FAIL() << "an unknown name was taken";
  } catch (const ReadError& error) {
    EXPECT_NE(std::string(error.what()).find("'angle' is neither defined nor one of q, qdot"), std::string::npos)
        << error.what();
  }
}

TEST(ReadForces, BushingsByFunctionAndByFormula) {
  const std::string frames =
      "<socket_frame1>/ground</socket_frame1><socket_frame2>/bodyset/forearm_hand</socket_frame2>";
  const BodyModel m =
      arm_with("<FunctionBasedBushingForce name=\"f\">" + frames +
               "<LinearFunction name=\"m_x_theta_x_function\"><coefficients>7 1</coefficients>"
               "</LinearFunction><f_z_delta_z_function><StepFunction><end_value>5</end_value>"
               "</StepFunction></f_z_delta_z_function><rotational_damping>1 1 1</rotational_damping>"
               "</FunctionBasedBushingForce><ExpressionBasedBushingForce name=\"e\">" +
               frames +
               "<My_expression>3*theta_y^3</My_expression><Fx_expression>delta_x*theta_z</Fx_expression>"
               "<translational_damping>1 2 3</translational_damping></ExpressionBasedBushingForce>");
  EXPECT_TRUE(m.unsupported.empty());
  const auto& formula = last<Bushing>(m);
  const std::array<double, 6> at{0.0, 2.0, 0.5, 4.0, 0.0, 0.0};
  EXPECT_DOUBLE_EQ(formula.formulas.at(1)(at), 24.0);
  EXPECT_DOUBLE_EQ(formula.formulas.at(3)(at), 2.0);
  EXPECT_EQ(formula.formulas.at(0)(at), 0.0);
  EXPECT_EQ(formula.translational_damping, Vec3(1.0, 2.0, 3.0));
  const auto& function = std::get<Bushing>(m.passive_forces[m.passive_forces.size() - 2].law);
  EXPECT_DOUBLE_EQ(evaluate(function.functions.at(0), 2.0).value, 15.0);
  EXPECT_DOUBLE_EQ(evaluate(function.functions.at(5), 0.5).value, 2.5);
  // OpenSim 4.5.2 forgets this one's damping.
  EXPECT_TRUE(function.rotational_damping.isZero(0.0));
}

TEST(ReadForces, PrescribedForcesActuatorsOfPathsAndOfBodies) {
  const BodyModel m = arm_with(
      "<PrescribedForce name=\"push\"><body>forearm_hand</body><forceIsGlobal>false</forceIsGlobal>"
      "<FunctionSet name=\"forceFunctions\"><objects><Constant><value>1</value></Constant>"
      "<Sine><amplitude>2</amplitude><omega>3</omega></Sine><Constant/></objects></FunctionSet>"
      "</PrescribedForce>"
      "<PathActuator name=\"cable\"><optimal_force>300</optimal_force><min_control>0</min_control>"
      "<GeometryPath><PathPointSet><objects><PathPoint name=\"a\"><socket_parent_frame>/ground"
      "</socket_parent_frame><location>0 0.1 0</location></PathPoint><PathPoint name=\"b\">"
      "<socket_parent_frame>/bodyset/forearm_hand</socket_parent_frame><location>0 -0.1 "
      "0</location>"
      "</PathPoint></objects></PathPointSet></GeometryPath></PathActuator>"
      "<BodyActuator name=\"hand_of_god\"/>");
  EXPECT_TRUE(m.unsupported.empty()) << m.unsupported.front();
  ASSERT_EQ(m.path_actuators.size(), 1U);
  EXPECT_EQ(m.path_actuators[0].optimal_force, 300.0);
  EXPECT_EQ(m.path_actuators[0].min_control, 0.0);
  EXPECT_EQ(m.force_order.back(), "cable");
  EXPECT_NE(m.notes.front().says.find("hand_of_god"), std::string::npos);
  const auto& push = last<PrescribedForce>(m);
  ASSERT_EQ(push.force.size(), 3U);
  EXPECT_NEAR(evaluate(push.force[1], 0.2).value, 2.0 * std::sin(0.6), 1e-15);
  EXPECT_TRUE(push.point.empty());
  EXPECT_FALSE(push.force_is_global);
}

constexpr const char* kGround =
    "<ContactGeometrySet><objects><ContactHalfSpace name=\"floor\"><socket_frame>/ground"
    "</socket_frame><location>0 -1 0</location><orientation>0 0 -1.5707963267948966</orientation>"
    "</ContactHalfSpace><ContactSphere name=\"palm\"><socket_frame>/bodyset/forearm_hand"
    "</socket_frame><location>0 -0.3 0</location><radius>0.04</radius></ContactSphere>"
    "<ContactMesh name=\"bone\"/></objects></ContactGeometrySet>";

TEST(ReadForces, ContactsOfBothKindsAndThoseAmongTheComponents) {
  const BodyModel m = arm_with(
      "<HuntCrossleyForce name=\"hc\"><HuntCrossleyForce::ContactParametersSet><objects>"
      "<HuntCrossleyForce::ContactParameters><geometry>floor palm</geometry>"
      "<stiffness>1e6</stiffness><dissipation>2</dissipation><static_friction>0.8</static_friction>"
      "</HuntCrossleyForce::ContactParameters></objects>"
      "</HuntCrossleyForce::ContactParametersSet><transition_velocity>0.1</transition_velocity>"
      "</HuntCrossleyForce>",
      std::string(kGround) +
          "<components><SmoothSphereHalfSpaceForce name=\"smooth\"><socket_sphere>"
          "/contactgeometryset/palm</socket_sphere><socket_half_space>/contactgeometryset/floor"
          "</socket_half_space><stiffness>2e6</stiffness></SmoothSphereHalfSpaceForce></"
          "components>");
  EXPECT_TRUE(m.unsupported.empty()) << m.unsupported.front();
  const auto& smooth = last<Contact>(m);
  EXPECT_TRUE(smooth.smoothing.has_value());
  EXPECT_EQ(smooth.materials[1].stiffness, 2e6);
  const auto& hard = std::get<Contact>(m.passive_forces[m.passive_forces.size() - 2].law);
  EXPECT_EQ(hard.radius_m, 0.04);
  EXPECT_EQ(hard.other_body, 0);
  EXPECT_EQ(hard.transition_velocity_mps, 0.1);
  // The half-space lies below: its x points down.
  EXPECT_NEAR(hard.X_BO.R(1, 0), -1.0, 1e-15);
}

TEST(ReadForces, WhatIsNotSupportedIsListedAndTheRestIsRead) {
  const BodyModel m = arm_with(
      "<ElasticFoundationForce name=\"ef\"/>"
      "<HuntCrossleyForce name=\"hc\"><HuntCrossleyForce::ContactParametersSet><objects>"
      "<HuntCrossleyForce::ContactParameters><geometry>floor bone</geometry></HuntCrossleyForce::"
      "ContactParameters></objects></HuntCrossleyForce::ContactParametersSet></HuntCrossleyForce>"
      "<Thelen2003Muscle name=\"by_function\"><path><FunctionBasedPath/></path></Thelen2003Muscle>"
      "<PrescribedForce name=\"odd\"><body>forearm_hand</body><FunctionSet "
      "name=\"torqueFunctions\">"
      "<objects><Constant/><Constant/><Wavelet/></objects></FunctionSet></PrescribedForce>",
      kGround);
  ASSERT_EQ(m.unsupported.size(), 4U);
  EXPECT_NE(m.unsupported[0].find("'ef' of kind ElasticFoundationForce"), std::string::npos);
  EXPECT_NE(m.unsupported[1].find("contact geometry 'bone' of kind ContactMesh"), std::string::npos);
  EXPECT_NE(m.unsupported[2].find("FunctionBasedPath"), std::string::npos);
  EXPECT_NE(m.unsupported[3].find("function <Wavelet> of <PrescribedForce> 'odd'"), std::string::npos)
      << m.unsupported[3];
  EXPECT_FALSE(m.find_muscle("by_function").has_value());
  EXPECT_EQ(m.muscles.size(), 4U);
}

TEST(ReadFunctions, EveryKindOfOneVariable) {
  const auto value = [](const std::string& function, double x) {
    const BodyModel m = arm_with(
        "<PrescribedForce name=\"f\"><body>forearm_hand</body><FunctionSet "
        "name=\"torqueFunctions\">"
        "<objects>" +
        function + "<Constant/><Constant/></objects></FunctionSet></PrescribedForce>");
    EXPECT_TRUE(m.unsupported.empty()) << function;
    return evaluate(last<PrescribedForce>(m).torque.at(0), x).value;
  };
  EXPECT_EQ(value("<LinearFunction><coefficients>2 1</coefficients></LinearFunction>", 3.0), 7.0);
  EXPECT_EQ(value("<PolynomialFunction><coefficients>2 1 0</coefficients></PolynomialFunction>", 3.0), 21.0);
  EXPECT_EQ(value("<PiecewiseConstantFunction><x>0 1 2</x><y>5 6 7</y></PiecewiseConstantFunction>", 1.5), 6.0);
  EXPECT_EQ(value("<PiecewiseConstantFunction><x>0 1 2</x><y>5 6 7</y></PiecewiseConstantFunction>", -3.0), 5.0);
  EXPECT_NEAR(value("<MultiplierFunction><scale>3</scale><function><Sine><offset>1</offset></Sine>"
                    "</function></MultiplierFunction>",
                    0.5),
              3.0 + 3.0 * std::sin(0.5), 1e-15);
  // A natural quintic through a parabola is that parabola.
  EXPECT_NEAR(value("<GCVSpline><half_order>3</half_order><x>0 1 2 3 4 5</x><y>0 1 4 9 16 25</y>"
                    "</GCVSpline>",
                    2.5),
              6.25, 1e-12);
  EXPECT_NEAR(value("<StepFunction><start_time>1</start_time><end_time>3</end_time><start_value>2"
                    "</start_value><end_value>4</end_value></StepFunction>",
                    2.0),
              3.0, 1e-15);
}

TEST(ReadFrames, AStationDefinedFrameStandsOnItsPoints) {
  const auto station = [](const char* name, const char* place) {
    return std::string("<Station name=\"") + name +
           "\"><socket_parent_frame>/bodyset/forearm_hand</socket_parent_frame><location>" + place +
           "</location></Station>";
  };
  const BodyModel m = arm_with("<PrescribedForce name=\"f\"><socket_frame>/anatomical</socket_frame></PrescribedForce>",
                               "<components>" + station("a", "0 0 0") + station("b", "0 2 0") + station("c", "0 0 1") +
                                   station("o", "0.1 0.2 0.3") +
                                   "<StationDefinedFrame name=\"anatomical\"><socket_point_a>/a</socket_point_a>"
                                   "<socket_point_b>/b</socket_point_b><socket_point_c>/c</socket_point_c>"
                                   "<socket_origin_point>/o</socket_origin_point><ab_axis>+y</ab_axis>"
                                   "<ab_x_ac_axis>-z</ab_x_ac_axis></StationDefinedFrame></components>");
  // ab = y, ab x ac = x: the frame's z is -x, its x = y cross z = -(y cross x) = z.
  const Pose X = last<PrescribedForce>(m).X_BF;
  EXPECT_EQ(X.p, Vec3(0.1, 0.2, 0.3));
  EXPECT_LT((X.R.col(0) - Vec3::UnitZ()).norm(), 1e-15);
  EXPECT_LT((X.R.col(1) - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LT((X.R.col(2) + Vec3::UnitX()).norm(), 1e-15);
}

// Each direction of a moving point follows its own coordinate; the arms are minus the differences of the length.
TEST(ReadForces, AMovingPointMayFollowSeveralCoordinates) {
  const auto direction = [](const char* axis, const char* coordinate, const char* coefficients) {
    return fmt::format(
        "<socket_{0}_coordinate>/jointset/{1}</"
        "socket_{0}_coordinate><{0}_location><PolynomialFunction><coefficients>{2}"
        "</coefficients></PolynomialFunction></{0}_location>",
        axis, coordinate, coefficients);
  };
  const std::string path =
      "<GeometryPath><PathPointSet><objects><PathPoint name=\"a\"><socket_parent_frame>/ground</socket_parent_frame>"
      "<location>0.1 0.2 -0.1</location></PathPoint><MovingPathPoint name=\"m\"><socket_parent_frame>"
      "/bodyset/upper_arm</socket_parent_frame>" +
      direction("x", "shoulder/shoulder_flexion", "0.02 0.03 0.05") +
      direction("y", "elbow/elbow_flexion", "0.01 -0.04 -0.1") +
      direction("z", "shoulder/shoulder_flexion", "0.05, 0.02") +
      "</MovingPathPoint><PathPoint name=\"b\"><socket_parent_frame>/bodyset/forearm_hand</socket_parent_frame>"
      "<location>0.02 -0.1 0.03</location></PathPoint></objects></PathPointSet></GeometryPath>";
  BodyModel m = arm_with("<PathSpring name=\"s\"><resting_length>0.1</resting_length>" + path + "</PathSpring>");
  const MusclePath& spring = last<PathSpring>(m).path;
  EXPECT_EQ(spring.points[1].moving->coordinates,
            (std::array<int, 3>{m.coordinate_index("shoulder_flexion"), m.coordinate_index("elbow_flexion"),
                                m.coordinate_index("shoulder_flexion")}));
  for (const Compat& compat : {Compat{}, kOpenSim452}) {
    m.compat = compat;
    BodyState state = make_state(m);
    PathWorkspace workspace;
    PathResult result;
    Eigen::VectorXd q(4), qdot(4);
    q << 0.3, -0.2, 0.4, 1.1;
    qdot << 0.7, 0.2, -0.3, -0.9;
    const auto length = [&](const Eigen::VectorXd& at_q) {
      compute_poses(m, at_q, state);
      compute_velocities(m, qdot, state);
      compute_path(m, spring, state, workspace, result);
      return result.length_m;
    };
    constexpr double kStep = 1e-6;
    Eigen::VectorXd slope(4);
    for (Eigen::Index c = 0; c < 4; ++c) {
      const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(4, c);
      slope[c] = (length(q + step) - length(q - step)) / (2.0 * kStep);
    }
    (void)length(q);
    EXPECT_LT((result.moment_arm_m + slope).norm(), 1e-9);
    EXPECT_NEAR(result.speed_mps, slope.dot(qdot), 1e-9);
  }
}

}  // namespace
}  // namespace myoid::body
