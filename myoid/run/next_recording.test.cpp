#include "myoid/run/next_recording.h"

#include <memory>

#include <gtest/gtest.h>

#include "myoid/study/study_model.h"

namespace myoid::run {
namespace {

/// The elbow of the built-in arm, and a fit by method torque that ended so.
struct Fitted {
  StudySource source;
  StudyFit fit;

  explicit Fitted(math::Termination termination) {
    source.study.model.builtin = "arm4";
    source.study.identify.next_movements = 1;
    source.model = std::make_shared<const body::BodyModel>(study::load_model(source.study));
    fit::IdentificationResult torque;
    torque.method = fit::Method::torque;
    torque.termination = termination;
    fit.methods = {torque};
  }
};

// The design refuses a study without muscles.
TEST(NextRecording, ThatCannotBePlannedIsARemarkAndTheRunGoesOn) {
  const Fitted run(math::Termination::converged);
  std::vector<Remark> remarks;
  EXPECT_FALSE(next_recording(run.source, run.fit, {}, remarks));
  ASSERT_EQ(remarks.size(), 1U);
  EXPECT_EQ(remarks[0].severity, Severity::warning);
}

TEST(NextRecording, OfAFitThatDidNotEndIsNotAskedFor) {
  const Fitted run(math::Termination::iteration_limit);
  std::vector<Remark> remarks;
  EXPECT_FALSE(next_recording(run.source, run.fit, {}, remarks));
  EXPECT_TRUE(remarks.empty());
}

TEST(NextRecording, IsAskedOfAModelThatMoves) {
  Fitted run(math::Termination::converged);
  run.source.study.model.builtin = "none";
  std::vector<Remark> remarks;
  EXPECT_FALSE(next_recording(run.source, run.fit, {}, remarks));
  EXPECT_TRUE(remarks.empty());
}

}  // namespace
}  // namespace myoid::run
