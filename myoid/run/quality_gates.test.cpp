#include "myoid/run/quality_gates.h"

#include <algorithm>
#include <utility>

#include <gtest/gtest.h>

#include "myoid/fit/intervals/verdicts.h"
#include "myoid/ground/core/units.h"
#include "myoid/run/recording_faults.h"
#include "myoid/run/verdict_caps.h"

namespace myoid::run {
namespace {

using fit::Method;

using page::Gate;
using page::GateStatus;

/// One trial of 100 frames whose markers miss the model by `error_m`, and whose joint moves over `range_deg`.
StudyResult some_result(double error_m, int frames_not_converged, double range_deg) {
  StudyResult result;
  TrialResult trial;
  trial.spec.name = "t";
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(100, 0.0, 1.0);
  const Eigen::MatrixXd angle = Eigen::VectorXd::LinSpaced(100, 0.0, range_deg * kDegree);
  const TimeSeries q(time, {{"elbow_flexion", Unit::radian}}, angle);
  trial.motion.joints = {q, q, q};
  body::IkResult ik;
  ik.q = q;
  ik.errors = TimeSeries(time, {{"marker_error_RMS", Unit::meter}}, Eigen::MatrixXd::Constant(100, 1, error_m));
  ik.status.assign(100, body::FrameStatus::converged);
  ik.frames_not_converged = frames_not_converged;
  trial.motion.ik = ik;
  result.trials.push_back(std::move(trial));
  fit::IdentificationResult torque;
  torque.method = fit::Method::torque;
  torque.termination = math::Termination::converged;
  torque.estimates.push_back(
      {.muscle = "BIC", .parameter = "max_isometric_force", .verdict = fit::Verdict::identified});
  result.fit.methods.push_back(torque);
  return result;
}

/// The method with the caps that follow from the result.
fit::ParameterEstimate capped(const StudyResult& result, fit::Method method = fit::Method::torque) {
  fit::IdentificationResult fit = result.fit.methods[0];
  fit.method = method;
  fit::apply(verdict_caps(result, quality_gates(result)), fit);
  return fit.estimates[0];
}

fit::Verdict verdict_of(const StudyResult& result) { return capped(result).verdict; }

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
  const page::Section section = recordings_section(result);
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
      EXPECT_EQ(gate.value, "4 found, EMG hum: BIC in slow, BRA in slow, BRD in slow, TRI in slow");
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
  result.fit.mistaken = {.first = "BIC", .second = "TRI", .log_odds = 20.0, .r2 = 0.0};
  EXPECT_EQ(status_of(result, gate), GateStatus::fail);
  result.fit.mistaken->r2 = 0.9;
  EXPECT_EQ(status_of(result, gate), GateStatus::warn);
  EXPECT_EQ(verdict_of(result), fit::Verdict::weak);
}

TEST(QualityGates, EmgThatIsMistakenInOneTrialIsNamedFirstAndCapsAllNumbers) {
  StudyResult result = some_result(0.01, 0, 90.0);
  result.fit.mistaken = {.trial = "slow", .first = "BIC", .second = "TRI", .log_odds = 20.0, .r2 = 0.9};
  // An exchange puts the torque's unit in doubt.
  result.trials[0].remarks = {{.code = RemarkCode::unit_doubtful, .about = "elbow_flexion", .says = "radians?"}};
  EXPECT_TRUE(quality_gates(result).front().explains);
  EXPECT_EQ(verdict_of(result), fit::Verdict::weak);
  result.trials[0].remarks.clear();
  result.fit.mistaken = {.trial = "slow", .gain = 3.0, .log_odds = 20.0, .r2 = 0.9};
  EXPECT_TRUE(quality_gates(result).front().explains);
  EXPECT_EQ(verdict_of(result), fit::Verdict::weak);
}

TEST(QualityGates, AUnitInDoubtComesBeforeAllThatItExplains) {
  StudyResult result = some_result(0.01, 0, 90.0);
  result.fit.mistaken = {.first = "BIC", .second = "TRI", .log_odds = 20.0, .r2 = 0.0};
  result.trials[0].remarks = {{.code = RemarkCode::unit_doubtful, .about = "elbow_flexion", .says = "radians?"}};
  EXPECT_EQ(quality_gates(result).front().value, "radians?");
  EXPECT_EQ(quality_gates(result).front().status, GateStatus::warn);
  const char* electrodes = "Electrodes on the muscles that they are named for";
  EXPECT_EQ(status_of(result, electrodes), GateStatus::info);
  EXPECT_EQ(verdict_of(result), fit::Verdict::weak);
  // The joint hardly moves, too: the unit is the first failure.
  StudyResult still = some_result(0.01, 0, 90.0 * kDegree);
  still.trials[0].remarks = result.trials[0].remarks;
  EXPECT_EQ(quality_gates(still).front().status, GateStatus::fail);
}

TEST(QualityGates, AUnitInDoubtInAnotherTrialHidesNoGain) {
  StudyResult result = some_result(0.01, 0, 90.0);
  result.trials[0].remarks = {{.code = RemarkCode::unit_doubtful, .about = "elbow_flexion", .says = "N cm?"}};
  result.fit.mistaken = {.trial = result.trials[0].spec.name, .gain = 3.0, .log_odds = 30.0, .r2 = 0.9};
  EXPECT_EQ(named_mistake(result), nullptr);
  result.fit.mistaken->trial = "mvc";
  EXPECT_EQ(named_mistake(result), &*result.fit.mistaken);
}

TEST(YieldToMistake, NoWarningContradictsAGainThatIsNamed) {
  StudyResult result = some_result(0.01, 0, 90.0);
  const auto level = [](const char* trial) {
    return Remark{.code = RemarkCode::emg_over_reference, .where = trial, .about = "BIC", .remedy = "no maximum"};
  };
  result.level_faults = {level("slow"), level("fast")};
  result.trials[0].remarks = {{.code = RemarkCode::unit_doubtful, .about = "elbow_flexion", .remedy = "other unit"}};
  yield_to_mistake(result);
  EXPECT_EQ(result.level_faults[0].remedy, "no maximum");
  result.fit.mistaken = {.trial = "slow", .gain = 3.0, .log_odds = 30.0, .r2 = 0.9};
  yield_to_mistake(result);
  EXPECT_EQ(result.level_faults[0].remedy, result.fit.mistaken->remedy());
  EXPECT_EQ(result.level_faults[1].remedy, "no maximum");
  EXPECT_EQ(result.trials[0].remarks[0].remedy, "other unit");
  // The gain of a maximal contraction is in the activation of all trials.
  result.trials.push_back(result.trials[0]);
  result.trials[1].spec.name = result.fit.mistaken->trial = "mvc";
  result.trials[1].spec.use = study::Use::mvc;
  result.trials[1].remarks.clear();
  yield_to_mistake(result);
  EXPECT_EQ(result.level_faults[1].remedy, result.fit.mistaken->remedy());
  EXPECT_EQ(result.trials[0].remarks[0].remedy, result.fit.mistaken->remedy());
}

TEST(TrialWarnings, OneTextOfSeveralTrialsIsOneRemarkWithTheirNames) {
  StudyResult result = some_result(0.01, 0, 90.0);
  result.trials[0].remarks = {{.says = "the EMG is short"}, {.severity = Severity::note, .says = "a comma"}};
  result.trials.resize(3, result.trials[0]);
  result.trials[1].spec.name = "u";
  result.trials[2].spec.name = "v";
  const std::vector<Remark> found = trial_warnings(result);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].where, "t");
  EXPECT_EQ(found[0].likewise, (std::vector<std::string>{"u", "v"}));
  EXPECT_EQ(recordings_section(result).tables.at(0).rows.size(), 1U);
}

