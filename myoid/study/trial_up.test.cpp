#include "myoid/study/trial_up.h"

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::study {
namespace {

TEST(Upright, IsOneForTheAxisThatPointsUp) {
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  body::BodyState state = body::make_state(arm);
  body::compute_poses(arm, arm.default_q(), state);
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::Zero(1);
  markers.positions_m.resize(1, static_cast<Eigen::Index>(3 * arm.markers.size()));
  for (std::size_t m = 0; m < arm.markers.size(); ++m) {
    markers.names.push_back(arm.markers[m].name);
    const Vec3 p = state.X_GB[static_cast<std::size_t>(arm.markers[m].body)] * arm.markers[m].p_BM;
    markers.positions_m.block<1, 3>(0, static_cast<Eigen::Index>(3 * m)) =
        (rotation_to_y_up('z').transpose() * p).transpose();
  }
  EXPECT_NEAR(upright(arm, markers, Vec3::UnitZ()).value(), 1.0, 1e-9);
  EXPECT_LT(upright(arm, markers, Vec3::UnitY()).value(), 0.1);
  const auto axis = upright_axis(arm, markers, {"x", "y", "z", "-z"});
  ASSERT_TRUE(axis);
  EXPECT_EQ(axis->name, "z");
  EXPECT_NEAR(axis->cosine, 1.0, 1e-9);
  markers.names.assign(markers.names.size(), "unknown");
  EXPECT_FALSE(upright(arm, markers, Vec3::UnitZ()));
  EXPECT_FALSE(upright_axis(arm, markers, {"x", "y", "z"}));
}

}  // namespace
}  // namespace myoid::study
