#include "myoid/study/checks/excluded_times.h"

#include <gtest/gtest.h>

namespace myoid::study {
namespace {

/// A trial of 10 s.
TrialInput ten_seconds() {
  TrialInput input;
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(1001, 0.0, 10.0);
  input.motion = TimeSeries(t, {{"elbow_flexion", Unit::radian}}, Eigen::MatrixXd::Zero(1001, 1));
  return input;
}

TEST(ExcludedTimes, AreSaidWithTheirShare) {
  TrialSpec trial;
  EXPECT_TRUE(excluded_times(trial, ten_seconds(), {}).empty());
  trial.exclude.windows = {{1.0, 2.0}, {8.5, 12.0}};
  const std::vector<Remark> found = excluded_times(trial, ten_seconds(), {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::note);
  EXPECT_NE(found[0].says.find("(25 %"), std::string::npos) << found[0].says;
}

TEST(ExcludedTimes, AWindowOutsideOfTheTrialIsAWarningButNotOfAPart) {
  TrialSpec trial;
  trial.exclude.windows = {{11.0, 12.0}};
  TrialInput input = ten_seconds();
  std::vector<Remark> found = excluded_times(trial, input, {});
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  input.remarks.push_back({.code = RemarkCode::clock_pause});
  EXPECT_TRUE(excluded_times(trial, input, {}).empty());
}

TEST(ExcludedTimes, ForeignContactsCountWhereTheTrialExcludesThem) {
  TrialSpec trial;
  EXPECT_TRUE(excluded_times(trial, ten_seconds(), {{4.0, 5.0}}).empty());
  trial.exclude.foreign_contacts = true;
  // One second and a tenth at either side.
  EXPECT_NE(excluded_times(trial, ten_seconds(), {{4.0, 5.0}}).at(0).says.find("(12 %"), std::string::npos);
  EXPECT_TRUE(excluded_times(trial, ten_seconds(), {}).empty());
}

}  // namespace
}  // namespace myoid::study
