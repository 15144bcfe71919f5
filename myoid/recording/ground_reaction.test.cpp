#include "myoid/recording/ground_reaction.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/marker_series.h"

namespace myoid::recording {
namespace {

/// A plate in a laboratory with z up: unloaded, 300 N at x = 0.1 m, unloaded, 300 N at x = 0.4 m.
ForcePlate plate() {
  ForcePlate p;
  p.number = 2;
  p.p_GP_m = Vec3(0.2, 0.3, 0.0);
  p.time_s = Eigen::VectorXd::LinSpaced(5, 0.0, 0.004);
  p.force_n = Eigen::MatrixXd::Zero(5, 3);
  p.force_n.col(2) << 3.0, 300.0, -15.0, 300.0, 3.0;  // an offset that pulls is no load
  p.force_n.col(0).setConstant(10.0);
  p.moment_nm = Eigen::MatrixXd::Zero(5, 3);
  p.pressure_center_m = Eigen::MatrixXd::Constant(5, 3, std::nan(""));
  p.pressure_center_m.row(1) << 0.1, 0.2, 0.0;
  p.pressure_center_m.row(3) << 0.4, 0.2, 0.0;
  p.free_moment_nm = Eigen::MatrixXd::Zero(5, 3);
  p.free_moment_nm(1, 2) = 5.0;
  return p;
}

TEST(GroundReaction, IsTurnedToYUpWithoutGaps) {
  std::vector<Repair> repairs;
  const TimeSeries s = ground_reaction({plate()}, {.R_YG = rotation_to_y_up('z')}, repairs);
  EXPECT_EQ(s.channels()[0].name, "ground_force_2_vx");
  EXPECT_EQ(s.channels()[8].name, "ground_torque_2_z");
  Eigen::MatrixXd expected(5, 9);
  expected << 0, 0, 0, 0.1, 0, -0.2, 0, 0, 0,  //
      10, 300, 0, 0.1, 0, -0.2, 0, 5, 0,       //
      0, 0, 0, 0.25, 0, -0.2, 0, 0, 0,         //
      10, 300, 0, 0.4, 0, -0.2, 0, 0, 0,       //
      0, 0, 0, 0.4, 0, -0.2, 0, 0, 0;
  EXPECT_LT((s.values() - expected).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(GroundReaction, WithoutPlatesIsRefused) {
  std::vector<Repair> repairs;
  EXPECT_THROW(static_cast<void>(ground_reaction({}, {}, repairs)), InvalidInput);
}

TEST(GroundReaction, AHandleThatIsPulledAlongItsSurfaceActsAtItsMiddle) {
  ForcePlate handle = plate();
  handle.side.is_floor = false;
  handle.corners_m << 0.25, 0.15, 0.15, 0.25,  //
      0.35, 0.35, 0.25, 0.25,                  //
      0.0, 0.0, 0.0, 0.0;
  handle.force_n.row(1) << 200.0, 0.0, -3.0;
  handle.moment_nm.row(1) << 1.0, 2.0, 3.0;
  std::vector<Repair> repairs;
  const TimeSeries s = ground_reaction({handle}, {}, repairs);
  Eigen::RowVectorXd expected(9);
  expected << 200, 0, -3, 0.2, 0.3, 0, 1, 2, 3;
  EXPECT_EQ(s.values().row(1), expected);
}

TEST(GroundReaction, TheLoadsFileNamesTheColumns) {
  const std::string text = format_external_loads("walk", {1, 2}, {"calcn_r", "toes & heel"}, "walk_grf.mot");
  for (const char* part :
       {"<applied_to_body>calcn_r<", "toes &amp; heel", "<force_identifier>ground_force_2_v<",
        "<point_identifier>ground_force_1_p<", "<torque_identifier>ground_torque_1_<", "<datafile>walk_grf.mot<"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace myoid::recording
