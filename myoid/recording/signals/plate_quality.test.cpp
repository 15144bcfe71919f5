#include "myoid/recording/signals/plate_quality.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::recording {
namespace {

/// A plate of 0.6 m x 0.4 m in a z-up laboratory; a person of 700 N crosses it between 1 and 2 s.
recording::ForcePlate plate() {
  recording::ForcePlate p;
  p.number = 1;
  p.type = 2;
  p.corners_m << 0.6, 0.0, 0.0, 0.6,  //
      0.4, 0.4, 0.0, 0.0,             //
      0.0, 0.0, 0.0, 0.0;
  p.p_GP_m = Vec3(0.3, 0.2, 0.0);
  const Eigen::Index n = 3000;
  p.time_s = Eigen::VectorXd::LinSpaced(n, 0.0, 2.999);
  p.force_n = Eigen::MatrixXd::Zero(n, 3);
  p.moment_nm = Eigen::MatrixXd::Zero(n, 3);
  p.pressure_center_m = Eigen::MatrixXd::Constant(n, 3, std::nan(""));
  for (Eigen::Index i = 1000; i < 2000; ++i) {
    const double s = static_cast<double>(i - 1000) / 1000.0;
    p.force_n(i, 2) = 700.0 * std::sin(M_PI * s);
    p.pressure_center_m.row(i) << 0.3, 0.1 + 0.2 * s, 0.0;
  }
  return p;
}

TEST(ForcePlateQuality, OfACleanPlateNothingIsSaid) { EXPECT_TRUE(check_force_plate(plate()).empty()); }

TEST(ForcePlateQuality, AnOffsetWhileEmptyIsSaid) {
  recording::ForcePlate p = plate();
  p.force_n.col(2).array() -= 23.0;
  const auto faults = check_force_plate(p);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, RemarkCode::plate_offset);
  EXPECT_NEAR(*faults[0].value, -23.0, 1e-9);
}

TEST(ForcePlateQuality, SomebodyWhoStandsOnItAllTheTimeIsNoOffset) {
  recording::ForcePlate p = plate();
  p.force_n.col(2).setConstant(700.0);
  EXPECT_TRUE(check_force_plate(p).empty());
}

TEST(ForcePlateQuality, AFileThatHoldsTheForceOnThePlateIsARemark) {
  recording::ForcePlate p = plate();
  p.side.turn = -1.0;
  const auto faults = check_force_plate(p);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, RemarkCode::plate_sign);
  EXPECT_EQ(faults[0].severity, Severity::note);
  EXPECT_NEAR(faults[0].when->begin_s, 1.5, 0.01);
}

TEST(ForcePlateQuality, PressureBesideThePlateIsSaidWithItsDistance) {
  recording::ForcePlate p = plate();
  p.pressure_center_m.col(1).array() += 0.25;  // up to 0.15 m beyond the edge at 0.4 m
  const auto faults = check_force_plate(p);
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].code, RemarkCode::plate_pressure_outside);
  EXPECT_NE(faults[0].says.find("mm"), std::string::npos);
  EXPECT_GT(*faults[0].value, 0.2);
}

}  // namespace
}  // namespace myoid::recording
