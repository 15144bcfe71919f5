#include "myoid/run/quality_gates.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "myoid/core/units.h"
#include "myoid/run/study_validation.h"

namespace myoid {
namespace {

using report::Gate;
using report::GateStatus;

/// One trial of 100 frames whose markers miss the model by `error_m`, and whose joint moves over `range_deg`.
StudyResult some_result(double error_m, int frames_not_converged, double range_deg) {
  StudyResult result;
  TrialResult trial;
  trial.spec.name = "t";
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);
  const Eigen::MatrixXd angle = Eigen::VectorXd::LinSpaced(100, 0.0, range_deg * kDegree);
  const TimeSeries q(time, {{"elbow_flexion", Unit::radian}}, angle);
  trial.motion.joints = {q, q, q};
  kinematics::IkResult ik;
  ik.q = q;
  ik.errors = TimeSeries(time, {{"marker_error_RMS", Unit::meter}}, Eigen::MatrixXd::Constant(100, 1, error_m));
  ik.status.assign(100, kinematics::FrameStatus::converged);
  ik.frames_not_converged = frames_not_converged;
  trial.motion.ik = ik;
  result.trials.push_back(std::move(trial));
  identification::IdentificationResult torque;
  torque.method = "torque";
  torque.termination = math::Termination::converged;
  torque.estimates.push_back(
      {.muscle = "BIC", .parameter = "max_isometric_force", .verdict = identification::Verdict::identified});
  result.fit.methods.push_back(torque);
  return result;
}

std::vector<identification::IdentificationResult> judged_of(const StudyResult& result) {
  return judged(result.fit.methods, {}, result.source.study, result.trials, result.fit.exchanged);
}

identification::Verdict verdict_of(const StudyResult& result) { return judged_of(result)[0].estimates[0].verdict; }

GateStatus status_of(const StudyResult& result, std::string_view name) {
  const std::vector<Gate> gates = quality_gates(result);
  const auto it = std::find_if(gates.begin(), gates.end(), [&](const Gate& g) { return g.name == name; });
  return it == gates.end() ? GateStatus::info : it->status;
}

TEST(QualityGates, MarkersThatMissTheModelByCentimetresAreACautionThenAFailure) {
  EXPECT_EQ(status_of(some_result(0.010, 0, 90.0), "Markers fit the model"), GateStatus::pass);
  EXPECT_EQ(status_of(some_result(0.030, 0, 90.0), "Markers fit the model"), GateStatus::warn);
  EXPECT_EQ(status_of(some_result(0.050, 0, 90.0), "Markers fit the model"), GateStatus::fail);
}

TEST(QualityGates, AWarningAboutAFileIsNoRecordingWithoutFaults) {
  const char* gate = "Recordings without faults";
  StudyResult result = some_result(0.010, 0, 90.0);
  EXPECT_EQ(status_of(result, gate), GateStatus::pass);
  result.trials[0].remarks = {{.says = "e.sto: the EMG lacks 7.5 s of the motion"}};
  EXPECT_EQ(status_of(result, gate), GateStatus::warn);
  const report::Section section = recordings_section(result);
  ASSERT_EQ(section.tables.size(), 1U);
  EXPECT_EQ(section.tables[0].rows[0][3].text, result.trials[0].remarks[0].says);
}

TEST(QualityGates, AFaultNamesItsChannelAndTrial) {
  StudyResult result = some_result(0.010, 0, 90.0);
  Remark hum{.code = RemarkCode::emg_hum, .where = "slow"};
  for (const char* channel : {"BIC", "BRA", "BRD", "TRI"}) {
    hum.about = channel;
    result.trials[0].faults.push_back(hum);
  }
  for (const Gate& gate : quality_gates(result)) {
    if (gate.name == "Recordings without faults") {
      EXPECT_EQ(gate.value, "4 found, emg hum: BIC in slow, BRA in slow, BRD in slow and 1 more");
    }
  }
}

TEST(QualityGates, FramesWithoutAPoseAreACautionThenAFailure) {
  const char* gate = "Inverse kinematics converged";
  EXPECT_EQ(status_of(some_result(0.01, 0, 90.0), gate), GateStatus::pass);
  EXPECT_EQ(status_of(some_result(0.01, 2, 90.0), gate), GateStatus::warn);
  EXPECT_EQ(status_of(some_result(0.01, 48, 90.0), gate), GateStatus::fail);
}

TEST(QualityGates, RadiansTakenForDegreesAreAFailure) {
  EXPECT_EQ(status_of(some_result(0.01, 0, 90.0), "The joint moves"), GateStatus::info);
  EXPECT_EQ(status_of(some_result(0.01, 0, 90.0 * kDegree), "The joint moves"), GateStatus::fail);
}

TEST(QualityGates, ExchangedElectrodesAreAFailureOrOfSynergistsACaution) {
  const char* gate = "Electrodes on the muscles that they are named for";
  StudyResult result = some_result(0.01, 0, 90.0);
  EXPECT_EQ(status_of(result, gate), GateStatus::info);
  result.fit.exchanged = {.first = "BIC", .second = "TRI", .as_named = {}, .exchanged = {}};
  EXPECT_EQ(status_of(result, gate), GateStatus::fail);
  result.fit.exchanged->as_named.r2 = 0.9;
  EXPECT_EQ(status_of(result, gate), GateStatus::warn);
  EXPECT_EQ(verdict_of(result), identification::Verdict::weak);
}

TEST(QualityGates, NothingIsIdentifiedFromAMotionThatFailed) {
  EXPECT_EQ(verdict_of(some_result(0.01, 0, 90.0)), identification::Verdict::identified);
  const StudyResult bad = some_result(0.05, 0, 90.0);
  EXPECT_EQ(verdict_of(bad), identification::Verdict::weak);
  EXPECT_NE(judged_of(bad)[0].estimates[0].reason.find("quality gate"), std::string::npos);
}

TEST(QualityGates, TheWarningsOfTheValidationGoToMethodTorque) {
  const StudyResult result = some_result(0.01, 0, 90.0);
  std::vector<identification::IdentificationResult> methods(2);
  methods[0].method = "paper";
  methods[1].method = "torque";
  methods =
      judged(std::move(methods), {.folds = {}, .warnings = {"one trial"}}, result.source.study, result.trials, {});
  EXPECT_TRUE(methods[0].warnings.empty());
  EXPECT_EQ(methods[1].warnings, std::vector<std::string>{"one trial"});
}

}  // namespace
}  // namespace myoid
