#include "myoid/results/cohort/outcome.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/build_identity.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Outcome, IsReadBackAndADamagedOneCountsAsNone) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(read_outcome(folder.path()));
  write_outcome({.kind = OutcomeKind::gate_failed, .message = "said \"no\"", .build = "b", .inputs = {{"a.trc", "12"}}},
                folder.path());
  const auto outcome = read_outcome(folder.path());
  ASSERT_TRUE(outcome);
  EXPECT_EQ(outcome->kind, OutcomeKind::gate_failed);
  EXPECT_EQ(outcome->message, "said \"no\"");
  EXPECT_EQ(outcome->inputs[0].sha256, "12");
  for (const char* damaged : {"{", "{}", R"({"outcome": "great"})", "[1]"}) {
    write_file(folder / "outcome.json", damaged);
    EXPECT_FALSE(read_outcome(folder.path())) << damaged;
  }
}

TEST(Outcome, IsCurrentOnlyForTheSameProgramAndBytes) {
  const test::TemporaryFolder folder;
  const auto study = folder / "study.toml";
  write_file(study, "abc");
  Outcome outcome{
      .kind = OutcomeKind::done, .message = {}, .build = build_identity(), .inputs = {{study.string(), sha256("abc")}}};
  EXPECT_TRUE(is_current(outcome, study));
  EXPECT_FALSE(is_current(outcome, folder / "other.toml")) << "another study";
  Outcome other = outcome;
  other.build = "another program";
  EXPECT_FALSE(is_current(other, study));
  other = outcome;
  other.kind = OutcomeKind::failed;
  EXPECT_FALSE(is_current(other, study)) << "a failure is tried again";
  write_file(study, "abd");
  EXPECT_FALSE(is_current(outcome, study)) << "other bytes";
}

TEST(Outcome, FailuresNameThePersonsWithoutResults) {
  const Outcome done;
  const Outcome failed{.kind = OutcomeKind::failed, .message = "no file"};
  EXPECT_THAT(
      failures({{.person = "A", .outcome = done}, {.person = "B", .outcome = failed}, {.person = "C", .outcome = {}}}),
      ElementsAre("B: no file", HasSubstr("C: not computed")));
}

}  // namespace
}  // namespace myoid::results
