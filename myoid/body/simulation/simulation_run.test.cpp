#include "myoid/body/simulation/simulation_run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::body {
namespace {

TEST(SimulationRun, OutputTimesBeginAtTheStartAndDoNotPassTheEnd) {
  const SimulationStart start{.time_s = 1.0};
  EXPECT_THAT(output_times(start, {.end_s = 2.0, .output_rate_hz = 4.0}),
              testing::ElementsAre(1.0, 1.25, 1.5, 1.75, 2.0));
  EXPECT_THAT(output_times(start, {.end_s = 1.6, .output_rate_hz = 4.0}), testing::ElementsAre(1.0, 1.25, 1.5));
  EXPECT_THAT(output_times(start, {.end_s = 2.0, .output_times_s = {1.5, 2.0}}), testing::ElementsAre(1.5, 2.0));
  EXPECT_THROW((void)output_times(start, {.end_s = 2.0, .output_times_s = {0.5}}), InvalidInput);
  EXPECT_THROW((void)output_times(start, {.end_s = 1e9, .output_rate_hz = 1e5}), InvalidInput);
}

}  // namespace
}  // namespace myoid::body
