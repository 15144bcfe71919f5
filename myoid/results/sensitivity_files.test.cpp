#include "myoid/results/sensitivity_files.h"

#include <gtest/gtest.h>

#include "myoid/simulation/arm.h"
#include "myoid/tables/storage_reader.h"

#include "tests/support/temporary_folder.h"

namespace myoid {
namespace {

TEST(SensitivityFiles, HaveAColumnPerParameterAndAFilePerQuantity) {
  const test::TemporaryFolder folder;
  simulation::SimulationInput input;
  std::vector<std::string> muscles;
  const simulation::Arm<double> arm = simulation::make_arm();
  for (const auto& m : arm.muscles) {
    muscles.push_back(m.name);
    input.excitation.push_back(simulation::constant(0.1));
  }
  const std::vector<std::string> names = {"BIC.max_isometric_force", "arm_inertia", "start_angle"};
  const simulation::Sensitivities s =
      simulation::simulate_sensitivities(arm, input, {.q = {1.0}}, {.end_s = 0.1, .output_rate_hz = 100.0}, names);
  write_sensitivities(s, muscles, {.options_json = "{}"}, folder.path());
  for (const char* file : {"angle", "speed", "acceleration", "torque", "device", "BIC_activation", "TRI_fiber_length",
                           "BRD_tendon_force"}) {
    const recording::Storage read =
        recording::read_storage(folder.path() / "sensitivities" / (std::string(file) + ".sto"));
    EXPECT_EQ(read.data.sample_count(), 11) << file;
    EXPECT_EQ(read.data.channel_count(), 3) << file;
  }
  const recording::Storage angle = recording::read_storage(folder.path() / "sensitivities/angle.sto");
  EXPECT_EQ(angle.data.column("start_angle")[0], 1.0);
  EXPECT_EQ(angle.data.column("arm_inertia")[10], s.angle(10, 1));
}

}  // namespace
}  // namespace myoid
