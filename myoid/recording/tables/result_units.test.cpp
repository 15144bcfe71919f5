#include "myoid/recording/tables/result_units.h"

#include <gtest/gtest.h>

namespace myoid::recording {
namespace {

// The pages docs/guide/run.md and predict.md say these units.
TEST(ResultUnits, AreThoseOfThePagesOfTheCommands) {
  EXPECT_EQ(result_unit("ik", "elbow_flexion", true), "deg");
  EXPECT_EQ(result_unit("ik", "elbow_flexion", false), "rad");
  EXPECT_EQ(result_unit("ik", "pelvis_ty", true), "m");
  EXPECT_EQ(result_unit("ik_marker_errors", "total_squared_error", false), "m^2");
  EXPECT_EQ(result_unit("ik_marker_errors", "sternum", false), "m");
  EXPECT_EQ(result_unit("id", "elbow_flexion_moment", false), "N m");
  EXPECT_EQ(result_unit("id", "pelvis_ty_force", false), "N");
  EXPECT_EQ(result_unit("MuscleAnalysis_Length", "BIC", false), "m");
  EXPECT_EQ(result_unit("MuscleAnalysis_MuscleTendonVelocity", "BIC", false), "m/s");
  EXPECT_EQ(result_unit("MuscleAnalysis_MomentArm_elbow_flexion", "BIC", false), "m");
  EXPECT_EQ(result_unit("StaticOptimization_force", "BIC", false), "N");
  EXPECT_EQ(result_unit("EmgInformed_force", "elbow_flexion_reserve", false), "N m");
  EXPECT_EQ(result_unit("StaticOptimization_activation", "BIC", false), "1");
  EXPECT_EQ(result_unit("activation", "BIC", false), "1");
  EXPECT_EQ(result_unit("drive", "BIC", false), "1");
  EXPECT_EQ(result_unit("identified_forces", "BIC_reference", false), "N");
  EXPECT_EQ(result_unit("predicted_forces", "BIC_low", false), "N");
  EXPECT_EQ(result_unit("predicted_torque_elbow_flexion", "elbow_flexion_low", false), "N m");
  EXPECT_EQ(result_unit("weather", "rain", false), "");
}

// Files of forces say `inDegrees=yes`, and call their columns by the prefixes of an ExternalLoads file.
TEST(MayHoldAngles, NotInColumnsThatAreVectors) {
  const auto holds = [](const std::string& names) {
    std::string row = "0";
    for (const char c : names) row += c == '\t' ? "\t1" : "";
    return may_hold_angles(parse_storage(
        "walk\nversion=1\nnRows=1\ninDegrees=yes\nendheader\ntime\t" + names + "\n" + row + "\t1\n", "a.mot"));
  };
  EXPECT_FALSE(holds("rfx\trfy\trfz\trcx\trcy\trcz\trmx\trmy\trmz"));
  EXPECT_FALSE(holds("FP1_vX\tFP1_vY\tFP1_vZ"));
  EXPECT_TRUE(holds("RHipAngle_x\tRHipAngle_y\tRHipAngle_z"));
  EXPECT_TRUE(holds("rfx\trfy\trfz\tknee_flexion"));
  EXPECT_TRUE(holds("hip_flexion\thip_adduction\thip_rotation"));
}

}  // namespace
}  // namespace myoid::recording
