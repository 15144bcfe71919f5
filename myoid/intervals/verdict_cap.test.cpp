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

}  // namespace
}  // namespace myoid::identification
