#include "myoid/body/simulation/tree_dynamics.h"

#include <random>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

struct RandomState {
  Eigen::VectorXd q, qdot, tau;
};

RandomState random_state(Eigen::Index n, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  RandomState s{Eigen::VectorXd(n), Eigen::VectorXd(n), Eigen::VectorXd(n)};
  for (Eigen::Index k = 0; k < n; ++k) {
    s.q[k] = 0.7 * uniform(generator);
    s.qdot[k] = 3.0 * uniform(generator);
    s.tau[k] = 10.0 * uniform(generator);
  }
  return s;
}

/// Forward dynamics inverts inverse dynamics; the mass matrix follows column by column.
void expect_consistent(const body::BodyModel& body, std::uint64_t seed) {
  const auto n = static_cast<Eigen::Index>(body.coordinates.size());
  const RandomState s = random_state(n, seed);
  TreeDynamics dynamics(body);
  dynamics.set(s.q, s.qdot);
  body::BodyState state = body::make_state(body);
  const Eigen::MatrixXd mass = body::mass_matrix(body, s.q, state);
  const double scale = mass.cwiseAbs().maxCoeff();
  // Round-off of composite inertias about the ground's origin, some meters away.
  EXPECT_LT((dynamics.mass_matrix() - mass).cwiseAbs().maxCoeff(), 1e-11 * scale) << seed;

  const std::vector<char> is_free(body.coordinates.size(), 0);
  Eigen::VectorXd qddot = Eigen::VectorXd::Zero(n);
  Eigen::VectorXd device(n);
  ASSERT_TRUE(dynamics.accelerate(s.tau.data(), is_free.data(), qddot.data(), device.data()));
  const Eigen::VectorXd back = body::inverse_dynamics(body, s.q, s.qdot, qddot, {}, state);
  EXPECT_LT((back - s.tau).cwiseAbs().maxCoeff(), 1e-8 * (1.0 + s.tau.cwiseAbs().maxCoeff())) << seed;

  // A force and moment on the outermost body, as inverse dynamics counts it.
  const body::BodyWrench wrench{
      .body = static_cast<int>(body.bodies.size()) - 1, .f_G = Vec3(3.0, -20.0, 5.0), .m_G = Vec3(1.0, 0.5, -2.0)};
  Eigen::VectorXd pushed = Eigen::VectorXd::Zero(n);
  dynamics.add(wrench, pushed);
  const Eigen::VectorXd without = body::inverse_dynamics(body, s.q, s.qdot, qddot, std::vector{wrench}, state);
  EXPECT_LT((back - pushed - without).cwiseAbs().maxCoeff(),
            1e-9 * (1.0 + pushed.cwiseAbs().maxCoeff() + s.tau.cwiseAbs().maxCoeff()));

  // Every other coordinate is prescribed: the devices' forces are the difference to inverse dynamics.
  std::vector<char> some(body.coordinates.size(), 0);
  for (std::size_t k = 0; k < some.size(); k += 2) some[k] = 1;
  qddot.setConstant(2.0);
  ASSERT_TRUE(dynamics.accelerate(s.tau.data(), some.data(), qddot.data(), device.data()));
  const Eigen::VectorXd all = body::inverse_dynamics(body, s.q, s.qdot, qddot, {}, state);
  EXPECT_LT((all - s.tau - device).cwiseAbs().maxCoeff(), 1e-7 * (1.0 + all.cwiseAbs().maxCoeff()));
  EXPECT_EQ(qddot[0], 2.0);
}

TEST(TreeDynamics, ForwardDynamicsUndoesInverseDynamics) {
  const body::BodyModel arm = body::parse_osim(body::arm4_osim({.forearm_rotations = true}), "arm4.osim");
  for (std::uint64_t seed = 1; seed <= 5; ++seed) expect_consistent(arm, seed);
}

TEST(TreeDynamics, ForwardDynamicsUndoesInverseDynamicsInModelsOfOthers) {
  const auto folder = test::data_folder();
  MYOID_REQUIRE_DATA(folder / "opensim/gait2354/model.osim");
  for (const char* file : {"opensim/arm26/model.osim", "opensim/gait2354/model.osim"}) {
    const body::BodyModel body = body::read_osim(folder / file);
    for (std::uint64_t seed = 1; seed <= 3; ++seed) expect_consistent(body, seed);
  }
}

// d(energy)/dt = power of gravity and motion: the derivative of the potential is minus gravity.
TEST(TreeDynamics, GravityIsTheDerivativeOfItsEnergy) {
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const RandomState s = random_state(4, 9);
  TreeDynamics dynamics(arm);
  dynamics.set(s.q, s.qdot);
  const Eigen::VectorXd gravity = dynamics.gravity();
  for (Eigen::Index k = 0; k < 4; ++k) {
    const double h = 1e-6;
    Eigen::VectorXd q = s.q;
    q[k] += h;
    dynamics.set(q, s.qdot);
    const double up = dynamics.gravity_energy_j();
    q[k] -= 2.0 * h;
    dynamics.set(q, s.qdot);
    // Round-off of 100 J over 2 h: 1e-8; truncation h^2.
    EXPECT_NEAR(gravity[k], -(up - dynamics.gravity_energy_j()) / (2.0 * h), 1e-7);
  }
}

}  // namespace
}  // namespace myoid::body
