#include "myoid/checks/recording_findings.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "myoid/arm/arm4.h"
#include "myoid/osim/osim_reader.h"

namespace myoid {
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
      recording_findings(study, model::parse_osim(model::arm4_osim(), "arm4.osim"), inputs,
                         study_activation(study, emg));
  ASSERT_EQ(found.of_trials.size(), 2U);
  const auto above = [](const Fault& f) { return f.kind == FaultKind::emg_over_reference; };
  EXPECT_TRUE(std::any_of(found.levels.begin(), found.levels.end(), above));
  for (const std::vector<Fault>& faults : found.of_trials)
    EXPECT_TRUE(std::none_of(faults.begin(), faults.end(), above));
  EXPECT_TRUE(found.dynamometers.empty());
}

}  // namespace
}  // namespace myoid
