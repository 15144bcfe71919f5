#include "myoid/lab/twin/twin_study.h"

#include <cmath>
#include <stop_token>

#include <gtest/gtest.h>

#include "myoid/ground/files/text_file.h"

#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace myoid::lab {
namespace {

TwinRow row(std::string parameter, double truth, double estimate, double half_width, fit::Verdict verdict) {
  TwinRow of{1,
             truth,
             {.muscle = "BIC",
              .parameter = std::move(parameter),
              .initial = truth * 1.2,
              .estimate = estimate,
              .ci_low = estimate - half_width,
              .ci_high = estimate + half_width,
              .verdict = verdict}};
  of.estimate.shrinkage = 0.5;
  return of;
}

TEST(TwinSummary, CountsErrorsCoverageAndVerdictsByHand) {
  using fit::Verdict;
  TwinStudyResult result;
  // Errors +4 %, -8 %, +30 %; intervals +-5 %, so that the first alone covers its truth.
  result.rows = {row("max_isometric_force", 100.0, 104.0, 5.0, Verdict::identified),
                 row("max_isometric_force", 200.0, 184.0, 10.0, Verdict::identified),
                 row("max_isometric_force", 100.0, 130.0, 5.0, Verdict::identified)};
  const std::vector<TwinSummary> list = summarize(result);
  ASSERT_EQ(list.size(), 2U);
  EXPECT_EQ(list[0].muscle, "all");
  EXPECT_EQ(list[1].muscle, "BIC");
  const TwinSummary& s = list[0];
  EXPECT_EQ(s.count, 3);
  EXPECT_NEAR(s.bias, 0.04, 1e-12);
  EXPECT_NEAR(s.median_error, 0.08, 1e-12);
  EXPECT_NEAR(s.mad, 0.12, 1e-12);
  EXPECT_NEAR(s.rmse, std::sqrt((0.04 * 0.04 + 0.08 * 0.08 + 0.3 * 0.3) / 3.0), 1e-12);
  EXPECT_NEAR(s.within.of_5, 1.0 / 3.0, 1e-12);
  EXPECT_NEAR(s.within.of_10, 2.0 / 3.0, 1e-12);
  EXPECT_NEAR(s.prior_within_10, 0.0, 1e-12);
  EXPECT_NEAR(s.coverage, 1.0 / 3.0, 1e-12);
  EXPECT_EQ(s.confusion.identified_good, 2);
  EXPECT_EQ(s.confusion.identified_bad, 1);
  EXPECT_EQ(s.identified_within_15, 2);
  EXPECT_EQ(s.outside_physical, 0);
}

TEST(TwinSummary, TheDelayIsCountedInTensOfMilliseconds) {
  TwinStudyResult result;
  result.rows = {row("emg_delay", 0.050, 0.058, 0.010, fit::Verdict::weak)};
  const TwinSummary s = summarize(result).front();
  EXPECT_NEAR(s.bias, 0.08, 1e-12);
  EXPECT_EQ(s.within.of_5, 0.0);
  EXPECT_EQ(s.within.of_10, 1.0);
  EXPECT_EQ(s.coverage, 1.0);
}

TEST(TwinStudy, ExactRecordingsGiveTheTruth) {
  lab::Protocol protocol = lab::read_protocol(test::source_dir() / "examples/protocols/noise_free.toml");
  TwinStudyOptions options;
  options.subjects = 1;
  options.first_seed = 3;
  const TwinStudyResult result = twin_study(protocol, options);
  EXPECT_TRUE(result.failures.empty());
  ASSERT_EQ(result.rows.size(), 25U);
  for (const TwinRow& r : result.rows)
    EXPECT_NEAR(r.error(), 0.0, 1e-6) << r.estimate.muscle << ' ' << r.estimate.parameter;
}

TEST(TwinStudy, StoppedItSaysSoAndHasOnlyWhoIsFinished) {
  const lab::Protocol protocol = lab::read_protocol(test::source_dir() / "examples/protocols/noise_free.toml");
  std::stop_source stop;
  stop.request_stop();
  TwinStudyOptions options;
  options.subjects = 3;
  options.progress.stop = stop.get_token();
  const TwinStudyResult result = twin_study(protocol, options);
  EXPECT_TRUE(result.interrupted);
  EXPECT_EQ(result.subjects, 3);
  EXPECT_EQ(result.finished, 0);
  EXPECT_TRUE(result.rows.empty());
  const test::TemporaryFolder folder;
  write_twin_study(result, {}, folder.path());
  const std::string run = read_text_file(folder / "run.json");
  EXPECT_NE(run.find("\"persons_asked_for\": 3"), std::string::npos);
  EXPECT_NE(run.find("\"persons_finished\": 0"), std::string::npos);
  EXPECT_NE(run.find("\"interrupted\": true"), std::string::npos);
}

}  // namespace
}  // namespace myoid::lab
