#include "myoid/fit/beliefs/beliefs.h"

#include <optional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/muscle/hill_parameters.h"

#include "tests/support/printed_page.h"

namespace myoid::fit {
namespace {

std::string spread_text(const Belief& belief) {
  if (belief.sd == 0.0) return "–";
  switch (belief.spread) {
    case SpreadOf::logarithm:
      return fmt::format("ln {:g}", belief.sd);
    case SpreadOf::fiber_length:
      return fmt::format("{:g} l_m⁰", belief.sd);
    case SpreadOf::joint_strength:
      return fmt::format("{:g} % of the joint's strength", 100.0 * belief.sd);
    case SpreadOf::value:
      break;
  }
  return fmt::format("{:g}", belief.sd);
}

/// Returns the beliefs as a table in Markdown.
std::string beliefs_markdown() {
  std::string text = "| quantity | expected | spread | unit | used | source |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const Belief* belief : all_beliefs()) {
    const bool parameter = belief->name.find(' ') == std::string_view::npos;
    text += fmt::format("| {}{}{} | {} | {} | {} | {} | {} |\n", parameter ? "`" : "", belief->name,
                        parameter ? "`" : "", belief->mean.empty() ? fmt::format("{:g}", belief->value) : belief->mean,
                        spread_text(*belief), belief->unit.empty() ? "–" : belief->unit, belief->when, belief->source);
  }
  return text;
}

TEST(Beliefs, AreTheOnesThatThePagePrints) {
  test::expect_printed("docs/theory/priors.md", "beliefs", beliefs_markdown());
}

TEST(Beliefs, StateTheirUseAndTheirSource) {
  for (const Belief* belief : all_beliefs()) {
    EXPECT_FALSE(belief->source.empty()) << belief->name;
    EXPECT_FALSE(belief->when.empty()) << belief->name;
  }
}

TEST(LiteraturePrior, OfAMuscleStandsAboutTheStart) {
  for (const muscle::HillField& field : muscle::kHillFields) {
    const std::optional<Prior> prior = literature_prior(field.name, 0.3, 0.1);
    ASSERT_TRUE(prior.has_value()) << field.name;
    EXPECT_EQ(prior->mean, 0.3);
    EXPECT_GT(prior->sd, 0.0);
  }
  EXPECT_FALSE(literature_prior("shoe_size", 42.0, 0.1).has_value());
  EXPECT_DOUBLE_EQ(literature_prior("force_length_width", 0.04, 0.1)->sd, 0.012);
}

}  // namespace
}  // namespace myoid::fit
