#include "myoid/run/study_emg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::run {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

/// One trial with an activation, from EMG of this kind.
StudyResult with_activation(study::EmgKind kind) {
  StudyResult result;
  result.source.study.emg.kind = kind;
  result.trials.resize(1);
  result.trials[0].emg.activation =
      TimeSeries(Eigen::Vector2d(0.0, 1.0), {{"BIC", Unit::dimensionless}}, Eigen::Vector2d(0.2, 0.6));
  return result;
}

TEST(EmgChain, WithoutEmgThereAreNoSteps) {
  StudyResult result = with_activation(study::EmgKind::envelope);
  result.trials[0].emg.activation = {};
  EXPECT_TRUE(emg_chain(result, nullptr).steps.empty());
}

TEST(EmgChain, OnlyEnvelopesAreResampledAndBothSayThatTheyCameProcessed) {
  const auto envelope = emg_chain(with_activation(study::EmgKind::envelope), nullptr);
  const auto activation = emg_chain(with_activation(study::EmgKind::activation), nullptr);
  EXPECT_THAT(envelope.steps, Contains(HasSubstr("resampled to 200 Hz")));
  EXPECT_THAT(activation.steps, Not(Contains(HasSubstr("resampled"))));
  EXPECT_THAT(envelope.steps.front(), HasSubstr("EMG envelopes as the files hold them"));
  EXPECT_THAT(activation.steps.front(), HasSubstr("activations as the files hold them"));
}

TEST(EmgChain, TrialsForValidationAreSaidToTakeNoPartInTheNormalization) {
  StudyResult result = with_activation(study::EmgKind::envelope);
  result.trials.push_back(result.trials[0]);
  EXPECT_THAT(emg_chain(result, nullptr).steps, Contains(HasSubstr("over all trials and maximal")));
  result.trials[1].spec.use = study::Use::validation;
  const recording::EmgChain chain = emg_chain(result, nullptr);
  EXPECT_THAT(chain.steps, Contains(HasSubstr("over all trials but those for validation and maximal")));
  EXPECT_THAT(chain.methods, Contains(HasSubstr("(trials for validation took no part)")));
  result.trials[0].spec.use = study::Use::validation;
  EXPECT_THAT(emg_chain(result, nullptr).steps, Contains(HasSubstr("over all trials and maximal")));
}

}  // namespace
}  // namespace myoid::run
