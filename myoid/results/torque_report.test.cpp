#include "myoid/results/torque_report.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/page/tables.h"

namespace myoid::results {
namespace {

run::StudyResult two_joints() {
  run::StudyResult result;
  result.source.study.model.coordinate = "knee";
  result.source.study.model.more_coordinates = {"ankle"};
  const Eigen::VectorXd time = Eigen::VectorXd::LinSpaced(50, 0.0, 1.0);
  Eigen::MatrixXd values(50, 2);
  values.col(0) = Eigen::VectorXd::LinSpaced(50, 10.0 * kDegree, 60.0 * kDegree);
  values.col(1) = Eigen::VectorXd::LinSpaced(50, -5.0 * kDegree, 25.0 * kDegree);
  run::TrialResult trial;
  trial.spec.name = "squat";
  const TimeSeries q(time, {{"knee", Unit::radian}, {"ankle", Unit::radian}}, values);
  trial.motion.joints = {q, q, q};
  trial.forces.muscle_torque =
      TimeSeries(time, {{"knee_moment", Unit::newton_meter}, {"ankle_moment", Unit::newton_meter}}, values / kDegree);
  result.trials.push_back(trial);
  fit::IdentificationResult torque;
  torque.method = fit::Method::torque;
  for (const char* joint : {"knee", "ankle"}) {
    fit::TrialFit fit;
    fit.trial = "squat";
    fit.joint = joint;
    fit.calibration = false;
    fit.time_s = time;
    fit.torque_nm = fit.literature_torque_nm = fit.torque_fit_nm = values.col(0);
    fit.score = fit::score(fit.torque_nm, fit.torque_fit_nm);
    torque.trials.push_back(fit);
    fit::Fold fold;
    fold.trial = "squat";
    fold.joint = joint;
    fold.time_s = time;
    fold.measured_nm = fold.predicted_nm = fold.literature_nm = values.col(1);
    result.folds.push_back(fold);
  }
  result.fit.methods.push_back(torque);
  return result;
}

TEST(TorqueReport, EveryJointOfATrialHasItsRowAndItsPanel) {
  const std::vector<page::Section> sections = validation_sections(two_joints());
  ASSERT_EQ(sections.size(), 2U);
  for (const page::Section& section : sections) {
    ASSERT_EQ(section.tables.at(0).rows.size(), 2U);
    EXPECT_EQ(section.tables[0].rows[0][0].text, "squat, knee");
    EXPECT_EQ(section.tables[0].rows[1][0].text, "squat, ankle");
    EXPECT_EQ(section.figures.at(0).panels.size(), 2U);
  }
}

TEST(TorqueReport, MeasuredFasciclesHaveATableOfWhatWasLeftOutAndOneOfTheWholeFit) {
  run::StudyResult result = two_joints();
  result.folds[0].fibers = {{.muscle = "TA", .n = 4.0, .sse_m2 = 4.0 * 0.002 * 0.002}};
  result.fit.methods[0].trials[0].fibers = {{.muscle = "TA", .n = 1.0, .sse_m2 = 0.001 * 0.001}};
  const std::vector<page::Section> sections = validation_sections(result);
  ASSERT_EQ(sections.size(), 3U);
  ASSERT_EQ(sections[2].tables.size(), 2U);
  EXPECT_EQ(page::table_csv(sections[2].tables[0]), "trial,muscle,RMS [mm]\nsquat,TA,2.00\n");
  EXPECT_EQ(page::table_csv(sections[2].tables[1]), "trial,muscle,RMS [mm]\nsquat,TA,1.00\n");
}

TEST(TorqueReport, RangesOfSeveralJointsStandInTheOrderOfTheCoordinates) {
  const page::Table table = trials_table(two_joints());
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0][4].text, "10 to 60; -5 to 25 deg");
  EXPECT_EQ(table.rows[0][5].text, "10.0 to 60.0; -5.0 to 25.0 N m");
}

TEST(TorqueReport, WithoutHeldBackOrLeftOutTrialsThereIsNothingToValidate) {
  run::StudyResult result = two_joints();
  result.folds.clear();
  for (fit::TrialFit& fit : result.fit.methods[0].trials) fit.calibration = true;
  EXPECT_TRUE(validation_sections(result).empty());
}

}  // namespace
}  // namespace myoid::results
