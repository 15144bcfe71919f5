#include "myoid/body/dynamics/load_units.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::body {
namespace {

/// A step of 600 N on a plate whose middle is at (0.4, 0, 1.2) m, and its free moment.
struct Step {
  Eigen::MatrixX3d force_n, point_m, torque_nm;
  Step() : force_n(100, 3), point_m(100, 3), torque_nm(100, 3) {
    for (Eigen::Index i = 0; i < 100; ++i) {
      const double share = static_cast<double>(i) / 100.0;
      force_n.row(i) << 50.0 * std::cos(6.0 * share), 600.0 * std::sin(3.1 * share), 5.0;
      point_m.row(i) << 0.3 + 0.25 * share, 0.0, 1.2 + 0.02 * share;
      torque_nm.row(i) << 0.0, 8.0 - 14.0 * share, 0.0;
    }
  }
};

TEST(LoadUnits, PointsAndFreeMomentsAThousandTimesTooLargeAreInMillimeters) {
  const Step right;
  Step wrong;
  wrong.point_m *= 1e3;
  EXPECT_EQ(mend_load_units(wrong.force_n, wrong.point_m, wrong.torque_nm).size(), 1U);
  EXPECT_LT((wrong.point_m - right.point_m).cwiseAbs().maxCoeff(), 1e-12);
  wrong.torque_nm *= 1e3;
  EXPECT_EQ(mend_load_units(wrong.force_n, wrong.point_m, wrong.torque_nm).size(), 1U);
  EXPECT_LT((wrong.torque_nm - right.torque_nm).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(LoadUnits, ARightUnitStaysAlsoFarFromTheOriginOrWithANoisyPointOfAnEmptyPlate) {
  Step step;
  step.point_m.col(0).array() += 60.0;  // a plate 60 m along a track
  Step empty;
  empty.force_n.topRows(50).setZero();
  empty.point_m.topRows(50).setConstant(4e5);
  empty.point_m.row(3).setConstant(std::nan(""));
  for (Step* s : {&step, &empty}) {
    const Step before = *s;
    EXPECT_TRUE(mend_load_units(s->force_n, s->point_m, s->torque_nm).empty());
    EXPECT_EQ(s->point_m.bottomRows(90), before.point_m.bottomRows(90));
    EXPECT_EQ(s->torque_nm, before.torque_nm);
  }
  Step pure;  // a torque without a point is no free moment
  pure.torque_nm *= 1e3;
  pure.point_m.resize(0, 3);
  EXPECT_TRUE(mend_load_units(pure.force_n, pure.point_m, pure.torque_nm).empty());
}

}  // namespace
}  // namespace myoid::body