TEST(QualityGates, QuestionsThatNobodyAnsweredComeFirst) {
  StudyResult result = some_result(0.01, 0, 90.0);
  result.source.unanswered = Remark{.code = RemarkCode::unanswered, .says = "line 7: the person's mass"};
  const Gate first = quality_gates(result).front();
  EXPECT_EQ(first.status, GateStatus::warn);
  EXPECT_EQ(first.value, result.source.unanswered->says);
}

TEST(QualityGates, NothingIsIdentifiedFromAMotionThatFailed) {
  EXPECT_EQ(verdict_of(some_result(0.01, 0, 90.0)), fit::Verdict::identified);
  const StudyResult bad = some_result(0.05, 0, 90.0);
  EXPECT_EQ(verdict_of(bad), fit::Verdict::weak);
  EXPECT_NE(capped(bad).reason.find("quality gate"), std::string::npos);
}

using fit::Verdict;

/// A study of BIC and TRI with a channel each, whose EMG has its greatest effort in the trial "mvc".
StudyResult with_emg() {
  StudyResult result = some_result(0.01, 0, 90.0);
  for (const char* name : {"BIC", "TRI"}) {
    study::MuscleSpec muscle;
    muscle.name = name;
    muscle.emg = std::string("emg ") + name;
    result.source.study.muscles.push_back(muscle);
    result.emg.normalisation.push_back(
        {.channel = muscle.emg, .reference_v = 1e-3, .source_trial = "mvc", .from_mvc = true});
  }
  TrialResult mvc;
  mvc.spec.name = "mvc";
  mvc.spec.use = study::Use::mvc;
  result.trials.push_back(std::move(mvc));
  return result;
}

