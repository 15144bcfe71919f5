#include "myoid/study/setting.h"

#include <gtest/gtest.h>

namespace myoid::study {
namespace {

enum class Side { left, right };
constexpr std::string_view kSides[] = {"left", "right"};
constexpr ChoiceNames choice_names(Side) { return kSides; }

/// Gives every setting one value and remembers the ones that it met.
class Giver : public SettingVisitor {
 public:
  explicit Giver(SettingValue value) : value_(std::move(value)) {}
  SettingValue before;

 protected:
  bool met(const Setting& /*setting*/, const SettingValue& now, const Set& set) override {
    before = now;
    set(value_);
    return true;
  }
  bool entered(std::string_view, bool, const About&, const Inside&) override { return false; }
  void repeated(std::string_view,
                std::size_t,
                const About&,
                const std::function<void(std::size_t, SettingVisitor&)>&) override {}

 private:
  SettingValue value_;
};

TEST(SettingVisitor, AChoiceIsItsNameInAFile) {
  Giver giver(std::string("right"));
  Side side = Side::left;
  EXPECT_TRUE(giver.choice("side", side, {.says = "a side"}));
  EXPECT_EQ(side, Side::right);
  EXPECT_EQ(std::get<std::string>(giver.before), "left");
  bool second = false;
  giver.either("side", second, {.says = "a side", .words = kSides});
  EXPECT_TRUE(second);
}

TEST(SettingVisitor, AWordThatNamesNoChoiceStandsForNone) {
  static constexpr std::string_view kOrNone[] = {"left", "right", "none"};
  std::optional<Side> side = Side::left;
  Giver none(std::string("none"));
  none.choice("side", side, {.says = "a side", .words = kOrNone});
  EXPECT_EQ(side, std::nullopt);
  EXPECT_EQ(std::get<std::string>(none.before), "left");
  Giver right(std::string("right"));
  right.choice("side", side, {.says = "a side", .words = kOrNone});
  EXPECT_EQ(side, Side::right);
  EXPECT_EQ(std::get<std::string>(right.before), "none");
}

TEST(SettingVisitor, AWordStandsInsteadOfANumber) {
  std::optional<double> delay_s = 0.05;
  bool estimated = false;
  Giver word(std::string("estimate"));
  word.number("delay_s", delay_s, estimated, {.says = "delay", .word = "estimate"});
  EXPECT_TRUE(estimated);
  EXPECT_EQ(delay_s, std::nullopt);
  Giver number(0.03);
  number.number("delay_s", delay_s, estimated, {.says = "delay", .word = "estimate"});
  EXPECT_FALSE(estimated);
  EXPECT_EQ(delay_s, 0.03);
}

}  // namespace
}  // namespace myoid::study
