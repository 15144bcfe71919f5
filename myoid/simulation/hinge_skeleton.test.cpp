#include "myoid/simulation/hinge_skeleton.h"

#include <array>

#include <gtest/gtest.h>

namespace myoid::simulation {
namespace {

TEST(HingeSkeleton, AcceleratesAsTheEquationsOfTheArmSay) {
  const ArmDynamics<double> arm(make_arm({.held_mass_kg = 1.0}));
  HingeSkeleton skeleton(arm);
  const std::array y{1.1, -2.0};
  const std::array activation{0.3, 0.2, 0.1, 0.05};
  std::array<double, 2> ydot{};
  arm.rate(activation.data(), 0.7, y.data(), ydot.data());

  skeleton.set(y.data(), y.data() + 1);
  double tau = 0.7;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto r = muscle::musculotendon_rate(skeleton.unit(i),
                                              {activation[i], skeleton.length_m(i), skeleton.velocity_mps(i)}, {});
    tau += skeleton.moment_arm_m(i, 0) * r.tendon_force_n;
  }
  const char is_free = 0;
  double qddot = 0.0;
  double device = 0.0;
  skeleton.accelerate(&tau, &is_free, &qddot, &device);
  EXPECT_NEAR(qddot, ydot[1], 1e-12 * std::abs(ydot[1]));
  EXPECT_EQ(device, 0.0);
}

TEST(HingeSkeleton, ADeviceExertsWhatThePrescribedAccelerationTakes) {
  const ArmDynamics<double> arm(make_arm());
  HingeSkeleton skeleton(arm);
  const double q = 1.1;
  const double qdot = 0.5;
  skeleton.set(&q, &qdot);
  const char prescribed = 1;
  double tau = 2.0;
  double qddot = 5.0;
  double device = 0.0;
  skeleton.accelerate(&tau, &prescribed, &qddot, &device);
  EXPECT_EQ(qddot, 5.0);
  tau += device;
  const char is_free = 0;
  double again = 0.0;
  skeleton.accelerate(&tau, &is_free, &again, &device);
  EXPECT_NEAR(again, 5.0, 1e-12);
}

}  // namespace
}  // namespace myoid::simulation