TEST(VerdictCaps, EmgThatIsCutOffInTheMaximalContractionCapsTheStrengthThatRestsOnIt) {
  StudyResult result = with_emg();
  EXPECT_EQ(verdict_of(result), Verdict::identified);
  result.trials[1].faults = {{.code = RemarkCode::emg_clipped, .where = "mvc", .about = "emg BIC"}};
  EXPECT_EQ(verdict_of(result), Verdict::weak);
  EXPECT_NE(capped(result).reason.find("emg BIC in mvc"), std::string::npos) << capped(result).reason;
  // Not that of the other channel, and no length.
  result.fit.methods[0].estimates[0].muscle = "TRI";
  EXPECT_EQ(verdict_of(result), Verdict::identified);
  // The exponent of the channel is that of a scale which ends at activation 1.
  result.fit.methods[0].estimates[0].muscle = "emg BIC";
  result.fit.methods[0].estimates[0].parameter = "emg_exponent";
  EXPECT_EQ(verdict_of(result), Verdict::weak);
  result.fit.methods[0].estimates[0].muscle = "BIC";
  result.fit.methods[0].estimates[0].parameter = "optimal_fiber_length";
  EXPECT_EQ(verdict_of(result), Verdict::identified);
  // In a fitted trial every number of the muscle rests on it.
  result.trials[0].faults = {
      {.code = RemarkCode::emg_saturated, .where = "t", .about = "emg BIC", .when = Stretch{0.2, 0.4}}};
  EXPECT_EQ(verdict_of(result), Verdict::weak);
  result.trials[0].spec.exclude.windows = {{0.1, 0.5}};
  EXPECT_EQ(verdict_of(result), Verdict::identified);
}

TEST(VerdictCaps, AFaultThatIsMendedOrANoteCapsNothing) {
  StudyResult result = with_emg();
  result.trials[1].faults = {
      {.code = RemarkCode::emg_hum, .where = "mvc", .about = "emg BIC"},
      {.code = RemarkCode::emg_clipped, .severity = Severity::note, .where = "mvc", .about = "emg BIC"}};
  EXPECT_EQ(verdict_of(result), Verdict::identified);
}

TEST(VerdictCaps, ALateClockAndAnotherFootCapAllAndAnExcludedFootNothing) {
  StudyResult result = with_emg();
  result.fit.shifted.emplace();
  EXPECT_EQ(verdict_of(result), Verdict::weak);
  result.fit.shifted.reset();
  result.trials[0].remarks = {{.code = RemarkCode::foreign_contact, .says = "another's foot"}};
  EXPECT_EQ(verdict_of(result), Verdict::weak);
  result.trials[0].remarks[0].severity = Severity::note;  // its times are left out
  EXPECT_EQ(verdict_of(result), Verdict::identified);
}

TEST(VerdictCaps, ADynamometerThatDisagreesWithTheMassesIsACautionAndCapsStrengths) {
  StudyResult result = some_result(0.005, 0, 60.0);
  const auto cautions = [&] { return std::ranges::count(quality_gates(result), GateStatus::warn, &Gate::status); };
  const auto usual = cautions();
  result.fit.scales = {.ratio = 1.02, .low = 0.98, .high = 1.06, .usual = 0.03};
  EXPECT_EQ(cautions(), usual);
  EXPECT_EQ(capped(result).verdict, fit::Verdict::identified);
  result.fit.scales = {.ratio = 1.1, .low = 1.05, .high = 1.15, .usual = 0.03};
  EXPECT_EQ(cautions(), usual + 1);
  EXPECT_EQ(capped(result).verdict, fit::Verdict::weak);
  result.fit.methods[0].estimates[0].parameter = "optimal_fiber_length";
  EXPECT_EQ(capped(result).verdict, fit::Verdict::identified);
}

TEST(VerdictCaps, AGateThatFailedCapsTheMethodsThatItConcerns) {
  StudyResult result = with_emg();
  result.trials[0].forces.shared.status.resize(100);
  result.trials[0].forces.shared.frames_not_solved = 1;
  EXPECT_EQ(status_of(result, kSharingGate), GateStatus::info) << "no result of the recording rests on shared forces";
  result.source.study.identify.methods = {fit::Method::force, fit::Method::torque};
  EXPECT_EQ(status_of(result, kSharingGate), GateStatus::fail);
  EXPECT_EQ(capped(result, Method::torque).verdict, Verdict::identified);
  EXPECT_EQ(capped(result, Method::force).verdict, Verdict::weak);
  result.fit.methods[0].termination = math::Termination::iteration_limit;
  EXPECT_EQ(status_of(result, "Fit converged"), GateStatus::fail);
  EXPECT_EQ(capped(result, Method::torque).verdict, Verdict::weak);
}

TEST(QualityGates, ExternalLoadsAreStatedByAnyOfTheirKeysAlsoAsNothing) {
  const char* gate = "External loads stated";
  StudyResult result = some_result(0.01, 0, 90.0);
  EXPECT_EQ(status_of(result, gate), GateStatus::warn);
  result.trials[0].spec.held_mass_kg = 0.0;
  EXPECT_EQ(status_of(result, gate), GateStatus::pass);
  result.trials[0].spec.held_mass_kg.reset();
  result.trials[0].spec.external_loads = "grf.xml";
  EXPECT_EQ(status_of(result, gate), GateStatus::pass);
  result.trials[0].spec.external_loads.reset();
  result.trials[0].spec.use = study::Use::mvc;  // no torque of it is fitted
  EXPECT_EQ(status_of(result, gate), GateStatus::pass);
}

}  // namespace
}  // namespace myoid::run
