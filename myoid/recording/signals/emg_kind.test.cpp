#include "myoid/recording/signals/emg_kind.h"

#include <gtest/gtest.h>

#include "myoid/ground/math/random.h"

namespace myoid::recording {
namespace {

TEST(EmgKind, RawRectifiedAndSmoothedEmgAreToldApart) {
  math::Random random(5);
  Eigen::VectorXd raw(4000);
  for (double& sample : raw) sample = 1e-4 * random.normal();
  const Eigen::VectorXd rectified = raw.cwiseAbs();
  const Eigen::VectorXd smooth = 1e-4 * (1.0 - (Eigen::ArrayXd::LinSpaced(4000, 0.0, 20.0)).cos());
  const Eigen::VectorXd on_offset = raw.array() + 2.5;
  EXPECT_TRUE(is_rectified(rectified));
  EXPECT_TRUE(is_envelope(smooth, 1000.0));
  EXPECT_FALSE(is_envelope(rectified, 1000.0));
  for (const Eigen::VectorXd& x : {raw, on_offset}) {
    EXPECT_FALSE(is_rectified(x));
    EXPECT_FALSE(is_envelope(x, 1000.0));
  }
  EXPECT_FALSE(is_rectified(Eigen::VectorXd::Zero(100)));
}

}  // namespace
}  // namespace myoid::recording
