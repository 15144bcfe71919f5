#include "myoid/run/design/earlier_run.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/results/parameter_files.h"

#include "tests/support/temporary_folder.h"

namespace myoid::run {
namespace {

fit::IdentificationResult finished() {
  fit::IdentificationResult fit;
  fit.method = fit::Method::torque;
  fit.free_parameters = {"BIC.max_isometric_force", "BIC.optimal_fiber_length"};
  fit.covariance = (Eigen::Matrix2d() << 0.04, -0.001, -0.001, 1e-4).finished();
  fit.torque_sd_nm = 0.3;
  fit.emg_cv = 0.09;
  fit.model_error = 0.2;
  for (const auto& [parameter, value] :
       {std::pair{"optimal_fiber_length", 0.12}, std::pair{"max_isometric_force", 900.0},
        std::pair{"tendon_slack_length", 0.2}}) {
    fit::ParameterEstimate e;
    e.muscle = "BIC";
    e.parameter = parameter;
    e.estimate = value;
    e.ci_low = 0.9 * value;
    e.verdict = fit::Verdict::weak;
    fit.estimates.push_back(e);
  }
  return fit;
}

TEST(EarlierRun, WhatIsReadFromItsFileIsWhatTheFitSays) {
  const test::TemporaryFolder folder;
  write_file(folder / "parameters.json", results::parameters_json({finished()}, {}, {}));
  const EarlierRun read = read_earlier_run(folder.path());
  const EarlierRun at_hand = earlier_run(finished());
  EXPECT_EQ(read.parameters, finished().free_parameters);
  // By name: the estimates stand in another order than the covariance.
  EXPECT_EQ(read.estimate, Eigen::Vector2d(900.0, 0.12));
  EXPECT_EQ(at_hand.estimate, Eigen::Vector2d(900.0, 0.12));
  EXPECT_EQ(read.covariance, finished().covariance);
  EXPECT_EQ(read.model_error, 0.2);
  ASSERT_EQ(read.estimates.size(), 3U);
  EXPECT_EQ(read.estimates[2].ci_low, 0.9 * 0.2);
  EXPECT_EQ(read.estimates[2].ci_high, std::nullopt);
  EXPECT_EQ(read.estimates[2].verdict, fit::Verdict::weak);
}

TEST(ReadEarlierRun, SaysWhatIsWrongWithAFolderThatHoldsNoRun) {
  const test::TemporaryFolder folder;
  EXPECT_THROW((void)read_earlier_run(folder.path()), ReadError);
  std::ofstream(folder / "parameters.json") << R"({"methods": [{"method": "paper"}]})";
  EXPECT_THROW((void)read_earlier_run(folder.path()), ReadError);
  std::ofstream(folder / "parameters.json") << "{\"methods\": [";
  EXPECT_THROW((void)read_earlier_run(folder.path()), ReadError);
}

}  // namespace
}  // namespace myoid::run
