#include "myoid/study/checks/recording_findings.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::study {
namespace {

/// Envelopes of one channel: at rest for half of the time, then at `level`.
TimeSeries envelope(double level) {
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(1001, 0.0, 5.0);
  Eigen::MatrixXd values = Eigen::MatrixXd::Constant(1001, 1, 1e-6);
  values.bottomRows(500).setConstant(level);
  return {time_s, {{"BIC", Unit::volt}}, values};
}

TEST(RecordingFindings, AMovementAboveTheMaximalContractionIsOfTheLevelsAndNotOfATrial) {
  Study study;
  study.emg.kind = EmgKind::envelope;
  study.trials.resize(2);
  study.trials[0].name = "mvc";
  study.trials[0].use = Use::mvc;
  study.trials[1].name = "lift";
  std::vector<TrialInput> inputs(2);
  inputs[0].emg = envelope(1e-4);
  inputs[1].emg = envelope(2e-4);
  const EmgOfTrials emg = emg_of(inputs);
  EXPECT_EQ(emg[1], &*inputs[1].emg);
  const RecordingFindings found =
      recording_findings(study, body::parse_osim(body::arm4_osim(), "arm4.osim"), inputs, study_activation(study, emg));
  ASSERT_EQ(found.of_trials.size(), 2U);
  const auto above = [](const Remark& f) { return f.code == RemarkCode::emg_over_reference; };
  EXPECT_TRUE(std::any_of(found.levels.begin(), found.levels.end(), above));
  for (const std::vector<Remark>& faults : found.of_trials)
    EXPECT_TRUE(std::none_of(faults.begin(), faults.end(), above));
  EXPECT_TRUE(found.dynamometers.empty());
}

Remark bad_channel(const std::string& trial,
                   RemarkCode code,
                   const std::string& channel,
                   Severity severity = Severity::warning) {
  return {.code = code,
          .severity = severity,
          .where = trial,
          .about = channel,
          .when = Stretch{0.0, 1.0},
          .says = channel + " is bad"};
}

TEST(FaultSummary, SaysTheSameOfSeveralTrialsOnce) {
  const auto lines = fault_summary(
      {bad_channel("one", RemarkCode::emg_hum, "BIC"), bad_channel("one", RemarkCode::emg_drift, "BIC", Severity::note),
       bad_channel("two", RemarkCode::emg_hum, "BIC"), bad_channel("", RemarkCode::emg_low_signal, "TRI")});
  EXPECT_EQ(lines, (std::vector<std::string>{"trial one: BIC is bad (likewise in two)", "TRI is bad"}));
}

TEST(FaultSummary, EndsAfterSoManyLines) {
  std::vector<Remark> faults;
  for (int k = 0; k < 9; ++k) faults.push_back(bad_channel("t", RemarkCode::marker_gap, std::to_string(k)));
  const auto lines = fault_summary(faults, 5);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines.back(), "4 more faults: see `myoid check`");
}

}  // namespace
}  // namespace myoid::study
