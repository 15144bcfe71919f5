#include "myoid/body/dynamics/contact_force.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {
namespace {

/// A free ball of radius 0.1 m over the ground y = 0.
struct Ball {
  body::BodyModel body = body::parse_osim(
      R"(<OpenSimDocument Version="40000"><Model name="m"><BodySet><objects><Body name="ball">
<mass>1</mass><inertia>1 1 1 0 0 0</inertia></Body></objects></BodySet><JointSet><objects>
<FreeJoint name="j"><socket_parent_frame>/ground</socket_parent_frame><socket_child_frame>
/bodyset/ball</socket_child_frame><coordinates><Coordinate name="a"/><Coordinate name="b"/>
<Coordinate name="c"/><Coordinate name="x"/><Coordinate name="y"/><Coordinate name="z"/>
</coordinates></FreeJoint></objects></JointSet></Model></OpenSimDocument>)",
      "ball.osim");
  body::Contact contact;

  Ball() {
    contact.sphere_body = 1;
    contact.radius_m = 0.1;
    contact.X_BO.R = Eigen::AngleAxisd(-0.5 * kPi, Vec3::UnitZ()).toRotationMatrix();  // x of the floor is down
    contact.materials.fill({.stiffness = 1e6,
                            .dissipation = 2.0,
                            .static_friction = 0.8,
                            .dynamic_friction = 0.5,
                            .viscous_friction = 0.1});
    contact.transition_velocity_mps = 0.1;
  }

  /// Force on the ball (about its center) and on ground, at a height and a velocity of its center.
  std::vector<body::BodyWrench> wrenches(double height_m, const Vec3& v) const {
    body::BodyState state = body::make_state(body);
    Eigen::VectorXd q = Eigen::VectorXd::Zero(6), u = q;
    q[4] = height_m;
    u.tail<3>() = v;
    body::compute_poses(body, q, state);
    body::compute_velocities(body, u, state);
    std::vector<body::BodyWrench> all;
    append_contact(contact, state, all);
    return all;
  }
  Vec3 force(double height_m, const Vec3& v) const {
    const auto all = wrenches(height_m, v);
    return all.empty() ? Vec3(Vec3::Zero()) : all[0].f_G;
  }
};

// Two surfaces of modulus E: each gives way by half, 4/3 sqrt(R) (E^(2/3) x / 2)^(3/2).
double hertz(double depth_m) { return 4.0 / 3.0 * std::sqrt(0.1) * 1e6 * std::pow(0.5 * depth_m, 1.5); }

TEST(Contact, PushesAsHertzSaysWhereTheBallOverlapsTheGroundAndNotAbove) {
  const Ball ball;
  EXPECT_EQ(ball.force(0.1001, Vec3::Zero()), Vec3::Zero());
  const Vec3 f = ball.force(0.098, Vec3::Zero());
  EXPECT_NEAR(f.y(), hertz(0.002), 1e-9 * hertz(0.002));
  EXPECT_NEAR(f.x(), 0.0, 1e-12);
}

TEST(Contact, ResistsTheApproachAndNeverPulls) {
  const Ball ball;
  const double rest = hertz(0.002);
  EXPECT_NEAR(ball.force(0.098, Vec3(0.0, -0.1, 0.0)).y(), rest * (1.0 + 1.5 * 2.0 * 0.1), 1e-9 * rest);
  EXPECT_EQ(ball.force(0.098, Vec3(0.0, 5.0, 0.0)).y(), 0.0);
}

TEST(Contact, FrictionActsAgainstSlidingByItsCoefficients) {
  const Ball ball;
  const double rest = hertz(0.002);
  // Far beyond the transition: dynamic and viscous friction. At it: min(1) (ud + (us - ud)).
  const double fast = 0.5 + 2.0 * 0.3 / (1.0 + 100.0) + 0.1 * 1.0;
  EXPECT_NEAR(ball.force(0.098, Vec3(1.0, 0.0, 0.0)).x(), -rest * fast, 1e-9 * rest);
  EXPECT_NEAR(ball.force(0.098, Vec3(0.0, 0.0, 0.1)).z(), -rest * (0.8 + 0.01), 1e-9 * rest);
}

TEST(Contact, TheBodiesPushEachOtherAlikeAndLoseEnergy) {
  const Ball ball;
  const Vec3 v(0.4, -0.2, 0.3);
  const auto all = ball.wrenches(0.097, v);
  ASSERT_EQ(all.size(), 2U);
  EXPECT_LT((all[0].f_G + all[1].f_G).norm(), 1e-12);
  // About the origin of ground nothing is left over.
  EXPECT_LT((all[0].m_G + Vec3(0.0, 0.097, 0.0).cross(all[0].f_G) + all[1].m_G).norm(), 1e-9);
  const Vec3 rest = ball.force(0.097, Vec3::Zero());
  EXPECT_LT(all[0].f_G.dot(v), rest.dot(v));
}

TEST(Contact, TheSmoothOneIsTheSameDeepInsideAndFadesOutAbove) {
  Ball smooth;
  smooth.contact.smoothing = body::Contact::Smoothing{};
  const Ball hard;
  for (const Vec3& v : {Vec3(0.0, -0.1, 0.0), Vec3(0.5, 0.0, 0.2)}) {
    // At 3 cm the tangents have saturated (1 - tanh 9 = 3e-8); the constant adds 3/4 c / x^2.
    const Vec3 a = smooth.force(0.07, v), b = hard.force(0.07, v);
    EXPECT_LT((a - b).norm(), 0.02 * b.norm());
  }
  EXPECT_GT(smooth.force(0.1, Vec3::Zero()).y(), 0.0);
  EXPECT_LT(smooth.force(0.2, Vec3::Zero()).y(), 1e-12);
}

TEST(Contact, TwoSpheresTouchAlongTheLineOfTheirCenters) {
  Ball ball;
  ball.contact.X_BO = {Mat3::Identity(), Vec3(0.0, -0.05, 0.0)};
  ball.contact.other_radius_m = 0.05;
  const double rest = hertz(0.002) * std::sqrt((0.1 * 0.05 / 0.15) / 0.1);
  const Vec3 f = ball.force(0.098, Vec3::Zero());
  EXPECT_NEAR(f.y(), rest, 1e-9 * rest);
}

}  // namespace
}  // namespace myoid::body
