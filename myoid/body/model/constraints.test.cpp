#include "myoid/body/model/constraints.h"

#include <cmath>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {
namespace {

constexpr double kLengths[3] = {0.4, 0.3, 0.35};
const Vec3 kEnd(0.45, -0.2, 0.0);

/// Three bars in a plane, each turning on the end of the one before; the last ends at a point of ground.
BodyModel four_bar() {
  std::string bodies, joints;
  for (int k = 0; k < 3; ++k) {
    const std::string parent = k == 0 ? "/ground" : fmt::format("/bodyset/b{}", k - 1);
    bodies += fmt::format("<Body name=\"b{}\"><mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body>", k);
    joints += fmt::format(
        "<PinJoint name=\"j{0}\"><socket_parent_frame>at</socket_parent_frame>"
        "<socket_child_frame>/bodyset/b{0}</socket_child_frame><coordinates>"
        "<Coordinate name=\"q{0}\"/></coordinates><frames><PhysicalOffsetFrame name=\"at\">"
        "<socket_parent>{1}</socket_parent><translation>{2} 0 0</translation>"
        "</PhysicalOffsetFrame></frames></PinJoint>",
        k, parent, k == 0 ? 0.0 : kLengths[k - 1]);
  }
  return parse_osim(fmt::format("<OpenSimDocument Version=\"40000\"><Model name=\"m\"><BodySet><objects>{}"
                                "</objects></BodySet><JointSet><objects>{}</objects></JointSet><ConstraintSet>"
                                "<objects><PointConstraint name=\"p\"><socket_body_1>/ground</socket_body_1>"
                                "<socket_body_2>/bodyset/b2</socket_body_2><location_body_1>{} {} 0"
                                "</location_body_1><location_body_2>{} 0 0</location_body_2></PointConstraint>"
                                "</objects></ConstraintSet></Model></OpenSimDocument>",
                                bodies, joints, kEnd.x(), kEnd.y(), kLengths[2]),
                    "m.osim");
}

/// The least distance of q from a posture that closes the loop: by the first angle in steps of
/// 1e-4, the others in closed form.
double least_distance(const Eigen::Vector3d& q) {
  double least = 1e9;
  for (double q0 = q[0] - 1.5; q0 < q[0] + 1.5; q0 += 1e-4) {
    const Eigen::Vector2d knee = kLengths[0] * Eigen::Vector2d(std::cos(q0), std::sin(q0));
    const Eigen::Vector2d to_end = kEnd.head<2>() - knee;
    const double r = to_end.norm();
    const double cosine =
        (r * r - kLengths[1] * kLengths[1] - kLengths[2] * kLengths[2]) / (2.0 * kLengths[1] * kLengths[2]);
    if (std::abs(cosine) > 1.0) continue;
    for (const double sign : {1.0, -1.0}) {
      const double q2 = sign * std::acos(cosine);
      const double direction = std::atan2(to_end.y(), to_end.x());
      const double q1 =
          direction - q0 - std::atan2(kLengths[2] * std::sin(q2), kLengths[1] + kLengths[2] * std::cos(q2));
      const auto turned = [](double angle) { return std::remainder(angle, 2.0 * 3.14159265358979); };
      const Eigen::Vector3d gap(q0 - q[0], turned(q1 - q[1]), turned(q2 - q[2]));
      least = std::min(least, gap.norm());
    }
  }
  return least;
}

// A posture that breaks a loop by up to 0.2 rad a joint becomes the nearest one. The grid's step of
// 1e-4 rad adds its square over the distance at the most, far below 1e-5.
TEST(Assemble, TakesTheNearestPostureThatClosesTheLoop) {
  const BodyModel m = four_bar();
  const Eigen::VectorXd closed = assemble(m, Eigen::Vector3d(0.8, -1.8, -0.3)).q;
  std::mt19937 random(17);
  std::uniform_real_distribution<double> number(-0.2, 0.2);
  for (int trial = 0; trial < 20; ++trial) {
    const Eigen::Vector3d q = closed + Eigen::Vector3d::NullaryExpr([&] { return number(random); });
    const AssemblyResult found = assemble(m, q);
    ASSERT_TRUE(found.converged);
    BodyState state = make_state(m);
    compute_poses(m, found.q, state);
    EXPECT_LT(loop_equations(m, state).errors.norm(), 1e-9);
    EXPECT_NEAR((found.q - q).norm(), least_distance(q), 1e-5);
  }
}

}  // namespace
}  // namespace myoid::body
