#include "myoid/recording/signals/rigid_segment.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/moving_markers.h"

namespace myoid::recording {
namespace {

TEST(FitRigid, FindsTheRotationAndTheTranslationThatWereApplied) {
  const Eigen::Matrix3Xd local = test::forearm_shape();
  const Mat3 R = (Eigen::AngleAxisd(2.5, Vec3(1.0, -2.0, 0.5).normalized())).toRotationMatrix();
  const Vec3 p(0.3, -1.0, 2.0);
  const RigidFit fit = fit_rigid(local, (R * local).colwise() + p);
  EXPECT_LT((fit.R - R).norm(), 1e-12);
  EXPECT_LT((fit.p_m - p).norm(), 1e-12);
  EXPECT_LT(fit.rms_m, 1e-12);
}

TEST(FitRigid, IsARotationEvenWhereAReflectionWouldFitBetter) {
  const Eigen::Matrix3Xd local = test::forearm_shape();
  Eigen::Matrix3Xd mirrored = local;
  mirrored.row(0) *= -1.0;
  EXPECT_NEAR(fit_rigid(local, mirrored).R.determinant(), 1.0, 1e-12);
  EXPECT_THROW((void)fit_rigid(local.leftCols(2), mirrored.leftCols(2)), InvalidInput);
}

TEST(MeanShape, HasTheDistancesOfTheSegment) {
  const auto markers = test::moving_markers();
  const Eigen::Matrix3Xd shape = mean_shape(markers, test::forearm());
  // 400 frames of 0.5 mm noise leave 0.03 mm.
  EXPECT_LT(fit_rigid(shape, test::forearm_shape()).rms_m, 1e-4);
}

TEST(RigidSegments, ThatMoveAsAWholeAreNotComplainedOf) {
  EXPECT_TRUE(check_rigid_segments(test::moving_markers(400, 100.0, 0.003), {test::forearm()}).empty());
}

TEST(RigidSegments, TheMarkerThatCameLooseIsNamedOnceWithItsTime) {
  auto markers = test::moving_markers();
  markers.positions_m.block(200, 6, 100, 1).array() += 0.06;  // C, from 2 to 2.99 s
  const auto faults = check_rigid_segments(markers, {test::forearm()});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, RemarkCode::segment_not_rigid);
  EXPECT_EQ(faults[0].about, "C");
  EXPECT_NEAR(faults[0].when->begin_s, 2.0, 0.2);
  EXPECT_NEAR(faults[0].when->end_s, 2.99, 0.2);
  EXPECT_GT(*faults[0].value, 0.03);
}

TEST(RigidSegments, OfTwoMarkersBothAreNamed) {
  auto markers = test::moving_markers();
  markers.positions_m.block(200, 7, 50, 1).array() += 0.08;
  const auto faults = check_rigid_segments(markers, {{"forearm", {1, 2}}});
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].about, "B, C");
}

}  // namespace
}  // namespace myoid::recording
