#include "myoid/study/open_question.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::study {
namespace {

using testing::IsEmpty;
using testing::SizeIs;

std::string draft(const std::string& answer) {
  return "[subject]\n" + question_line("the mass?", "# mass_kg = 70.0") + "\n" + answer + "\n\n[model]\n";
}

TEST(OpenQuestion, CountsWhileItsLineIsTheDrafts) {
  const auto open = open_questions_in(draft("  # mass_kg = 70.0  "));
  ASSERT_THAT(open, SizeIs(1));
  EXPECT_EQ(open[0].line, 2U);
  EXPECT_EQ(open[0].text, "the mass?");
}

TEST(OpenQuestion, IsAnsweredByAnotherValueAndByALineWithoutItsMark) {
  EXPECT_THAT(open_questions_in(draft("mass_kg = 81")), IsEmpty());
  EXPECT_THAT(open_questions_in(draft("mass_kg = 70.0")), IsEmpty());
}

TEST(OpenQuestion, TheLineOfAnotherTableIsNoDraftOfThis) {
  EXPECT_THAT(open_questions_in(draft("held_mass_kg = 0") + "# mass_kg = 70.0\n"), IsEmpty());
}

TEST(OpenQuestion, WithoutALineItCountsUntilItIsDeleted) {
  EXPECT_THAT(open_questions_in(question_line("who?") + "\nname = \"b\"\n"), SizeIs(1));
}

}  // namespace
}  // namespace myoid::study
