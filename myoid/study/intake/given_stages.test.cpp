#include "myoid/study/intake/given_stages.h"

#include <gtest/gtest.h>

namespace myoid::study {
namespace {

TEST(GivenStages, ValuesAtTheSameTimesAreTheFilesAndOthersLieOnASpline) {
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(101, 0.0, 1.0);
  const TimeSeries line(t, {{"BIC", Unit::meter}}, 0.3 + 0.1 * t.array());
  EXPECT_EQ(values_at(line, t), line.values());
  // Nearer times of a straight line: exact to round-off.
  const Eigen::VectorXd nearer = Eigen::VectorXd::LinSpaced(201, 0.0, 1.0);
  EXPECT_LT((values_at(line, nearer).col(0).array() - (0.3 + 0.1 * nearer.array())).abs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace myoid::study
