#include "myoid/results/study_scene.h"

#include <memory>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::results {
namespace {

/// A trial of the built-in arm: elbow flexing for a second at 100 Hz.
run::TrialResult flexing(const std::string& name) {
  run::TrialResult trial;
  trial.spec.name = name;
  trial.motion.model = std::make_shared<const body::BodyModel>(body::parse_osim(body::arm4_osim(), "arm4.osim"));
  std::vector<Channel> channels;
  for (const body::Coordinate& c : trial.motion.model->coordinates) channels.push_back({c.name, Unit::radian});
  Eigen::MatrixXd q = trial.motion.model->default_q().transpose().replicate(101, 1);
  q.col(trial.motion.model->coordinate_index("elbow_flexion")).setLinSpaced(0.0, 1.5);
  trial.motion.joints.q = TimeSeries(Eigen::VectorXd::LinSpaced(101, 0.0, 1.0), channels, q);
  trial.emg.activation =
      TimeSeries(Eigen::Vector2d(0.0, 1.0), {{"Biceps", Unit::dimensionless}}, Eigen::Vector2d(0.2, 0.6));
  MarkerSeries markers;
  markers.time_s = Eigen::Vector2d(0.0, 1.0);
  markers.names = {trial.motion.model->markers[0].name};
  markers.positions_m.setZero(2, 3);
  trial.input.markers = markers;
  return trial;
}

run::StudyResult two_trials() {
  run::StudyResult result;
  result.source.study.subject.name = "S01";
  result.source.study.muscles = {{.name = "BIC", .osim = {"BIC", "BRA"}, .emg = "Biceps"}};
  result.trials = {flexing("slow"), run::TrialResult{}, flexing("fast")};
  result.trials[1].spec.name = "mvc without motion";
  result.source.model = result.trials[0].motion.model;
  return result;
}

TEST(StudyScenes, HaveTheTrialsThatMoveWithTheirMarkersAndActivations) {
  const page::ScenePage page = study_scenes(two_trials());
  EXPECT_EQ(page.title, "S01");
  ASSERT_EQ(page.scenes.size(), 2U);
  const page::Scene& scene = page.scenes[1];
  EXPECT_NO_THROW(page::validate(scene));
  EXPECT_EQ(scene.name, "fast");
  EXPECT_EQ(scene.time_s.size(), 51);
  EXPECT_EQ(scene.measured_markers.size(), 1U);
  ASSERT_EQ(scene.values.size(), 1U);
  // Both heads have the muscle's electrode, linearly from 0.2 to 0.6; the others have none.
  const body::BodyModel arm = *two_trials().source.model;
  EXPECT_NEAR(scene.values[0].value(25, arm.muscle_index("BIC")), 0.4, 1e-12);
  EXPECT_NEAR(scene.values[0].value(25, arm.muscle_index("BRA")), 0.4, 1e-12);
  EXPECT_TRUE(std::isnan(scene.values[0].value(25, arm.muscle_index("TRI"))));
}

TEST(StudyScenes, ShowAMeasuredForceWhereItActsWhileItActs) {
  run::StudyResult result = two_trials();
  body::ExternalForce force{.name = "plate 1", .body = 1};
  force.force = body::LoadColumns{.splines = {}, .constant = Vec3(0.0, 500.0, 10.0)};
  force.point = body::LoadColumns{.splines = {}, .constant = Vec3(0.1, 0.0, 0.2)};
  result.trials[0].input.loads = body::ExternalLoads{.forces = {force}, .start_s = 0.5, .end_s = 1.0};
  const page::Scene scene = study_scenes(result).scenes[0];
  EXPECT_NO_THROW(page::validate(scene));
  ASSERT_EQ(scene.loads.size(), 1U);
  EXPECT_TRUE(std::isnan(scene.loads[0].point_m(0, 0)));  // before the file begins
  EXPECT_EQ(scene.loads[0].force_n.row(0).norm(), 0.0);
  EXPECT_NEAR((scene.loads[0].point_m.row(50) - Eigen::RowVector3d(0.1, 0.0, 0.2)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((scene.loads[0].force_n.row(50) - Eigen::RowVector3d(0.0, 500.0, 10.0)).norm(), 0.0, 1e-12);
}

TEST(StudyScenes, ShareTheFramesAmongManyTrials) {
  run::StudyResult many = two_trials();
  many.trials.resize(3);
  const page::ScenePage page = study_scenes(many, 60);
  for (const page::Scene& scene : page.scenes) EXPECT_LE(scene.time_s.size(), 100);
}

}  // namespace
}  // namespace myoid::results
