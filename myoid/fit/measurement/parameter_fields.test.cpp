#include "myoid/fit/measurement/parameter_fields.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "myoid/fit/beliefs/beliefs.h"
#include "myoid/ground/core/error.h"

namespace myoid::fit {
namespace {

TEST(ParameterFields, EveryNumberOfTheModelHasOneRowAndOneName) {
  std::set<std::string_view> names;
  std::set<std::pair<Scope, int>> numbers;
  for (const ParameterField& field : parameter_fields()) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name;
    EXPECT_TRUE(numbers.insert({field.scope, field.field}).second) << field.name;
    EXPECT_EQ(&parameter_field(field.name), &field);
    EXPECT_LT(field.bounds.lower, field.bounds.upper) << field.name;
    EXPECT_FALSE(field.meaning.empty()) << field.name;
    if (field.logarithmic) {
      EXPECT_GT(field.bounds.lower, 0.0) << field.name;
    }
  }
  for (int f = 0; f < kChannelFieldCount; ++f) EXPECT_TRUE(numbers.contains({Scope::channel, f}));
  for (int f = 0; f < kJointFieldCount; ++f) EXPECT_TRUE(numbers.contains({Scope::joint, f}));
}

TEST(ParameterFields, EveryOneHasABelief) {
  std::set<std::string_view> names;
  for (const Belief* belief : all_beliefs()) names.insert(belief->name);
  for (const ParameterField& field : parameter_fields()) EXPECT_TRUE(names.contains(field.name)) << field.name;
}

TEST(ParameterFields, ANameThatIsNoneIsAnsweredWithThoseThatAre) {
  try {
    static_cast<void>(parameter_field("max_force"));
    FAIL() << "a name that is none was taken";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("max_isometric_force"), std::string::npos);
  }
  EXPECT_FALSE(zero_by_nature("max_force"));
  EXPECT_TRUE(zero_by_nature("joint_stiffness"));
}

}  // namespace
}  // namespace myoid::fit
