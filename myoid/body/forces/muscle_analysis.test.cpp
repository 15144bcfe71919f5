#include "myoid/body/forces/muscle_analysis.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

body::JointMotion flexion(const body::BodyModel& m) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(101, 0.0, 1.0);
  const Eigen::VectorXd q = 1.2 + 0.5 * (2.0 * t.array()).sin();
  return body::joint_motion(m, {t, {{"elbow_flexion", Unit::radian}}, q}).motion;
}

const Eigen::MatrixXd& table(const MuscleAnalysis& analysis, const std::string& name) {
  const auto found =
      std::find_if(analysis.tables.begin(), analysis.tables.end(), [&](const auto& t) { return t.first == name; });
  if (found == analysis.tables.end()) throw InvalidInput("no table " + name);
  return found->second.values();
}

TEST(MuscleAnalysis, TendonAndFiberPullAlikeAndTheirLengthsAddUp) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const MuscleAnalysis a = muscle_analysis(m, flexion(m));
  const Eigen::ArrayXXd cosine = table(a, "PennationAngle").array().cos();
  const Eigen::ArrayXXd length = table(a, "TendonLength").array() + table(a, "FiberLength").array() * cosine;
  EXPECT_LT((length - table(a, "Length").array()).abs().maxCoeff(), 1e-14);
  const Eigen::ArrayXXd gap = table(a, "FiberForce").array() * cosine - table(a, "TendonForce").array();
  EXPECT_LT(gap.abs().maxCoeff(), 1e-9);
  // Power: what fiber and tendon do together is what the muscle does.
  const Eigen::ArrayXXd power = table(a, "FiberActivePower").array() + table(a, "FiberPassivePower").array() +
                                table(a, "TendonPower").array() - table(a, "MuscleActuatorPower").array();
  EXPECT_LT(power.abs().maxCoeff(), 1e-9);
}

TEST(MuscleAnalysis, MomentIsMomentArmTimesTendonForce) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const int elbow = m.coordinate_index("elbow_flexion");
  const MuscleAnalysis a = muscle_analysis(m, flexion(m), {.coordinates = {elbow}});
  const Eigen::MatrixXd product = table(a, "MomentArm_elbow_flexion").cwiseProduct(table(a, "TendonForce"));
  EXPECT_EQ(product, table(a, "Moment_elbow_flexion"));
  EXPECT_EQ(table(a, "MomentArm_elbow_flexion"),
            body::muscle_kinematics(m, flexion(m)).moment_arm.at("elbow_flexion").values());
}

TEST(MuscleAnalysis, FibersOfGivenLengthKeepIt) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const body::JointMotion motion = flexion(m);
  const MuscleAnalysis balanced = muscle_analysis(m, motion);
  MuscleAnalysisOptions options{.equilibrium = false};
  options.fiber_length_m = table(balanced, "FiberLength");
  const MuscleAnalysis given = muscle_analysis(m, motion, options);
  for (const auto& [name, values] : balanced.tables)
    EXPECT_LT((values.values() - table(given, name)).cwiseAbs().maxCoeff(), 1e-12) << name;
  options.fiber_length_m = Eigen::MatrixXd::Zero(3, 1);
  EXPECT_THROW((void)muscle_analysis(m, motion, options), InvalidInput);
}

TEST(MuscleAnalysis, IsTheSameForEveryNumberOfThreads) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const MuscleAnalysis many = muscle_analysis(m, flexion(m));
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const MuscleAnalysis single = muscle_analysis(m, flexion(m));
  for (const auto& [name, values] : many.tables) EXPECT_EQ(values.values(), table(single, name));
}

}  // namespace
}  // namespace myoid::body
