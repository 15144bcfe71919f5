#include "myoid/pipeline/trial_quality.h"

#include <gtest/gtest.h>

#include "myoid/model/arm4.h"
#include "myoid/model/osim_reader.h"

namespace myoid::pipeline {
namespace {

using signals::Fault;
using signals::FaultKind;

TEST(SegmentsOf, AreTheBodiesThatCarryTwoMarkersOrMore) {
  const model::BodyModel model = model::parse_osim(model::arm4_osim(), "arm4.osim");
  recording::MarkerSeries markers;
  for (const model::Marker& marker : model.markers) markers.names.push_back(marker.name);
  markers.names.emplace_back("of nobody");
  std::size_t known = 0;
  for (const signals::ExpectedSegment& e : segments_of(model, markers)) {
    ASSERT_GE(e.segment.markers.size(), 2U);
    ASSERT_EQ(static_cast<std::size_t>(e.local_m.cols()), e.segment.markers.size());
    for (std::size_t k = 0; k < e.segment.markers.size(); ++k) {
      const auto& marker = model.markers[static_cast<std::size_t>(e.segment.markers[k])];
      EXPECT_EQ(model.bodies[static_cast<std::size_t>(marker.body)].name, e.segment.name);
      EXPECT_EQ(marker.p_BM, e.local_m.col(static_cast<Eigen::Index>(k)));
      ++known;
    }
  }
  EXPECT_GE(known, 2U);
}

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
}  // namespace myoid::pipeline
