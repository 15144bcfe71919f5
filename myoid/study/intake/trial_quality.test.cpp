#include "myoid/study/intake/trial_quality.h"

#include <gtest/gtest.h>

namespace myoid::study {
namespace {

TEST(TrialFaults, HoldWhatWasFoundOfTheMarkersAndOfTheClocks) {
  Study study;
  TrialInput input;
  input.marker_faults.push_back({.code = RemarkCode::marker_jump, .about = "C7"});
  Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(100, 0.0, 0.99);
  for (Eigen::Index i = 0; i < 100; i += 2) time[i] += 0.002;
  input.motion = TimeSeries(time, {{"q", Unit::radian}}, Eigen::MatrixXd::Zero(100, 1));
  const std::vector<Remark> faults = trial_faults(study, input, {});
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].code, RemarkCode::marker_jump);
  EXPECT_EQ(faults[1].code, RemarkCode::clock_uneven);
}

}  // namespace
}  // namespace myoid::study
