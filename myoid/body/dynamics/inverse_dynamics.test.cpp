#include "myoid/body/dynamics/inverse_dynamics.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/arm/planar_elbow.h"
#include "myoid/body/kinematics/angular_speeds.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/recording/tables/storage_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

TEST(InverseDynamics, OfTheArmIsTheClosedFormsTorqueAlongAMotion) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim({}), "arm4.osim");
  const body::PlanarElbow elbow = body::planar_elbow({});
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(1001, 0.0, 5.0);
  const Eigen::VectorXd q = 1.2 + 0.8 * (3.0 * t.array()).sin();
  const auto motion = body::joint_motion(m, {t, {{"elbow_flexion", Unit::radian}}, q}).motion;
  const Eigen::VectorXd tau = inverse_dynamics(m, motion).column("elbow_flexion_moment");
  for (Eigen::Index i = 100; i < 900; i += 50) {
    const double qddot = -9.0 * 0.8 * std::sin(3.0 * t[i]);
    EXPECT_NEAR(tau[i], body::required_torque_nm(elbow, q[i], qddot, kStandardGravity),
                1e-8);  // the spline's h^4
  }
}

TEST(InverseDynamics, OfArm26IsOpenSimsAwayFromTheEnds) {
  const auto folder = test::data_folder() / "opensim/trial_arm26";
  MYOID_REQUIRE_DATA(folder);
  const body::BodyModel m = body::read_osim(folder / "model.osim");
  const TimeSeries q =
      recording::to_si(recording::read_storage(folder / "opensim/ik.mot"), [](const std::string&) { return true; });
  const TimeSeries ours = inverse_dynamics(m, body::joint_motion(m, q).motion);
  const TimeSeries theirs = recording::read_storage(folder / "opensim/id_unfiltered.sto").data;
  for (const char* name : {"r_shoulder_elev_moment", "r_elbow_flex_moment"}) {
    const Eigen::VectorXd difference = (ours.column(name) - theirs.column(name)).segment(10, 100);
    // Angles have 8 decimals of a degree: 2e-10 rad / h^2 * inertia 0.3 = 1e-6; the spline's round-off the rest.
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 2e-5) << name;
  }
}

TEST(InverseDynamics, OfTheRajagopalModelIsOpenSimsAlsoWhereAxesShareACoordinate) {
  // The knees turn about three axes by one coordinate: there OpenSim's accelerations are not those
  // of the geometry (Compat::axes_carried_by_coordinates).
  const auto folder = test::data_folder() / "opensim/rajagopal2016";
  MYOID_REQUIRE_DATA(folder);
  const auto worst = [&](const body::Compat& compat) {
    const body::BodyModel m = body::read_osim(folder / "model.osim", {.compat = compat});
    const TimeSeries q = recording::to_si(
        recording::read_storage(folder / "opensim/smooth_Kinematics_q.sto"), [&](const std::string& name) {
          const auto c = m.find_coordinate(name);
          return c && m.coordinates[static_cast<std::size_t>(*c)].motion == body::MotionType::rotational;
        });
    const TimeSeries ours = inverse_dynamics(m, body::joint_motion(m, q).motion);
    const TimeSeries theirs = recording::read_storage(folder / "opensim/id_muscles_excluded.sto").data;
    double relative = 0.0;
    for (const Channel& channel : theirs.channels()) {
      const Eigen::VectorXd reference = theirs.column(channel.name);
      const Eigen::VectorXd difference = (ours.column(channel.name) - reference).segment(10, reference.size() - 20);
      relative = std::max(relative, difference.cwiseAbs().maxCoeff() / reference.cwiseAbs().maxCoeff());
    }
    return relative;
  };
  // The angles have twelve digits; the second derivative of their spline keeps seven.
  EXPECT_LT(worst(body::kOpenSim452), 1e-5);
  EXPECT_GT(worst({}), 1e-4);
}

// At rest the generalized forces on OpenSim's speeds are N^T times those on the rates, whatever makes them.
TEST(InverseDynamics, SpringsAndLigamentsOfABallJointActOnItsSpeeds) {
  const auto read = [](const body::Compat& compat) {
    const std::string point = "</socket_parent_frame><location>";
    const auto path = [&](const char* a, const char* b) {
      return "<GeometryPath><PathPointSet><objects><PathPoint name=\"a\"><socket_parent_frame>/ground" + point + a +
             "</location></PathPoint><PathPoint name=\"b\"><socket_parent_frame>/bodyset/b" + point + b +
             "</location></PathPoint></objects></PathPointSet></GeometryPath>";
    };
    return body::parse_osim(
        "<OpenSimDocument Version=\"40000\"><Model name=\"m\"><BodySet><objects><Body name=\"b\"><mass>2</mass>"
        "<mass_center>0 -0.2 0.05</mass_center><inertia>0.1 0.1 0.1 0 0 0</inertia></Body></objects></BodySet>"
        "<JointSet><objects><BallJoint name=\"j\"><socket_parent_frame>/ground</socket_parent_frame>"
        "<socket_child_frame>/bodyset/b</socket_child_frame><coordinates><Coordinate name=\"x\"/>"
        "<Coordinate name=\"y\"/><Coordinate name=\"z\"/></coordinates></BallJoint></objects></JointSet>"
        "<ForceSet><objects><PathSpring name=\"s\"><resting_length>0.05</resting_length><stiffness>300</stiffness>"
        "<dissipation>0</dissipation>" +
            path("0.1 0.1 0.2", "0.05 -0.2 0") +
            "</PathSpring><Ligament name=\"l\"><resting_length>0.1</resting_length><pcsa_force>200</pcsa_force>" +
            path("-0.1 0.05 0.1", "0 -0.3 0.1") +
            "</Ligament><SpringGeneralizedForce name=\"g\"><coordinate>y</coordinate><stiffness>7</stiffness>"
            "<rest_length>0.4</rest_length><viscosity>1</viscosity></SpringGeneralizedForce></objects></ForceSet>"
            "</Model></OpenSimDocument>",
        "ball.osim", {.compat = compat});
  };
  const body::BodyModel opensim = read(body::kOpenSim452);
  body::BodyModel exact = read({});
  const Eigen::Vector3d q(0.4, -0.7, 0.9);
  const auto at_rest = [&](const body::BodyModel& m) {
    const std::vector<Channel> channels{{"x", Unit::radian}, {"y", Unit::radian}, {"z", Unit::radian}};
    const TimeSeries zero(Eigen::VectorXd::Zero(1), channels, Eigen::MatrixXd::Zero(1, 3));
    const body::JointMotion motion{{Eigen::VectorXd::Zero(1), channels, q.transpose()}, zero, zero};
    return Eigen::Vector3d(inverse_dynamics(m, motion, {.passive_forces = true}).values().row(0).transpose());
  };
  const Eigen::MatrixXd N = body::rates_of_speeds(exact, q);
  // The spring of a coordinate acts on the speed in OpenSim, on the rate here.
  const Eigen::Vector3d on_coordinate(0.0, -7.0 * (q[1] - 0.4), 0.0);
  const Eigen::Vector3d expected = N.transpose() * (at_rest(exact) + on_coordinate) - on_coordinate;
  EXPECT_LT((at_rest(opensim) - expected).norm(), 1e-10);
}

}  // namespace
}  // namespace myoid::body
