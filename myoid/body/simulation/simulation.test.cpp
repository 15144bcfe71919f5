#include "myoid/body/simulation/simulation.h"

#include <gtest/gtest.h>

#include "myoid/body/simulation/arm_model.h"
#include "myoid/body/simulation/forward_simulation.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

TEST(Device, ALockedCoordinateDoesNotAccelerate) { EXPECT_EQ(locked().acceleration(7.0), 0.0); }

// One wrong entry breaks the balance: each entry in turn is off by 0.01 J of some 10 J.
TEST(EnergyBalance, SeesAnErrorInAnyEntry) {
  ArmSetup setup;
  setup.model.mode = muscle::TendonMode::mass;
  const SimulationModel arm = make_arm_model(setup);
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
}  // namespace myoid::body
