#include "myoid/body/simulation/simulation_record.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/names.h"

namespace myoid::body {
namespace {

std::string columns(const TimeSeries& series) { return name_list(series.channels(), &Channel::name); }

TEST(SimulationRecord, NamesEveryColumnAndKeepsTheRowsThatWereReached) {
  SimulationRecord record({"BIC", "TRI"}, {{"shoulder", true}, {"slide", false}}, 3, true);
  for (auto* m : {&record.motion, &record.torque, &record.energy, &record.moment_arm, &record.excitation,
                  &record.activation, &record.length, &record.velocity, &record.fiber_length, &record.fiber_velocity,
                  &record.tendon_length, &record.fiber_force, &record.tendon_force})
    m->setConstant(1.0);
  record.tendon_force(1, 1) = 7.0;
  Simulation result;
  record.write_to(result, Eigen::Vector2d(0.0, 0.1));
  EXPECT_EQ(columns(result.motion),
            "shoulder, shoulder_speed, shoulder_acceleration, slide, slide_speed, slide_acceleration");
  EXPECT_EQ(result.motion.channels()[4].unit, Unit::meter_per_second);
  EXPECT_EQ(columns(result.torque).substr(0, 50), "shoulder/muscles, shoulder/gravity, shoulder/joint");
  EXPECT_EQ(result.torque.channels()[5].unit, Unit::newton);
  EXPECT_EQ(columns(result.moment_arm), "shoulder/BIC, shoulder/TRI, slide/BIC, slide/TRI");
  EXPECT_EQ(columns(result.tendon_force), "BIC, TRI");
  EXPECT_EQ(result.tendon_force.column("TRI"), Eigen::Vector2d(1.0, 7.0));
  EXPECT_EQ(result.energy.channel_count(), 2 * 6 + 4 + 2 * 3 + 3);
}

TEST(SimulationRecord, OfOneCoordinateHasShortNamesAndNoEnergyUnlessAsked) {
  const SimulationRecord record({"BIC"}, {{"elbow", true}}, 1, false);
  Simulation result;
  record.write_to(result, Eigen::Matrix<double, 1, 1>(0.0));
  EXPECT_EQ(columns(result.torque), "muscles, gravity, joint, external, device");
  EXPECT_EQ(columns(result.moment_arm), "BIC");
  EXPECT_EQ(result.energy.channel_count(), 0);
}

}  // namespace
}  // namespace myoid::body
