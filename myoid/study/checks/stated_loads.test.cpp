#include "myoid/study/checks/stated_loads.h"

#include <gtest/gtest.h>

namespace myoid::study {
namespace {

TrialSpec trial(const std::string& name, Use use = Use::calibration) {
  TrialSpec spec;
  spec.name = name;
  spec.use = use;
  return spec;
}

TEST(UnstatedLoads, NameTheTrialsWhoseTorqueRestsOnThem) {
  std::vector<TrialSpec> trials{trial("a"), trial("b", Use::validation), trial("c", Use::mvc),
                                trial("d", Use::static_pose), trial("e", Use::isometric)};
  auto found = unstated_loads(trials);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->code, RemarkCode::loads_unstated);
  EXPECT_EQ(found->severity, Severity::warning);
  EXPECT_EQ(found->value, 3.0);
  trials[0].held_mass_kg = 0.0;
  trials[1].plates.emplace();
  EXPECT_EQ(unstated_loads(trials)->value, 1.0);
  trials[4].external_torque = "torque.sto";
  EXPECT_FALSE(unstated_loads(trials));
}

}  // namespace
}  // namespace myoid::study
