#include "myoid/body/forces/sharing_input.h"

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

body::BodyModel arm() { return body::parse_osim(body::arm4_osim(), "arm4.osim"); }

body::JointMotion flexing(const body::BodyModel& model) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(41, 0.0, 1.0);
  Eigen::MatrixXd q(t.size(), static_cast<Eigen::Index>(model.coordinates.size()));
  std::vector<Channel> channels;
  for (Eigen::Index c = 0; c < q.cols(); ++c) {
    channels.push_back({model.coordinates[static_cast<std::size_t>(c)].name, Unit::radian});
    q.col(c) = 0.6 + 0.4 * (t.array() * (2.0 + static_cast<double>(c))).sin();
  }
  return body::joint_motion(model, {t, channels, q}).motion;
}

// A coordinate that follows: all that acts on it acts on the one that it follows, by its rate (virtual work).
TEST(SharingInput, ACoordinateThatFollowsAddsItsTorqueAndMomentArmByItsRate) {
  body::BodyModel free = arm();
  ASSERT_EQ(free.coordinates.size(), 4u);  // the last is the elbow
  body::BodyModel coupled = free;
  coupled.couplers.push_back({"follows", 3, 0, body::Function(body::Linear{0.5, 0.1})});
  body::JointMotion motion = flexing(free);
  const SharingInput all = sharing_input(free, motion, body::muscle_kinematics(free, motion), {});
  const SharingInput one = sharing_input(coupled, motion, body::muscle_kinematics(coupled, motion), {});
  ASSERT_EQ(one.torques.channel_count(), all.torques.channel_count() - 1);
  const Eigen::MatrixXd torque = all.torques.values().col(0) + 0.5 * all.torques.values().col(3);
  EXPECT_LT((one.torques.values().col(0) - torque).cwiseAbs().maxCoeff(), 1e-12);
  const Eigen::MatrixXd arm = all.moment_arms[0].values() + 0.5 * all.moment_arms[3].values();
  EXPECT_LT((one.moment_arms[0].values() - arm).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(SharingInput, RefusesACoordinateThatNoTorqueMoves) {
  body::BodyModel locked = arm();
  locked.coordinates[0].locked = true;
  const body::JointMotion motion = flexing(locked);
  EXPECT_THROW(
      (void)sharing_input(locked, motion, body::muscle_kinematics(locked, motion), {locked.coordinates[0].name}),
      ModelError);
}

}  // namespace
}  // namespace myoid::body
