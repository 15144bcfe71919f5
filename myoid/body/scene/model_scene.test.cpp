#include "myoid/body/scene/model_scene.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/model/muscle_path.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"

#include "tests/support/built_in_arm.h"
#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

/// All coordinates of a model swinging, `count` samples at `rate_hz`.
TimeSeries swing(const body::BodyModel& m, Eigen::Index count, double rate_hz) {
  std::vector<Channel> channels;
  for (const body::Coordinate& c : m.coordinates) channels.push_back({c.name, Unit::radian});
  Eigen::MatrixXd q(count, static_cast<Eigen::Index>(channels.size()));
  for (Eigen::Index i = 0; i < count; ++i)
    q.row(i) = m.default_q().transpose().array() + 0.4 * std::sin(3.0 * static_cast<double>(i) / rate_hz);
  return {Eigen::VectorXd::LinSpaced(count, 0.0, static_cast<double>(count - 1) / rate_hz), channels, q};
}

double length_of(const std::vector<Vec3>& line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += (line[i] - line[i - 1]).norm();
  return length;
}

/// The line that the viewer draws of a muscle.
std::vector<Vec3> drawn(const page::Scene& scene, int muscle, std::size_t frame) {
  for (std::size_t k = 0; k < scene.moving_muscles.size(); ++k)
    if (scene.moving_muscles[k] == muscle) return scene.lines_m[frame][k];
  std::vector<Vec3> line;
  for (const page::ScenePoint& p : scene.muscles[static_cast<std::size_t>(muscle)].points)
    line.push_back(scene.poses[frame][static_cast<std::size_t>(p.body)] * p.position_m);
  return line;
}

/// Every muscle's line against the length that the other stages compute.
void expect_lengths(const body::BodyModel& m, const page::Scene& scene, const TimeSeries& q) {
  body::BodyState state = body::make_state(m);
  for (std::size_t f = 0; f < scene.poses.size(); ++f) {
    Eigen::Index row = 0;
    while (q.time_s()[row] < scene.time_s[static_cast<Eigen::Index>(f)]) ++row;
    body::compute_poses(m, q.values().row(row).transpose(), state);
    for (std::size_t i = 0; i < m.muscles.size(); ++i) {
      const double length = body::compute_path(m, static_cast<int>(i), state).length_m;
      // Arcs in steps of 10 degrees are at most 0.13 % too short (path_polyline.test).
      EXPECT_NEAR(length_of(drawn(scene, static_cast<int>(i), f)), length, 2e-3 * length)
          << m.muscles[i].name << " in frame " << f;
    }
  }
}

TEST(ModelScene, WithoutAMotionIsTheDefaultPosture) {
  const body::BodyModel m = test::built_in_arm();
  const page::Scene scene = model_scene(m, {.name = "still"});
  EXPECT_NO_THROW(page::validate(scene));
  ASSERT_EQ(scene.poses.size(), 1U);
  EXPECT_EQ(scene.bodies.size(), m.bodies.size());
  EXPECT_EQ(scene.muscles.size(), 4U);
  EXPECT_EQ(scene.up, Vec3::UnitY());
  EXPECT_THAT(scene.notes, IsEmpty());
}

TEST(ModelScene, DrawsEveryMuscleAsLongAsItIs) {
  const body::BodyModel m = test::built_in_arm();
  const TimeSeries q = swing(m, 60, 100.0);
  const page::Scene scene = model_scene(m, {.name = "swing", .q = q});
  EXPECT_NO_THROW(page::validate(scene));
  expect_lengths(m, scene, q);
}

TEST(ModelScene, DrawsWrappedConditionalAndMovingPathsAsLongAsTheyAre) {
  const auto folder = test::data_folder() / "opensim";
  MYOID_REQUIRE_DATA(folder);
  for (const char* name : {"arm26", "pathzoo", "rajagopal2016"}) {
    const body::BodyModel m = body::read_osim(folder / name / "model.osim");
    const TimeSeries q = swing(m, 12, 20.0);
    const page::Scene scene = model_scene(m, {.name = name, .q = q});
    EXPECT_NO_THROW(page::validate(scene));
    EXPECT_FALSE(scene.moving_muscles.empty());
    expect_lengths(m, scene, q);
  }
}

