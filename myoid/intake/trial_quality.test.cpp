#include "myoid/intake/trial_quality.h"

#include <gtest/gtest.h>

namespace myoid {
namespace {

Fault fault(FaultKind kind, const std::string& channel, bool grave = true) {
  Fault f;
  f.kind = kind;
  f.channel = channel;
  f.grave = grave;
  f.text = channel + " is bad";
  return f;
}

TEST(FaultSummary, SaysTheSameOfSeveralTrialsOnce) {
  const auto lines = fault_summary({{"one", fault(FaultKind::emg_hum, "BIC")},
                                    {"one", fault(FaultKind::emg_drift, "BIC", false)},
                                    {"two", fault(FaultKind::emg_hum, "BIC")},
                                    {"", fault(FaultKind::emg_low_signal, "TRI")}});
  EXPECT_EQ(lines,
            (std::vector<std::string>{"trial one: BIC is bad (likewise in two)", "TRI is bad"}));
}

TEST(FaultSummary, EndsAfterSoManyLines) {
  std::vector<NamedFault> faults;
  for (int k = 0; k < 9; ++k)
    faults.push_back({"t", fault(FaultKind::marker_gap, std::to_string(k))});
  const auto lines = fault_summary(faults, 5);
  ASSERT_EQ(lines.size(), 6U);
  EXPECT_EQ(lines.back(), "4 more faults: see `myoid check`");
}

TEST(TrialFaults, HoldWhatWasFoundOfTheMarkersAndOfTheClocks) {
  Study study;
  TrialInput input;
  input.marker_faults.push_back(fault(FaultKind::marker_jump, "C7"));
  Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(100, 0.0, 0.99);
  for (Eigen::Index i = 0; i < 100; i += 2) time[i] += 0.002;
  input.motion = TimeSeries(time, {{"q", Unit::radian}}, Eigen::MatrixXd::Zero(100, 1));
  const std::vector<Fault> faults = trial_faults(study, input, {});
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(faults[0].kind, FaultKind::marker_jump);
  EXPECT_EQ(faults[1].kind, FaultKind::clock_uneven);
}

}  // namespace
}  // namespace myoid
