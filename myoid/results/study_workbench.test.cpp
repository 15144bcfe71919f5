#include "myoid/results/study_workbench.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::results {
namespace {

const page::TimePlot& plot(const page::WorkbenchTrial& trial, const std::string& kind) {
  for (const page::TimePlot& p : trial.plots)
    if (p.kind == kind) return p;
  throw std::runtime_error(kind);
}

/// One trial of the built-in arm: 4 s at 1000 Hz, the elbow rising evenly to 90 degrees.
run::StudyResult one_trial() {
  run::StudyResult result;
  result.source.study.subject.name = "S01";
  result.source.study.model.coordinate = "elbow_flexion";
  run::TrialResult trial;
  trial.spec.name = "slow";
  trial.motion.model = std::make_shared<const body::BodyModel>(body::parse_osim(body::arm4_osim(), "arm4.osim"));
  std::vector<Channel> channels;
  for (const body::Coordinate& c : trial.motion.model->coordinates) channels.push_back({c.name, Unit::radian});
  Eigen::MatrixXd q = trial.motion.model->default_q().transpose().replicate(4001, 1);
  q.col(trial.motion.model->coordinate_index("elbow_flexion")).setLinSpaced(0.0, 0.5 * kPi);
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(4001, 0.0, 4.0);
  trial.motion.joints.q = TimeSeries(t, channels, q);
  trial.forces.muscle_torque = TimeSeries(t, {{"elbow_flexion", Unit::newton_meter}}, Eigen::VectorXd(3.0 * t));
  trial.emg.activation = TimeSeries(t, {{"BIC", Unit::dimensionless}}, Eigen::VectorXd(0.1 * t));
  Remark hum{.code = RemarkCode::emg_hum, .about = "BIC", .when = Stretch{1.0, 2.0}, .says = "hum"};
  trial.faults = {hum};
  result.trials = {trial};
  result.source.model = trial.motion.model;
  return result;
}

TEST(StudyWorkbench, ShowsEverySampleOrEveryNthOfTheFiles) {
  const page::Workbench workbench = study_workbench(one_trial(), "results");
  EXPECT_NO_THROW(page::validate(workbench));
  ASSERT_EQ(workbench.trials.size(), 1U);
  const page::WorkbenchTrial& trial = workbench.trials[0];
  EXPECT_EQ(trial.scene, 0);
  const page::TimeLine& angle = plot(trial, "angle").lines[0];
  const Eigen::VectorXd& clock = trial.clocks[static_cast<std::size_t>(angle.clock)];
  EXPECT_EQ(clock.size(), 4001);  // at most 15,000
  EXPECT_NEAR(angle.value[2000], 45.0, 1e-9);
  EXPECT_EQ(plot(trial, "angle").unit, "deg");
  EXPECT_NEAR(plot(trial, "torque").lines[0].value[1000], 3.0, 1e-12);
  // Of many trials the same samples are thinned to values of the files.
  run::StudyResult many = one_trial();
  many.trials.resize(30, many.trials[0]);
  const page::WorkbenchTrial thin = study_workbench(many, "results").trials[7];
  const page::TimeLine& few = plot(thin, "torque").lines[0];
  const Eigen::VectorXd& times = thin.clocks[static_cast<std::size_t>(few.clock)];
  EXPECT_LE(times.size(), 500);
  EXPECT_GE(times.size(), 250);
  EXPECT_LT((few.value - 3.0 * times).norm(), 1e-12);
}

TEST(StudyWorkbench, MarksAFaultOnItsChannelAndOnTheTrial) {
  const page::WorkbenchTrial trial = study_workbench(one_trial(), "results").trials[0];
  EXPECT_EQ(trial.badge, page::Badge::weak);
  ASSERT_EQ(trial.marks.size(), 1U);
  EXPECT_EQ(trial.marks[0].about, "BIC");
  EXPECT_TRUE(trial.marks[0].when.has_value());
  EXPECT_EQ(trial.marks[0].when.value_or(Stretch{}).end_s, 2.0);
  // The channel at a glance: the greatest activation of each of 160 stretches rises to the end's.
  ASSERT_EQ(trial.carpet.size(), 1U);
  EXPECT_EQ(trial.carpet[0].value.size(), 160);
  EXPECT_NEAR(trial.carpet[0].value[159], 0.4, 1e-12);
  EXPECT_NEAR(trial.carpet[0].value[79], 0.2, 0.0025);
}

TEST(StudyWorkbench, AWarningAboutTheFilesMarksTheTrialAndANoteDoesNot) {
  run::StudyResult result = one_trial();
  result.trials[0].faults.clear();
  result.trials[0].remarks = {{.code = RemarkCode::reading, .severity = Severity::note, .says = "times were counted"}};
  EXPECT_EQ(study_workbench(result, "results").trials[0].badge, page::Badge::good);
  result.trials[0].remarks.push_back(
      {.code = RemarkCode::body_unsupported, .severity = Severity::warning, .says = "nothing carries the body"});
  const page::WorkbenchTrial trial = study_workbench(result, "results").trials[0];
  EXPECT_EQ(trial.badge, page::Badge::weak);
  EXPECT_THAT(sentences(trial.remarks), testing::ElementsAre(testing::HasSubstr("nothing carries the body")));
}

TEST(StudyWorkbench, ATrialThatFailedIsListedWithItsReason) {
  run::StudyResult result = one_trial();
  result.trials[0] = run::TrialResult{};
  result.trials[0].spec.name = "lost";
  result.trials[0].motion.failure = "no markers";
  const page::WorkbenchTrial trial = study_workbench(result, "results").trials.at(0);
  EXPECT_EQ(trial.badge, page::Badge::bad);
  EXPECT_EQ(trial.scene, -1);
  EXPECT_THAT(trial.remarks.at(0).says, testing::HasSubstr("no markers"));
}

TEST(StudyWorkbench, AFilmHasItsPathFromTheReport) {
  run::StudyResult result = one_trial();
  const auto path = [&](const char* video, const char* folder) {
    result.trials[0].spec.video = video;
    return study_workbench(result, folder).trials[0].video;
  };
  EXPECT_EQ(path("rec/films/a b.mp4", "out/first"), "../../rec/films/a b.mp4");
  EXPECT_EQ(path("rec/a.mp4", "rec/"), "a.mp4");
  EXPECT_EQ(path("/rec/a.mp4", "/rec/out/."), "../a.mp4");
  result.trials[0].spec.video_offset_s = -2.5;
  EXPECT_EQ(study_workbench(result, "out").trials[0].video_offset_s, -2.5);
}

}  // namespace
}  // namespace myoid::results
