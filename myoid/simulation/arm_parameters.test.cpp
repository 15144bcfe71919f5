#include "myoid/simulation/arm_parameters.h"

#include <set>

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid::simulation {
namespace {

TEST(ArmParameters, EachHasANameOfItsOwnAndCanBeSet) {
  Arm<double> arm = make_arm();
  const std::vector<std::string> names = arm_parameter_names(arm);
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  EXPECT_EQ(names.size(), 4u * (15u + 5u + 3u) + 9u + 5u);
  arm_parameter(arm, "BRD.optimal_fiber_length") = 0.2;
  EXPECT_EQ(arm.muscles[2].parameters.hill.optimal_fiber_length_m, 0.2);
  EXPECT_THROW((void)arm_parameter(arm, "BRD.colour"), InvalidInput);
}

TEST(ArmParameters, SurviveTheChangeOfScalar) {
  const Arm<double> arm = make_arm({.held_mass_kg = 1.0});
  const Arm<double> same = lifted_arm<double>(arm);
  std::vector<double> values;
  visit_arm_parameters(arm, [&](const auto&, Unit, double v) { values.push_back(v); });
  std::size_t k = 0;
  visit_arm_parameters(same, [&](const auto& name, Unit, double v) { EXPECT_EQ(v, values[k++]) << name; });
  EXPECT_EQ(same.muscles[3].name, "TRI");
}

}  // namespace
}  // namespace myoid::simulation