TEST(ModelScene, LeavesFramesOutEvenlyAndSaysSo) {
  const body::BodyModel m = test::built_in_arm();
  const page::Scene at_50 = model_scene(m, {.name = "fast", .q = swing(m, 401, 200.0)});
  ASSERT_EQ(at_50.time_s.size(), 101);
  for (Eigen::Index f = 1; f < at_50.time_s.size(); ++f)
    EXPECT_NEAR(at_50.time_s[f] - at_50.time_s[f - 1], 0.02, 1e-12);
  EXPECT_THAT(sentences(at_50.notes), Contains(HasSubstr("101 of 401 samples are shown")));
  const page::Scene few = model_scene(m, {.name = "long", .q = swing(m, 401, 200.0)}, {.most_frames = 11});
  EXPECT_EQ(few.time_s.size(), 11);
  EXPECT_DOUBLE_EQ(few.time_s[10], 2.0);
  EXPECT_EQ(model_scene(m, {.name = "slow", .q = swing(m, 50, 25.0)}).time_s.size(), 50);
}

TEST(ModelScene, TakesColorsByNameAtTheFramesTimesAndNotBeyond) {
  const body::BodyModel m = test::built_in_arm();
  const TimeSeries q = swing(m, 5, 10.0);  // 0 .. 0.4 s
  Eigen::MatrixXd values(3, 3);
  values << 0.0, 1.0, 2.0, 10.0, 11.0, 12.0, 20.0, 21.0, 1234.0;
  const TimeSeries forces(Eigen::Vector3d(0.1, 0.2, 0.3),
                          {{"BIC", Unit::newton}, {"/forceset/TRI/force", Unit::newton}, {"other", Unit::newton}},
                          values);
  const page::Scene scene = model_scene(m, {.name = "c", .q = q, .colorings = {{"force", "N", forces}}});
  ASSERT_EQ(scene.values.size(), 1U);
  const Eigen::MatrixXd& v = scene.values[0].value;
  const auto column = [&](const char* name) { return m.muscle_index(name); };
  EXPECT_TRUE(std::isnan(v(0, column("BIC"))));
  EXPECT_NEAR(v(1, column("BIC")), 0.0, 1e-12);
  EXPECT_NEAR(v(2, column("TRI")), 11.0, 1e-12);
  EXPECT_TRUE(std::isnan(v(4, column("BIC"))));
  EXPECT_TRUE(std::isnan(v(2, column("BRA"))));
  EXPECT_EQ(scene.values[0].top, 21.0);  // of muscles, not of other columns
  EXPECT_THAT(sentences(scene.notes), Contains(HasSubstr("BRA")));
}

TEST(ModelScene, RefusesColorsOfAnotherModel) {
  const TimeSeries other(Eigen::Vector2d(0.0, 1.0), {{"soleus_r", Unit::newton}}, Eigen::Vector2d(1.0, 2.0));
  EXPECT_THROW((void)model_scene(test::built_in_arm(), {.name = "x", .colorings = {{"force", "N", other}}}),
               InvalidInput);
}

TEST(ModelScene, ShowsMeasuredMarkersWhereTheyWereSeen) {
  const body::BodyModel m = test::built_in_arm();
  MarkerSeries markers;
  markers.time_s = Eigen::Vector3d(0.0, 0.1, 0.2);
  markers.names = {m.markers[0].name, "unknown"};
  markers.positions_m.setConstant(3, 6, 0.5);
  markers.positions_m.block<1, 3>(1, 0).setConstant(std::nan(""));
  const page::Scene scene = model_scene(m, {.name = "m", .q = swing(m, 4, 10.0), .markers = &markers});
  EXPECT_NO_THROW(page::validate(scene));
  EXPECT_EQ(scene.measured_m(0, 0), 0.5);
  EXPECT_TRUE(std::isnan(scene.measured_m(1, 0)));
  EXPECT_EQ(scene.measured_m(1, 3), 0.5);
  EXPECT_TRUE(std::isnan(scene.measured_m(3, 3)));  // after the last frame
  EXPECT_THAT(sentences(scene.notes), Contains(HasSubstr("1 of 2 measured markers")));
}

TEST(ModelScene, StandsUpAgainstGravity) {
  body::BodyModel m = test::built_in_arm();
  m.gravity_G = {0.0, 0.0, -9.81};
  EXPECT_EQ(model_scene(m, {.name = "z"}).up, Vec3::UnitZ());
}

}  // namespace
}  // namespace myoid::body
