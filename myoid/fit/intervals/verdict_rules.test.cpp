#include "myoid/fit/intervals/verdict_rules.h"

#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/printed_page.h"

namespace myoid::fit {
namespace {

/// Returns the thresholds as a table in Markdown.
std::string rules_markdown() {
  constexpr const VerdictRules& r = kVerdictRules;
  std::string text = "| rule | threshold |\n| --- | --- |\n";
  const auto row = [&text](std::string_view rule, const std::string& threshold) {
    text += fmt::format("| {} | {} |\n", rule, threshold);
  };
  const auto percent = [](double share) { return fmt::format("{:g} %", 100.0 * share); };
  const auto ms = [](double seconds) { return fmt::format("{:g} ms", 1000.0 * seconds); };
  const auto degrees = [](double angle_rad) { return fmt::format("{:.0f}°", angle_rad / kDegree); };
  row("farther end of the 95 % interval from the value, of `identified`",
      fmt::format("at most {}; delay: {}; angle: {}", percent(r.identified_half_width), ms(r.delay_identified_s),
                  degrees(r.angle_identified_rad)));
  row("the same, of `weak`", fmt::format("at most {}; delay: {}; angle: {}", percent(r.weak_half_width),
                                         ms(r.delay_weak_s), degrees(r.angle_weak_rad)));
  row("1 − posterior/prior variance, of `prior_dominated`", fmt::format("below {:g}", r.least_shrinkage));
  row("the same, of `weak` at best", fmt::format("below {:g}", r.half_shrinkage));
  row("distance from the prior's mean, of `weak` at best", fmt::format("above {:g} spreads", r.prior_conflict));
  row("systematic error of the model, of `weak` at best", fmt::format("above {}", percent(r.model_error)));
  row("torque of moving joints that their angle, rate and acceleration explain, of `weak` at best",
      fmt::format("above {}", percent(r.motion_alone)));
  row("R² of the fit, of `not_identifiable`", fmt::format("below {:g}", r.least_r2));
  row("l_mˢʰ over l_m⁰ that a muscle can have",
      fmt::format("{:g} to {:g}", r.relative_width.lower, r.relative_width.upper));
  row("span of the active lengths that tells l_m⁰ and l_mˢʰ",
      fmt::format("{} of l_m⁰ or more", percent(r.least_length_span)));
  row("activation of an active muscle", fmt::format("above {}, for {:g} s", percent(r.active), r.least_s));
  row("distance of the posterior's interval from a bound that counts as none",
      fmt::format("below {} of the possible range", percent(r.on_bound)));
  return text;
}

TEST(VerdictRules, AreTheOnesThatThePagePrints) {
  test::expect_printed("docs/theory/identification.md", "verdict rules", rules_markdown());
}

}  // namespace
}  // namespace myoid::fit
