#include "myoid/core/parameter_set.h"

#include <gtest/gtest.h>

#include "myoid/core/error.h"

namespace myoid {
namespace {

ParameterSet three() {
  return ParameterSet({{.name = "a", .unit = Unit::meter, .value = 1.0, .lower = 0.0, .upper = 2.0},
                       {.name = "b", .value = 5.0, .free = false},
                       {.name = "c", .value = 3.0}});
}

TEST(ParameterSet, TheSolverSeesOnlyTheFreeEntriesInOrder) {
  EXPECT_EQ(three().free_values(), Eigen::Vector2d(1.0, 3.0));
}

TEST(ParameterSet, WithFreeValuesLeavesFixedEntriesAlone) {
  const ParameterSet changed = three().with_free_values(Eigen::Vector2d(1.5, 7.0));
  EXPECT_EQ(changed.value("a"), 1.5);
  EXPECT_EQ(changed.value("b"), 5.0);
  EXPECT_EQ(changed.value("c"), 7.0);
}

TEST(ParameterSet, RefusesTwoOfOneName) {
  ParameterSet set = three();
  EXPECT_THROW(set.add({.name = "a", .value = 0.0}), InvalidInput);
}

TEST(ParameterSet, RefusesAStartOutsideItsBounds) {
  ParameterSet set;
  EXPECT_THROW(set.add({.name = "x", .value = 3.0, .lower = 0.0, .upper = 1.0}), InvalidInput);
}

TEST(ParameterSet, RefusesAPriorWithoutSpread) {
  ParameterSet set;
  EXPECT_THROW(set.add({.name = "x", .value = 1.0, .prior = Prior{.mean = 1.0, .sd = 0.0}}),
               InvalidInput);
}

TEST(ParameterSet, AnUnknownNameIsToldTheNamesThereAre) {
  try {
    (void)three().at("z");
    FAIL() << "did not throw";
  } catch (const InvalidInput& e) {
    EXPECT_NE(std::string(e.what()).find("a, b, c"), std::string::npos);
  }
}

}  // namespace
}  // namespace myoid
