#include "myoid/simulation/simulation.h"

#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/simulation/forward_simulation.h"

namespace myoid::simulation {
namespace {

TEST(Device, IsokineticMovementComesToItsSpeedAndToRest) {
  const Device device = isokinetic(1.0, 2.0, 3.0, 0.1);
  EXPECT_EQ(device.acceleration(0.5), 0.0);
  EXPECT_DOUBLE_EQ(device.acceleration(1.05), 30.0);
  EXPECT_EQ(device.acceleration(1.5), 0.0);
  EXPECT_DOUBLE_EQ(device.acceleration(2.05), -30.0);
  EXPECT_EQ(device.acceleration(2.5), 0.0);
  EXPECT_EQ(device.jumps_s, (std::vector{1.0, 1.1, 2.0, 2.1}));
  EXPECT_THROW((void)isokinetic(1.0, 1.05, 3.0, 0.1), InvalidInput);
  EXPECT_EQ(locked().acceleration(7.0), 0.0);
}

// One wrong entry breaks the balance: each entry in turn is off by 0.01 J of some 10 J.
TEST(EnergyBalance, SeesAnErrorInAnyEntry) {
  const Arm<double> arm = with_tendon_mode(make_arm(), muscle::TendonMode::mass);
  SimulationInput in;
  const Burst burst[] = {{0.1, 0.3, 0.5}};
  for (int i = 0; i < 4; ++i) in.excitation.push_back(bursts(burst, 0.05));
  Simulation s = simulate(arm, in, {.q = {1.0}}, {.end_s = 1.0, .output_rate_hz = 2, .energy = true});
  EXPECT_LT(energy_balance(s).worst, 1e-6);
  const TimeSeries good = s.energy;
  for (Eigen::Index c = 0; c < good.channel_count(); ++c) {
    Eigen::MatrixXd values = good.values();
    values(values.rows() - 1, c) += 0.01;
    s.energy = TimeSeries(good.time_s(), good.channels(), values);
    EXPECT_GT(energy_balance(s).worst, 1e-5) << good.channels()[static_cast<std::size_t>(c)].name;
  }
}

}  // namespace
}  // namespace myoid::simulation
