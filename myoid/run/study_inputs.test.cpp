#include "myoid/run/study_inputs.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/written_trial.h"

namespace myoid::run {
namespace {

using namespace test_trials;

/// A study on disk, of one trial.
struct StudyWithTruth {
  WrittenTrial trial{0.01, 8.0, 3.0};
  study::Study study;

  explicit StudyWithTruth(const std::string& truth) {
    const auto file = trial.folder / "study.toml";
    write_file(file, "\n");
    write_file(trial.folder / "truth.csv", truth);
    study = arm_study();
    study.file = file;
    study.trials = {trial.spec};
    study.truth = trial.folder / "truth.csv";
  }
};

TEST(ReadInputs, ATrialThatPausesIsReplacedByItsPartsInTheStudyToo) {
  StudyWithTruth written("muscle,parameter,value\nBIC,optimal_fiber_length,0.14\n");
  const StudyInputs inputs = read_inputs(written.study);
  ASSERT_EQ(inputs.source.study.trials.size(), 2U);
  ASSERT_EQ(inputs.trials.size(), 2U);
  EXPECT_EQ(inputs.source.study.trials[1].name, "t.2");
  ASSERT_EQ(inputs.source.truth.size(), 1U);
  EXPECT_EQ(inputs.source.truth[0].value, 0.14);
  // Both parts are of the same two files, and each file is named once.
  EXPECT_EQ(std::count_if(inputs.source.files.begin(), inputs.source.files.end(),
                          [&](const InputFile& f) { return f.path == written.trial.spec.emg; }),
            1);
}

TEST(ReadInputs, ATrueValueThatIsNoNumberIsRefusedAtItsLine) {
  StudyWithTruth written("muscle,parameter,value\nBIC,optimal_fiber_length,long\n");
  const std::string message = message_of([&] { (void)read_inputs(written.study); });
  EXPECT_NE(message.find("truth.csv:2: expected a number, found 'long'"), std::string::npos) << message;
}

}  // namespace
}  // namespace myoid::run
