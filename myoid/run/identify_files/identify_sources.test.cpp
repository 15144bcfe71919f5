#include "myoid/run/identify_files/identify_sources.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::run {
namespace {

TEST(IdentifySources, ATrialIsCalledAsItsFileAndFilesOfOneNameAsTheirFolders) {
  EXPECT_EQ(trial_label({"walk.sto"}, 0), "walk");
  EXPECT_EQ(trial_label({"a/walk.sto", "a/run.sto"}, 1), "2 (run)");
  EXPECT_EQ(trial_label({"fast/walk.sto", "slow/walk.sto"}, 0), "1 (fast/walk)");
}

TEST(TrialNamed, TakesNumberFileAndNameAndRefusesWhatIsNoneOrSeveral) {
  const std::vector<std::string> lengths{"fast/walk.sto", "slow/walk.sto", "run.sto"};
  EXPECT_EQ(trial_named("2", lengths), 1U);
  EXPECT_EQ(trial_named("slow/walk.sto", lengths), 1U);
  EXPECT_EQ(trial_named("run", lengths), 2U);
  for (const char* name : {"walk", "4", "0", "jump", ""})
    EXPECT_THROW((void)trial_named(name, lengths), InvalidInput) << name;
}

TEST(IdentifySources, EveryTrialHasAFileOfEachKind) {
  IdentifySources sources;
  sources.activations = sources.lengths = sources.torques = {"1.sto", "2.sto"};
  sources.moment_arms = {"1.sto"};
  EXPECT_THROW(require_counts(sources, true), InvalidInput);
  sources.moment_arms.emplace_back("2.sto");
  EXPECT_NO_THROW(require_counts(sources, true));
  sources.coordinates = {"knee", "ankle"};
  EXPECT_THROW(require_counts(sources, true), InvalidInput);
  sources.moment_arms = {"knee1.sto", "ankle1.sto", "knee2.sto", "ankle2.sto"};
  EXPECT_NO_THROW(require_counts(sources, true));
}

}  // namespace
}  // namespace myoid::run
