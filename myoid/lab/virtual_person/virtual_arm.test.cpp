#include "myoid/lab/virtual_person/virtual_arm.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/lab/virtual_person/true_arm.h"

namespace myoid::lab {
namespace {

Vec3 marker_m(const VirtualArm& arm, const Eigen::MatrixXd& markers, const std::string& name) {
  const auto names = arm.marker_names();
  const auto at = std::find(names.begin(), names.end(), name) - names.begin();
  return markers.block<1, 3>(0, 3 * at).transpose();
}

TEST(VirtualArm, MarkersReproduceTheAngleOfTheElbow) {
  // No kinematics of ours: the angle between shoulder-elbow and elbow-wrist, by the scalar product.
  const VirtualArm arm(VirtualSubject{});
  for (const Plane plane : {Plane::vertical, Plane::horizontal}) {
    for (double q = 0.3; q < 2.5; q += 0.2) {
      const Eigen::MatrixXd markers = arm.markers_m(Eigen::VectorXd::Constant(1, q), plane);
      const Vec3 elbow = marker_m(arm, markers, "r_elbow");
      const Vec3 shoulder = marker_m(arm, markers, "r_acromion") - Vec3(0.0, 0.05, 0.0);
      const Vec3 wrist = marker_m(arm, markers, "r_wrist");
      EXPECT_NEAR((elbow - shoulder).norm(), 0.30, 1e-14);
      EXPECT_NEAR((wrist - elbow).norm(), 0.2689, 1e-14);
      const double cosine = (elbow - shoulder).normalized().dot((wrist - elbow).normalized());
      EXPECT_NEAR(std::acos(cosine), q, 1e-12);
      if (plane == Plane::horizontal) {
        EXPECT_NEAR(wrist.y(), shoulder.y(), 1e-12);
      }
    }
  }
}

TEST(VirtualArm, MuscleVelocityIsTheChangeOfLength) {
  const VirtualArm arm(VirtualSubject{});
  const double h = 1e-6;  // s: differences of lengths lose 1e-16 / h
  const Moment now{1.1, 2.5, 0.0};
  const MuscleGeometry before = arm.geometry({1.1 - 2.5 * h, 2.5, 0.0});
  const MuscleGeometry after = arm.geometry({1.1 + 2.5 * h, 2.5, 0.0});
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR((after.length_m[i] - before.length_m[i]) / (2 * h), arm.geometry(now).velocity_mps[i], 1e-9);
  }
}

TEST(VirtualArm, AWomansArmIsLighter) {
  const VirtualArm man(VirtualSubject{});
  const VirtualArm woman(VirtualSubject{.sex = "female"});
  EXPECT_LT(required_torque_nm(woman.elbow, 1.5, 0.0, Plane::vertical, 0.0),
            required_torque_nm(man.elbow, 1.5, 0.0, Plane::vertical, 0.0));
  EXPECT_EQ(required_torque_nm(man.elbow, 1.5, 0.0, Plane::horizontal, 3.0), 0.0);
}

}  // namespace
}  // namespace myoid::lab
