#include "myoid/intervals/estimate_rows.h"

#include <vector>

#include <gtest/gtest.h>

namespace myoid::identification {
namespace {

TEST(AgreeOnTied, TheWorstVerdictIsThatOfAll) {
  const auto owner = [](const char* muscle, const char* tied_to, Verdict verdict) {
    ParameterEstimate e;
    e.muscle = muscle;
    e.tied_to = tied_to;
    e.verdict = verdict;
    e.reason = muscle;
    return e;
  };
  std::vector<ParameterEstimate> estimates{owner("X", "", Verdict::identified), owner("BIC", "", Verdict::identified),
                                           owner("BRA", "BIC", Verdict::weak),
                                           owner("TRI", "BIC", Verdict::identified)};
  agree_on_tied(estimates, 3);
  EXPECT_EQ(estimates[0].verdict, Verdict::identified);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(estimates[i].verdict, Verdict::weak) << i;
    EXPECT_EQ(estimates[i].reason, "BRA") << i;
  }
}

}  // namespace
}  // namespace myoid::identification
