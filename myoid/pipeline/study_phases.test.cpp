#include "myoid/pipeline/study_phases.h"

#include <gtest/gtest.h>

namespace myoid::pipeline {
namespace {

std::vector<TrialPhases> phases_of_one_trial() {
  return {{"a",
           {{.kind = PhaseKind::warm_up, .begin_s = 0.0, .end_s = 6.0},
            {.kind = PhaseKind::regular, .begin_s = 6.0, .end_s = 40.0},
            {.kind = PhaseKind::fatigued, .begin_s = 40.0, .end_s = 60.0, .frequency = 0.85}}}};
}

TEST(ExcludePhases, TakesWhatTheRuleNames) {
  identification::StudyData data;
  data.trials.resize(1);
  auto phases = phases_of_one_trial();
  exclude_phases({"warm_up", "fatigued"}, phases, data);
  ASSERT_EQ(data.trials[0].excluded.size(), 2u);
  EXPECT_EQ(data.trials[0].excluded[1].begin_s, 40.0);
  EXPECT_TRUE(phases[0].phases[0].excluded);
  EXPECT_FALSE(phases[0].phases[1].excluded);
}

TEST(ExcludePhases, KeepsFatigueThatOnlyTheTorqueShows) {
  identification::StudyData data;
  data.trials.resize(1);
  auto phases = phases_of_one_trial();
  phases[0].phases[2].frequency.reset();
  exclude_phases({"fatigued"}, phases, data);
  EXPECT_TRUE(data.trials[0].excluded.empty());
}

}  // namespace
}  // namespace myoid::pipeline
