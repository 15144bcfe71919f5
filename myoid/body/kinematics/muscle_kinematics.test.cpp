#include "myoid/body/kinematics/muscle_kinematics.h"

#include <cmath>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {
namespace {

JointMotion flexion(const body::BodyModel& m) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(501, 0.0, 5.0);
  const Eigen::VectorXd q = 1.2 + 0.8 * (2.0 * t.array()).sin();
  return joint_motion(m, {t, {{"elbow_flexion", Unit::radian}}, q}).motion;
}

TEST(MuscleKinematics, LengthsChangeByTheIntegralOfTheVelocity) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim({}), "arm4.osim");
  const MuscleKinematics k = muscle_kinematics(m, flexion(m));
  for (Eigen::Index c = 0; c < k.length.channel_count(); ++c) {
    // Simpson over an even number of intervals: error h^4.
    double integral = 0.0;
    for (Eigen::Index i = 100; i + 2 <= 400; i += 2) {
      integral += 0.01 / 3.0 *
                  (k.velocity.values()(i, c) + 4.0 * k.velocity.values()(i + 1, c) + k.velocity.values()(i + 2, c));
    }
    EXPECT_NEAR(k.length.values()(400, c) - k.length.values()(100, c), integral, 1e-8);
  }
}

TEST(MuscleKinematics, PowerBalances) {
  // Muscle power -F dl/dt equals torque r F times the joint's rate, whatever F.
  const body::BodyModel m = body::parse_osim(body::arm4_osim({}), "arm4.osim");
  const JointMotion motion = flexion(m);
  const MuscleKinematics k = muscle_kinematics(m, motion);
  const Eigen::VectorXd rate = motion.qdot.column("elbow_flexion");
  for (Eigen::Index c = 0; c < k.length.channel_count(); ++c) {
    const Eigen::VectorXd sum =
        k.velocity.values().col(c) + k.moment_arm.at("elbow_flexion").values().col(c).cwiseProduct(rate);
    EXPECT_LT(sum.cwiseAbs().maxCoeff(), 1e-15);
  }
}

TEST(MuscleKinematics, IsTheSameForEveryNumberOfThreads) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim({}), "arm4.osim");
  const MuscleKinematics many = muscle_kinematics(m, flexion(m));
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(muscle_kinematics(m, flexion(m)).length.values(), many.length.values());
}

}  // namespace
}  // namespace myoid::body
