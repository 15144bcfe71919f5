#include "myoid/body/simulation/model_parameters.h"

#include <set>

#include <gtest/gtest.h>

#include "myoid/body/simulation/arm_model.h"
#include "myoid/ground/core/error.h"

namespace myoid::body {
namespace {

TEST(ModelParameters, EachHasANameOfItsOwnAndCanBeSet) {
  SimulationModel arm = make_arm_model();
  const std::vector<ModelParameter> all = model_parameters(arm);
  std::set<std::string> names;
  for (const ModelParameter& parameter : all) names.insert(parameter.name);
  EXPECT_EQ(names.size(), all.size());
  // Muscles with the times of their activation, the elbow, trunk, upper arm and forearm, gravity.
  EXPECT_EQ(names.size(), 4u * (16u + 3u) + 9u + 3u * 7u + 3u);
  *model_parameter(arm, "BRD.optimal_fiber_length").value = 0.2;
  EXPECT_EQ(arm.muscles[2].parameters.hill.optimal_fiber_length_m, 0.2);
  *model_parameter(arm, "forearm_hand.mass_center_y").value = -0.3;
  EXPECT_EQ(arm.body.bodies.back().p_BBcm_B.y(), -0.3);
  EXPECT_THROW((void)model_parameter(arm, "BRD.colour"), InvalidInput);
}

TEST(ModelParameters, DampingOfZeroIsLeftOut) {
  SimulationModel arm = make_arm_model();
  arm.muscles[0].parameters.damping = 0.0;
  EXPECT_THROW((void)model_parameter(arm, "BIC.damping"), InvalidInput);
  EXPECT_EQ(*model_parameter(arm, "BRA.damping").value, arm.muscles[1].parameters.damping);
}

}  // namespace
}  // namespace myoid::body
