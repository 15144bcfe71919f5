#include "myoid/intervals/verdict_cap.h"

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

IdentificationResult three_numbers() {
  IdentificationResult result;
  result.method = "torque";
  result.estimates = {
      {.muscle = "BIC", .parameter = "max_isometric_force", .verdict = Verdict::identified, .reason = "a"},
      {.muscle = "BIC", .parameter = "optimal_fiber_length", .verdict = Verdict::identified},
      {.muscle = "TRI", .parameter = "max_isometric_force", .verdict = Verdict::not_identifiable}};
  return result;
}

std::vector<Verdict> after(const std::vector<VerdictCap>& caps) {
  IdentificationResult result = three_numbers();
  apply(caps, result);
  std::vector<Verdict> verdicts;
  for (const ParameterEstimate& e : result.estimates) verdicts.push_back(e.verdict);
  return verdicts;
}

constexpr Verdict kYes = Verdict::identified, kWeak = Verdict::weak, kNo = Verdict::not_identifiable;

TEST(VerdictCap, LowersWhatItNamesAndNeverRaises) {
  EXPECT_EQ(after({}), (std::vector{kYes, kYes, kNo}));
  EXPECT_EQ(after({{.reason = "r"}}), (std::vector{kWeak, kWeak, kNo}));
  EXPECT_EQ(after({{.reason = "r", .owners = {"TRI"}}}), (std::vector{kYes, kYes, kNo}));
  EXPECT_EQ(after({{.reason = "r", .owners = {"BIC"}, .parameters = {"max_isometric_force"}}}),
            (std::vector{kWeak, kYes, kNo}));
  EXPECT_EQ(after({{.reason = "r", .methods = {"paper"}}}), (std::vector{kYes, kYes, kNo}));
}

TEST(VerdictCap, TheFirstReasonStands) {
  IdentificationResult result = three_numbers();
  apply({{.reason = "first", .owners = {"BIC"}}, {.reason = "second"}}, result);
  EXPECT_EQ(result.estimates[0].reason, "first");
  EXPECT_EQ(result.estimates[2].reason, "");
}

TEST(VerdictCap, OfAStrengthIsOfTheTorquesThatItMakes) {
  IdentificationResult result;
  result.method = "torque";
  VoluntaryCurve joint{.owner = "elbow", .joint = "elbow", .of_joint = true, .direction = 1, .muscles = {"BIC", "BRA"}};
  joint.ending = "_positive";
  result.voluntary = {joint};
  const auto add = [&](const char* owner, const char* parameter) {
    ParameterEstimate& e = result.estimates.emplace_back();
    e.muscle = owner;
    e.parameter = parameter;
    e.verdict = Verdict::identified;
  };
  add("BIC", "voluntary_torque");
  add("BIC", "voluntary_torque_angle");
  add("BRA", "voluntary_power_60");
  add("elbow", "voluntary_torque_positive");
  add("elbow", "voluntary_torque_negative");
  apply({{.reason = "level", .owners = {"BIC"}, .parameters = {"max_isometric_force"}}}, result);
  const auto verdict = [&](std::size_t i) { return result.estimates[i].verdict; };
  EXPECT_EQ(verdict(0), Verdict::weak);
  EXPECT_EQ(verdict(1), Verdict::identified);
  EXPECT_EQ(verdict(2), Verdict::identified);
  EXPECT_EQ(verdict(3), Verdict::weak);
  EXPECT_EQ(verdict(4), Verdict::identified);
}

}  // namespace
}  // namespace myoid::identification
