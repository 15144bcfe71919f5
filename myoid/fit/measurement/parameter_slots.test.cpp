#include "myoid/fit/measurement/parameter_slots.h"

#include <algorithm>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::fit {
namespace {

struct TwoMuscles {
  TwoMuscles() {
    for (const char* name : {"BIC", "TRI"}) {
      MuscleSetup m;
      m.name = m.emg_channel = name;
      data.muscles.push_back(m);
    }
    values.muscles.resize(2);
    values.channels.resize(2);
    values.joints.resize(1);
  }
  ParameterSlots slots(const std::vector<ParameterRule>& rules = {}) const {
    ParameterSlots result = default_slots(data, {}, values, names);
    apply_rules(rules, names, result);
    return result;
  }
  static std::set<std::string> free_names(const ParameterSlots& of, int owner) {
    std::set<std::string> result;
    for (const ParameterSlot& s : of.slots) {
      if (s.free && s.owner == owner && s.field->scope == Scope::muscle) result.insert(std::string(s.field->name));
    }
    return result;
  }
  static const ParameterSlot& slot(const ParameterSlots& of, const std::string& name, int owner) {
    return *std::find_if(of.slots.begin(), of.slots.end(),
                         [&](const ParameterSlot& s) { return s.owner == owner && s.field->name == name; });
  }
  StudyData data;
  ModelValues values;
  OwnerNames names{.muscles = {"BIC", "TRI"}, .channels = {"BIC", "TRI"}, .joints = {"elbow"}};
};

TEST(ParameterSlots, TheSixNumbersOfTheSourcePaperAreFreeAndOneDelayForAll) {
  const TwoMuscles two;
  const ParameterSlots found = two.slots();
  const std::set<std::string> six{"max_isometric_force",  "optimal_fiber_length", "force_length_width",
                                  "concentric_curvature", "eccentric_plateau",    "eccentric_curvature_product"};
  EXPECT_EQ(TwoMuscles::free_names(found, 0), six);
  EXPECT_EQ(TwoMuscles::free_names(found, 1), six);
  EXPECT_TRUE(TwoMuscles::slot(found, "emg_delay", 0).free);
  EXPECT_EQ(TwoMuscles::slot(found, "emg_delay", 0).tied, std::vector<int>{1});
  EXPECT_TRUE(TwoMuscles::slot(found, "emg_delay", 1).follows);
}

/// Bounds of the width of a muscle whose optimal fiber length is 0.1 m.
struct WidthBounds {
  double start_m = 0.045;
  bool priors = true;
  std::optional<muscle::Range> of_muscle;
  std::vector<ParameterRule> rules;

  ParameterSlot found() const {
    TwoMuscles two;
    two.data.muscles[0].start.optimal_fiber_length_m = 0.1;
    two.data.muscles[0].start.force_length_width_m = start_m;
    if (of_muscle) two.data.muscles[0].bounds["force_length_width"] = *of_muscle;
    ParameterSlots slots = default_slots(two.data, {.priors = priors}, two.values, two.names);
    apply_rules(rules, two.names, slots);
    return TwoMuscles::slot(slots, "force_length_width", 0);
  }
};

void expect_bounds(const WidthBounds& of, double lower, double upper) {
  EXPECT_NEAR(of.found().bounds.lower, lower, 1e-12);
  EXPECT_NEAR(of.found().bounds.upper, upper, 1e-12);
}

TEST(ParameterSlots, AWidthStaysWithinWhatMusclesHave) {
  expect_bounds({}, 0.02, 0.1);
  const muscle::Range any = parameter_field("force_length_width").bounds;
  expect_bounds({.priors = false}, any.lower, any.upper);
  expect_bounds({.start_m = 0.008}, any.lower, any.upper);
}

TEST(ParameterSlots, WhatTheStudySaysOfAWidthWins) {
  const muscle::Range any = parameter_field("force_length_width").bounds;
  const muscle::Range given{0.010, 0.030};
  const ParameterRule stated{.parameter = "force_length_width", .owners = {"BIC"}, .value = 0.012, .prior_sd = 0.002};
  const ParameterRule believed{.parameter = "force_length_width", .owners = {"BIC"}, .prior_mean = 0.012};
  expect_bounds({.of_muscle = given}, 0.010, 0.030);
  expect_bounds({.rules = {stated}}, any.lower, any.upper);
  expect_bounds({.rules = {believed}}, any.lower, any.upper);
  expect_bounds({.of_muscle = given, .rules = {stated}}, 0.010, 0.030);
  expect_bounds({.rules = {{.parameter = "force_length_width", .owners = {}, .lower = 0.015}}}, 0.015, 0.1);
}

TEST(ParameterSlots, AMuscleMayHoldWhatOthersFree) {
  TwoMuscles two;
  two.data.muscles[0].fixed = {"concentric_curvature"};
  EXPECT_FALSE(TwoMuscles::slot(two.slots(), "concentric_curvature", 0).free);
  EXPECT_TRUE(TwoMuscles::slot(two.slots(), "concentric_curvature", 1).free);
}

TEST(ParameterSlots, LaterRulesWinAndReachOnlyTheirOwners) {
  const TwoMuscles two;
  const ParameterSlots found =
      two.slots({{.parameter = "force_length_width", .owners = {}, .free = false, .value = 0.05},
                 {.parameter = "force_length_width", .owners = {"TRI"}, .free = true}});
  EXPECT_FALSE(TwoMuscles::slot(found, "force_length_width", 0).free);
  EXPECT_TRUE(TwoMuscles::slot(found, "force_length_width", 1).free);
  EXPECT_EQ(TwoMuscles::slot(found, "force_length_width", 1).value, 0.05);
}

TEST(ParameterSlots, TheSlopeRatioTakesThePlaceOfTheProduct) {
  const TwoMuscles two;
  const ParameterSlots found = two.slots({{.parameter = "eccentric_slope_ratio", .owners = {"BIC"}, .free = true}});
  EXPECT_FALSE(TwoMuscles::slot(found, "eccentric_curvature_product", 0).free);
  EXPECT_TRUE(TwoMuscles::slot(found, "eccentric_curvature_product", 1).free);
  EXPECT_GT(found.slope_ratio[0], 0.0);
  EXPECT_EQ(found.slope_ratio[1], 0.0);
}

TEST(ParameterSlots, ADelayFreedByNameLeavesTheCommonOne) {
  const TwoMuscles two;
  const ParameterSlots found = two.slots({{.parameter = "emg_delay", .owners = {"TRI"}, .free = true}});
  EXPECT_TRUE(TwoMuscles::slot(found, "emg_delay", 0).tied.empty());
  EXPECT_FALSE(TwoMuscles::slot(found, "emg_delay", 1).follows);
}

TEST(ParameterSlots, AnOwnerThatIsNoneIsAnsweredWithThoseThatAre) {
  try {
    TwoMuscles().slots({{.parameter = "emg_gain", .owners = {"BRD"}, .free = true}});
    FAIL() << "an owner that is none was taken";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("BIC, TRI"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace myoid::fit
