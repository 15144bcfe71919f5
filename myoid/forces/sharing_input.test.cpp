#include "myoid/forces/sharing_input.h"

#include <gtest/gtest.h>

#include "myoid/arm/arm4.h"
#include "myoid/core/error.h"
#include "myoid/osim/osim_reader.h"

namespace myoid::forces {
namespace {

model::BodyModel arm() { return model::parse_osim(model::arm4_osim(), "arm4.osim"); }

kinematics::JointMotion flexing(const model::BodyModel& model) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(41, 0.0, 1.0);
  Eigen::MatrixXd q(t.size(), static_cast<Eigen::Index>(model.coordinates.size()));
  std::vector<Channel> channels;
  for (Eigen::Index c = 0; c < q.cols(); ++c) {
    channels.push_back({model.coordinates[static_cast<std::size_t>(c)].name, Unit::radian});
    q.col(c) = 0.6 + 0.4 * (t.array() * (2.0 + static_cast<double>(c))).sin();
  }
  return kinematics::joint_motion(model, {t, channels, q}).motion;
}

// A coordinate that follows: all that acts on it acts on the one that it follows, by its rate (virtual work).
TEST(SharingInput, ACoordinateThatFollowsAddsItsTorqueAndMomentArmByItsRate) {
  model::BodyModel free = arm();
  ASSERT_EQ(free.coordinates.size(), 4u);  // the last is the elbow
  model::BodyModel coupled = free;
  coupled.couplers.push_back({"follows", 3, 0, model::Function(model::Linear{0.5, 0.1})});
  kinematics::JointMotion motion = flexing(free);
  const SharingInput all = sharing_input(free, motion, kinematics::muscle_kinematics(free, motion), {});
  const SharingInput one = sharing_input(coupled, motion, kinematics::muscle_kinematics(coupled, motion), {});
  ASSERT_EQ(one.torques.channel_count(), all.torques.channel_count() - 1);
  const Eigen::MatrixXd torque = all.torques.values().col(0) + 0.5 * all.torques.values().col(3);
  EXPECT_LT((one.torques.values().col(0) - torque).cwiseAbs().maxCoeff(), 1e-12);
  const Eigen::MatrixXd arm = all.moment_arms[0].values() + 0.5 * all.moment_arms[3].values();
  EXPECT_LT((one.moment_arms[0].values() - arm).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(SharingInput, RefusesACoordinateThatNoTorqueMoves) {
  model::BodyModel locked = arm();
  locked.coordinates[0].locked = true;
  const kinematics::JointMotion motion = flexing(locked);
  EXPECT_THROW(
      (void)sharing_input(locked, motion, kinematics::muscle_kinematics(locked, motion), {locked.coordinates[0].name}),
      ModelError);
}

}  // namespace
}  // namespace myoid::forces
