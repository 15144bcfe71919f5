#include "myoid/dynamics/inverse_dynamics.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/model/arm4.h"
#include "myoid/model/osim_reader.h"
#include "myoid/model/planar_elbow.h"
#include "myoid/recording/storage_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::dynamics {
namespace {

TEST(InverseDynamics, OfTheArmIsTheClosedFormsTorqueAlongAMotion) {
  const model::BodyModel m = model::parse_osim(model::arm4_osim({}), "arm4.osim");
  const model::PlanarElbow elbow = model::planar_elbow({});
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(1001, 0.0, 5.0);
  const Eigen::VectorXd q = 1.2 + 0.8 * (3.0 * t.array()).sin();
  const auto motion = kinematics::joint_motion(m, {t, {{"elbow_flexion", Unit::radian}}, q}).motion;
  const Eigen::VectorXd tau = inverse_dynamics(m, motion).column("elbow_flexion_moment");
  for (Eigen::Index i = 100; i < 900; i += 50) {
    const double qddot = -9.0 * 0.8 * std::sin(3.0 * t[i]);
    EXPECT_NEAR(tau[i], model::required_torque_nm(elbow, q[i], qddot, kStandardGravity),
                1e-8);  // the spline's h^4
  }
}

TEST(InverseDynamics, OfArm26IsOpenSimsAwayFromTheEnds) {
  const auto folder = test::data_folder() / "opensim/trial_arm26";
  MYOID_REQUIRE_DATA(folder);
  const model::BodyModel m = model::read_osim(folder / "model.osim");
  const TimeSeries q = recording::to_si(recording::read_storage(folder / "opensim/ik.mot"),
                                        [](const std::string&) { return true; });
  const TimeSeries ours = inverse_dynamics(m, kinematics::joint_motion(m, q).motion);
  const TimeSeries theirs = recording::read_storage(folder / "opensim/id_unfiltered.sto").data;
  for (const char* name : {"r_shoulder_elev_moment", "r_elbow_flex_moment"}) {
    const Eigen::VectorXd difference = (ours.column(name) - theirs.column(name)).segment(10, 100);
    // Angles have 8 decimals of a degree: 2e-10 rad / h^2 * inertia 0.3 = 1e-6; the spline's
    // round-off the rest.
    EXPECT_LT(difference.cwiseAbs().maxCoeff(), 2e-5) << name;
  }
}

}  // namespace
}  // namespace myoid::dynamics
