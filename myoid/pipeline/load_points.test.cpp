#include "myoid/pipeline/load_points.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::pipeline {
namespace {

using Level = Finding::Level;

/// A pelvis that moves forward at 1 m/s, with two feet 0.2 m to the sides and 0.9 m below that
/// swing half a meter either way.
model::BodyModel walker() {
  model::BodyModel model;
  model.bodies = {{.name = "ground"},
                  {.name = "pelvis", .mass_kg = 60.0},
                  {.name = "calcn_r", .mass_kg = 1.0},
                  {.name = "calcn_l", .mass_kg = 1.0}};
  const auto slider = [](const char* name, int parent, int child, int coordinate, const Vec3& at) {
    model::Joint joint{.name = name, .class_name = "CustomJoint", .parent = parent, .child = child};
    joint.X_PF.p = at;
    joint.coordinates = {coordinate};
    joint.rotation = {model::TransformAxis{Vec3::UnitX()}, model::TransformAxis{Vec3::UnitY()},
                      model::TransformAxis{Vec3::UnitZ()}};
    joint.translation = {model::TransformAxis{Vec3::UnitX(), coordinate, model::Linear{1.0, 0.0}},
                         model::TransformAxis{Vec3::UnitY()}, model::TransformAxis{Vec3::UnitZ()}};
    return joint;
  };
  model.joints = {slider("root", 0, 1, 0, Vec3(0.0, 0.9, 0.0)),
                  slider("right", 1, 2, 1, Vec3(0.0, -0.9, 0.2)),
                  slider("left", 1, 3, 2, Vec3(0.0, -0.9, -0.2))};
  for (const char* name : {"forward", "step_r", "step_l"}) {
    model.coordinates.push_back({.name = name,
                                 .joint = static_cast<int>(model.coordinates.size()),
                                 .motion = model::MotionType::translational});
  }
  for (const int foot : {2, 3}) {
    model.markers.push_back({foot == 2 ? "heel_r" : "heel_l", foot, Vec3(-0.05, 0.02, 0.0)});
    model.markers.push_back({foot == 2 ? "toe_r" : "toe_l", foot, Vec3(0.2, 0.02, 0.0)});
  }
  return model::finalize(std::move(model));
}

double forward(double t) { return t; }
double step(double t, int foot) { return (foot == 2 ? 0.5 : -0.5) * std::cos(3.14 * t); }
double place(double t, int foot) { return forward(t) + step(t, foot); }

dynamics::LoadColumns columns(const Eigen::VectorXd& t, const Eigen::MatrixX3d& values) {
  dynamics::LoadColumns result;
  for (Eigen::Index k = 0; k < 3; ++k)
    result.splines.push_back(math::Spline::interpolate(t, values.col(k), 3));
  return result;
}

/// Two seconds in which each foot is loaded for half a step; the center of pressure is 5 cm before
/// its ankle.
struct Walk {
  model::BodyModel model = walker();
  TrialSpec trial;
  TrialInput input;

  Walk() {
    trial.name = "walk";
    trial.external_loads = "grf.xml";
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(200, 0.0, 2.0);
    input.loads.emplace();
    for (const int foot : {2, 3}) {
      Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(200, 3), point = force;
      for (Eigen::Index i = 0; i < 200; ++i) {
        force(i, 1) = 600.0 * std::max(0.0, (foot == 2 ? 1.0 : -1.0) * std::sin(3.14 * t[i]));
        point.row(i) << place(t[i], foot) + 0.05, 0.0, foot == 2 ? 0.2 : -0.2;
      }
      input.loads->forces.push_back({.name = foot == 2 ? "right" : "left",
                                     .body = foot,
                                     .force = columns(t, force),
                                     .point = columns(t, point),
                                     .torque = {}});
    }
    Eigen::MatrixXd q(200, 3);
    for (Eigen::Index i = 0; i < 200; ++i) q.row(i) << forward(t[i]), step(t[i], 2), step(t[i], 3);
    input.motion = TimeSeries(
        t, {{"forward", Unit::meter}, {"step_r", Unit::meter}, {"step_l", Unit::meter}}, q);
  }
  void with_markers() {
    recording::MarkerSeries markers;
    markers.time_s = input.motion->time_s();
    markers.positions_m.resize(200, 12);
    for (std::size_t m = 0; m < model.markers.size(); ++m) {
      const model::Marker& marker = model.markers[m];
      markers.names.push_back(marker.name);
      for (Eigen::Index i = 0; i < 200; ++i) {
        markers.positions_m.row(i).segment(3 * static_cast<Eigen::Index>(m), 3) =
            (marker.p_BM +
             Vec3(place(markers.time_s[i], marker.body), 0.0, marker.body == 2 ? 0.2 : -0.2))
                .transpose();
      }
    }
    input.markers = markers;
    input.motion.reset();
  }
  [[nodiscard]] std::vector<Finding> findings() const {
    return misplaced_loads(model, trial, input);
  }
};

TEST(MisplacedLoads, AreNoneWhereEveryForceActsUnderItsFoot) {
  Walk walk;
  EXPECT_TRUE(walk.findings().empty());
  walk.with_markers();
  EXPECT_TRUE(walk.findings().empty());
}

TEST(MisplacedLoads, ExchangedFeetAreAnErrorThatNamesBoth) {
  for (const bool markers : {false, true}) {
    Walk walk;
    if (markers) walk.with_markers();
    std::swap(walk.input.loads->forces[0].body, walk.input.loads->forces[1].body);
    const std::vector<Finding> found = walk.findings();
    ASSERT_EQ(found.size(), 1U) << markers;
    EXPECT_EQ(found[0].level, Level::error);
    EXPECT_NE(found[0].message.find("'right' is applied to calcn_l and 'left' to calcn_r"),
              std::string::npos)
        << found[0].message;
  }
}

TEST(MisplacedLoads, OneForceOnTheWrongFootIsAWarning) {
  Walk walk;
  walk.input.loads->forces.pop_back();
  walk.input.loads->forces[0].body = 3;
  const std::vector<Finding> found = walk.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].level, Level::warning);
  EXPECT_NE(found[0].message.find("from calcn_r; is applied_to_body right?"), std::string::npos)
      << found[0].message;
}

TEST(MisplacedLoads, APointInMillimetersIsAnError) {
  Walk walk;
  for (math::Spline& s : walk.input.loads->forces[0].point->splines)
    s = math::Spline::interpolate(walk.input.motion->time_s(),
                                  Eigen::VectorXd::Constant(200, 300.0), 3);
  const std::vector<Finding> found = walk.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].level, Level::error);
  EXPECT_NE(found[0].message.find("is it in mm"), std::string::npos) << found[0].message;
}

}  // namespace
}  // namespace myoid::pipeline
