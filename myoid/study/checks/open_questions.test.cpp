#include "myoid/study/checks/open_questions.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::study {
namespace {

TEST(OpenQuestions, EveryLineThatNobodyAnsweredIsNamed) {
  EXPECT_FALSE(open_questions("[subject]\nname = \"a\"  # of the TODO list\n", "study.toml"));
  const auto asked = open_questions("# TODO: the mass\n[subject]\nname = \"a\"  # TODO: who?\n", "s/study.toml");
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->code, RemarkCode::unanswered);
  EXPECT_EQ(asked->severity, Severity::warning);
  EXPECT_EQ(asked->where, "study.toml");
  EXPECT_EQ(asked->value, 2.0);
  EXPECT_THAT(asked->says, testing::AllOf(testing::HasSubstr("line 1: the mass"), testing::HasSubstr("line 3: who?")));
}

TEST(OpenQuestions, OneQuestionOfSeveralLinesIsSaidOnce) {
  const auto asked = open_questions("# TODO: held?\n# TODO: who?\n# TODO: held?\n", "study.toml");
  ASSERT_TRUE(asked);
  EXPECT_EQ(asked->value, 3.0);
  EXPECT_EQ(asked->says.find("held?"), asked->says.rfind("held?"));
}

}  // namespace
}  // namespace myoid::study
