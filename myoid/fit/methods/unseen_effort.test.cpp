#include "myoid/fit/methods/unseen_effort.h"

#include <vector>

#include <gtest/gtest.h>

namespace myoid::fit {
namespace {

/// Two channels that are held at these levels for 2 s, one second of silence before and after.
TrialData efforts(bool calibration, double flexor, double extensor) {
  TrialData t;
  t.calibration = calibration;
  t.time_s = Eigen::VectorXd::LinSpaced(201, 0.0, 4.0);
  const Eigen::VectorXd clock = Eigen::VectorXd::LinSpaced(501, -1.0, 4.0);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(clock.size(), 2);
  for (Eigen::Index i = 0; i < clock.size(); ++i) {
    if (clock[i] >= 1.0 && clock[i] <= 3.0) a.row(i) << flexor, extensor;
  }
  a(10, 0) = 50.0;  // ahead of the trial
  t.activation = TimeSeries(clock, {{"F", Unit::dimensionless}, {"E", Unit::dimensionless}}, std::move(a));
  return t;
}

StudyData study_of(std::vector<TrialData> trials) {
  StudyData data;
  data.muscles.resize(2);
  data.muscles[0].emg_channel = "F";
  data.muscles[1].emg_channel = "E";
  data.trials = std::move(trials);
  return data;
}

TEST(UnseenEffort, IsTheChannelThatWorksHardestBeyondWhatWasFitted) {
  const UnseenEffort found =
      unseen_effort(study_of({efforts(true, 0.2, 0.4), efforts(true, 0.1, 0.5), efforts(false, 0.3, 1.0)}));
  EXPECT_EQ(found.channel, "E");
  EXPECT_NEAR(found.ratio, 2.0, 1e-12);
}

TEST(UnseenEffort, IsNoneWhereTheFitSawGreaterEfforts) {
  const UnseenEffort found = unseen_effort(study_of({efforts(true, 0.8, 0.9), efforts(false, 0.3, 0.4)}));
  EXPECT_EQ(found.channel, "");
  EXPECT_EQ(found.ratio, 1.0);
}

}  // namespace
}  // namespace myoid::fit
