#include "myoid/identification/paper_case.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/elbow_study.h"

namespace myoid::identification {
namespace {

std::vector<std::string> names(const PaperCase& of) {
  std::vector<std::string> result;
  for (const PaperUnknown& unknown : of.unknowns) result.emplace_back(unknown.field->name);
  return result;
}

TEST(PaperCase, HoldsWhatTheSetupHoldsUnlessALaterRuleFreesIt) {
  StudyData data = test::elbow_study({.trials = 1, .seconds = 4.0}).data;
  data.muscles[0].fixed = {"optimal_fiber_length"};
  EXPECT_EQ(names(paper_case(data, 0, true)),
            (std::vector<std::string>{"force_length_width", "concentric_curvature"}));
  EXPECT_EQ(names(paper_case(data, 1, false)),
            (std::vector<std::string>{"optimal_fiber_length", "force_length_width",
                                      "eccentric_curvature_product", "eccentric_plateau"}));
  data.rules = {{.parameter = "optimal_fiber_length", .owners = {"BIC"}, .free = true},
                {.parameter = "force_length_width", .free = false, .value = 0.04}};
  const PaperCase ruled = paper_case(data, 0, true);
  EXPECT_EQ(names(ruled),
            (std::vector<std::string>{"optimal_fiber_length", "concentric_curvature"}));
  EXPECT_EQ(ruled.start.force_length_width_m, 0.04);
}

TEST(PaperCase, EverySampleIsInOneBranchOrCountedAsDropped) {
  StudyData data = test::elbow_study({.trials = 2, .seconds = 4.0, .delay_s = 0.0}).data;
  // No muscle shortens at 0.05 m/s or faster any more, as far as this one is concerned.
  data.muscles[0].start.max_shortening_speed_mps = 0.05;
  std::size_t samples = 0;
  int dropped = 0;
  for (const bool shortening : {true, false}) {
    const PaperCase one = paper_case(data, 0, shortening);
    Eigen::Index in_pieces = 0;
    for (const Eigen::Index n : one.pieces) in_pieces += n;
    EXPECT_EQ(in_pieces, static_cast<Eigen::Index>(one.samples.size()));
    samples += one.samples.size();
    dropped += one.dropped;
  }
  EXPECT_GT(dropped, 0);
  EXPECT_EQ(samples + static_cast<std::size_t>(dropped), 2u * 401u);
}

}  // namespace
}  // namespace myoid::identification
