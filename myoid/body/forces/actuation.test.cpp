#include "myoid/body/forces/actuation.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/body/forces/actuator_columns.h"
#include "myoid/body/forces/driven_frame.h"

#include "tests/support/crooked_tree.h"

namespace myoid::body {
namespace {

/// A crooked tree with an actuator of every kind.
body::BodyModel driven_tree() {
  body::BodyModel m = test::crooked_tree(6);
  test::Uniform u(31);
  body::Muscle muscle;
  muscle.name = "muscle";
  muscle.path.points = {{.name = "a", .body = 0, .p_BP = u.vec()},
                        {.name = "b", .body = 2, .p_BP = u.vec()},
                        {.name = "c", .body = 3, .p_BP = u.vec()}};
  m.muscles.push_back(muscle);
  m.actuators.push_back({{.name = "motor"}, 4});
  const Vec3 rocket_point = u.vec();
  m.point_actuators.push_back({{.name = "rocket"}, 3, rocket_point, false, u.vec().normalized(), false});
  m.torque_actuators.push_back({{.name = "wheel"}, 4, 2, u.vec().normalized(), false});
  m.force_order = {"muscle", "motor", "rocket", "wheel"};
  return body::finalize(m);
}

struct Frame {
  body::JointMotion motion;
  TimeSeries forces;
};

Frame one_frame(const body::BodyModel& m) {
  test::Uniform u(32);
  std::vector<Channel> coordinates, actuators;
  for (const body::Coordinate& c : m.coordinates) coordinates.push_back({c.name, Unit::radian});
  for (const std::string& name : m.force_order) actuators.push_back({name, Unit::newton});
  const auto row = [&](const std::vector<Channel>& channels) {
    const auto n = static_cast<Eigen::Index>(channels.size());
    return TimeSeries(Eigen::VectorXd::Zero(1), channels,
                      Eigen::MatrixXd(10.0 * test::random_vector(n, u).transpose()));
  };
  return {{row(coordinates), row(coordinates), row(coordinates)}, row(actuators)};
}

// The power of every force is its virtual work by the bodies' velocities: summed over the wrenches
// that it exerts on bodies, which is another way than moment arms and speeds.
TEST(Actuation, PowersAreTheWorkOfTheForcesOnTheBodies) {
  const body::BodyModel m = driven_tree();
  const auto [motion, forces] = one_frame(m);
  const Actuation result = actuation(m, motion, forces);
  body::BodyState state = body::make_state(m);
  body::compute_poses(m, motion.q.values().row(0).transpose(), state);
  body::compute_velocities(m, motion.qdot.values().row(0).transpose(), state);
  ActuatorColumns columns(m);
  for (const Actuator& a : actuators_of(m)) {
    const double force = forces.column(a.name)[0];
    std::vector<body::BodyWrench> wrenches;
    columns.append_wrenches(a, force, state, wrenches);
    double power_w =
        a.kind == Actuator::Kind::coordinate ? force * motion.qdot.values()(0, m.actuators[a.index].coordinate) : 0.0;
    for (const body::BodyWrench& w : wrenches) {
      const auto b = static_cast<std::size_t>(w.body);
      power_w += w.f_G.dot(state.v_GB[b]) + w.m_G.dot(state.w_GB[b]);
    }
    EXPECT_NEAR(result.power_w.column(a.name)[0], power_w, 1e-10 * (1.0 + std::abs(power_w))) << a.name;
  }
  EXPECT_NEAR(result.power_w.column("muscle")[0], -forces.column("muscle")[0] * result.speed.column("muscle")[0],
              1e-12);
}

// The powers of all actuators and of gravity change the kinetic energy at the rate that forward
// dynamics makes: d(T)/dt = qdot . (M qddot + ...), by differences of T along the motion.
TEST(Actuation, PowersBalanceTheKineticEnergy) {
  body::BodyModel m = driven_tree();
  m.gravity_G.setZero();
  const auto [motion, forces] = one_frame(m);
  const Eigen::VectorXd q = motion.q.values().row(0).transpose();
  const Eigen::VectorXd qdot = motion.qdot.values().row(0).transpose();
  const Eigen::VectorXd qddot = driven_accelerations(m, motion, forces).row(0).transpose();
  const auto kinetic_j = [&](double t) {
    body::BodyState state = body::make_state(m);
    const Eigen::VectorXd rate = qdot + t * qddot;
    const Eigen::MatrixXd mass = body::mass_matrix(m, q + t * qdot + 0.5 * t * t * qddot, state);
    return 0.5 * rate.dot(mass * rate);
  };
  const double h = 1e-6;
  const double rate_w = (kinetic_j(h) - kinetic_j(-h)) / (2.0 * h);
  const double power_w = actuation(m, motion, forces).power_w.values().sum();
  // Differences: truncation h^2 T''', round-off 1e-16 T / h, of T around 1e4 J.
  EXPECT_NEAR(rate_w, power_w, 1e-5 * std::abs(rate_w) + 1e-4 * kinetic_j(0.0) * 1e-2);
}

TEST(Actuation, HasOpensimsSpeedsOfPointsAndTorques) {
  const body::BodyModel m = driven_tree();
  const auto [motion, forces] = one_frame(m);
  const Actuation result = actuation(m, motion, forces, {.speeds_of_opensim = true});
  body::BodyState state = body::make_state(m);
  body::compute_poses(m, motion.q.values().row(0).transpose(), state);
  body::compute_velocities(m, motion.qdot.values().row(0).transpose(), state);
  const Eigen::VectorXd qdot = motion.qdot.values().row(0).transpose();
  const Vec3 v = body::station_jacobian(m, state, 3, m.point_actuators[0].point) * qdot;
  EXPECT_NEAR(result.speed.column("rocket")[0], v.norm(), 1e-10);
  EXPECT_NEAR(result.speed.column("wheel")[0], m.torque_actuators[0].axis.dot(state.w_GB[4] - state.w_GB[2]), 1e-10);
}

}  // namespace
}  // namespace myoid::body
