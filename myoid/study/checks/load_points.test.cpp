#include "myoid/study/checks/load_points.h"

#include <cmath>
#include <optional>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace myoid::study {
namespace {

/// A pelvis that moves forward at 1 m/s, with two feet 0.2 m to the sides and 0.9 m below that
/// swing half a meter either way.
body::BodyModel walker() {
  body::BodyModel model;
  model.bodies = {{.name = "ground"},
                  {.name = "pelvis", .mass_kg = 60.0},
                  {.name = "calcn_r", .mass_kg = 1.0},
                  {.name = "calcn_l", .mass_kg = 1.0}};
  const auto slider = [](const char* name, int parent, int child, int coordinate, const Vec3& at) {
    body::Joint joint{.name = name, .class_name = "CustomJoint", .parent = parent, .child = child};
    joint.X_PF.p = at;
    joint.coordinates = {coordinate};
    joint.rotation = {body::TransformAxis{Vec3::UnitX()}, body::TransformAxis{Vec3::UnitY()},
                      body::TransformAxis{Vec3::UnitZ()}};
    joint.translation = {body::TransformAxis{Vec3::UnitX(), coordinate, body::Linear{1.0, 0.0}},
                         body::TransformAxis{Vec3::UnitY()}, body::TransformAxis{Vec3::UnitZ()}};
    return joint;
  };
  model.joints = {slider("root", 0, 1, 0, Vec3(0.0, 0.9, 0.0)), slider("right", 1, 2, 1, Vec3(0.0, -0.9, 0.2)),
                  slider("left", 1, 3, 2, Vec3(0.0, -0.9, -0.2))};
  for (const char* name : {"forward", "step_r", "step_l"}) {
    model.coordinates.push_back(
        {.name = name, .joint = static_cast<int>(model.coordinates.size()), .motion = body::MotionType::translational});
  }
  for (const int foot : {2, 3}) {
    model.markers.push_back({foot == 2 ? "heel_r" : "heel_l", foot, Vec3(-0.05, 0.02, 0.0)});
    model.markers.push_back({foot == 2 ? "toe_r" : "toe_l", foot, Vec3(0.2, 0.02, 0.0)});
  }
  return body::finalize(std::move(model));
}

double forward(double t) { return t; }
double step(double t, int foot) { return (foot == 2 ? 0.5 : -0.5) * std::cos(3.14 * t); }
double place(double t, int foot) { return forward(t) + step(t, foot); }

body::LoadColumns columns(const Eigen::VectorXd& t, const Eigen::MatrixX3d& values) {
  body::LoadColumns result;
  for (Eigen::Index k = 0; k < 3; ++k) result.splines.push_back(math::Spline::interpolate(t, values.col(k), 3));
  return result;
}

/// Two seconds in which each foot is loaded for half a step; the center of pressure is 5 cm before its ankle.
struct Walk {
  body::BodyModel model = walker();
  struct {
    std::optional<body::ExternalLoads> loads;
    std::optional<MarkerSeries> markers;
    std::optional<TimeSeries> motion;
  } input;

  Walk() {
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
    input.motion = TimeSeries(t, {{"forward", Unit::meter}, {"step_r", Unit::meter}, {"step_l", Unit::meter}}, q);
  }
  void with_markers() {
    MarkerSeries markers;
    markers.time_s = input.motion->time_s();
    markers.positions_m.resize(200, 12);
    for (std::size_t m = 0; m < model.markers.size(); ++m) {
      const body::Marker& marker = model.markers[m];
      markers.names.push_back(marker.name);
      for (Eigen::Index i = 0; i < 200; ++i) {
        markers.positions_m.row(i).segment(3 * static_cast<Eigen::Index>(m), 3) =
            (marker.p_BM + Vec3(place(markers.time_s[i], marker.body), 0.0, marker.body == 2 ? 0.2 : -0.2)).transpose();
      }
    }
    input.markers = markers;
    input.motion.reset();
  }
  [[nodiscard]] std::vector<Remark> findings() const {
    const MarkerSeries* markers = input.markers ? &*input.markers : nullptr;
    const TimeSeries* motion = input.motion ? &*input.motion : nullptr;
    return misplaced_loads(model, contact_table(model, *input.loads, {model, markers, motion}), "grf.xml");
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
    const std::vector<Remark> found = walk.findings();
    ASSERT_EQ(found.size(), 1U) << markers;
    EXPECT_EQ(found[0].severity, Severity::error);
    EXPECT_NE(found[0].says.find("'right' is applied to calcn_l and 'left' to calcn_r"), std::string::npos)
        << found[0].says;
  }
}

TEST(MisplacedLoads, OneForceOnTheWrongFootIsAWarning) {
  Walk walk;
  walk.input.loads->forces.pop_back();
  walk.input.loads->forces[0].body = 3;
  const std::vector<Remark> found = walk.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_NE(found[0].says.find("from calcn_r; is applied_to_body right?"), std::string::npos) << found[0].says;
}

TEST(MisplacedLoads, APointInMillimetersIsAnError) {
  Walk walk;
  for (math::Spline& s : walk.input.loads->forces[0].point->splines)
    s = math::Spline::interpolate(walk.input.motion->time_s(), Eigen::VectorXd::Constant(200, 300.0), 3);
  const std::vector<Remark> found = walk.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::error);
  EXPECT_NE(found[0].says.find("in mm"), std::string::npos) << found[0].says;
}

/// Moves the points of a force, always or only while the force is below a newton.
void move_points(Walk& walk, std::size_t load, const Vec3& by, bool unloaded_only) {
  body::ExternalForce& force = walk.input.loads->forces[load];
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(200, 0.0, 2.0);
  Eigen::MatrixX3d point(200, 3);
  for (Eigen::Index i = 0; i < 200; ++i) {
    const bool moves = !unloaded_only || force.force->at(t[i]).norm() < 1.0;
    point.row(i) = (force.point->at(t[i]) + (moves ? by : Vec3::Zero())).transpose();
  }
  force.point = columns(t, point);
}

TEST(MisplacedLoads, WhereNothingIsLoadedThePointMeansNothing) {
  Walk walk;
  for (const std::size_t load : {0U, 1U}) move_points(walk, load, Vec3(-30.0, 0.0, 4.0), true);
  EXPECT_TRUE(walk.findings().empty());
  // A plate on which nobody stepped says nothing either.
  Eigen::MatrixX3d none = Eigen::MatrixX3d::Zero(200, 3);
  walk.input.loads->forces[1].force = columns(walk.input.motion->time_s(), none);
  move_points(walk, 1, Vec3(-30.0, 0.0, 4.0), false);
  EXPECT_TRUE(walk.findings().empty());
}

TEST(MisplacedLoads, APointInTheFrameOfItsBodyIsNoneInGround) {
  Walk walk;
  for (body::ExternalForce& force : walk.input.loads->forces) force.point_frame = force.body;
  std::swap(walk.input.loads->forces[0].body, walk.input.loads->forces[1].body);
  EXPECT_TRUE(walk.findings().empty());
}

TEST(MisplacedLoads, APointFarFromEveryBodyIsNoOtherBodys) {
  Walk walk;
  move_points(walk, 0, Vec3(0.0, 0.0, 0.35), false);
  EXPECT_TRUE(walk.findings().empty());
  move_points(walk, 0, Vec3(0.0, 0.0, 0.35), false);
  const std::vector<Remark> found = walk.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].severity, Severity::warning);
  EXPECT_NE(found[0].says.find("no other body"), std::string::npos) << found[0].says;
  // A hand leans on a stick.
  walk.input.loads->forces[0].body = 1;
  EXPECT_TRUE(walk.findings().empty());
}

TEST(MisplacedLoads, ATurnAboutTheVerticalIsSaidOnce) {
  for (const int turns : {1, 2, 3}) {
    Walk walk;
    walk.with_markers();
    Eigen::MatrixXd& positions = walk.input.markers->positions_m;
    const Mat3 turn = Eigen::AngleAxisd(turns * 0.5 * 3.14159265358979, Vec3::UnitY()).toRotationMatrix();
    for (Eigen::Index m = 0; m < positions.cols(); m += 3)
      positions.middleCols(m, 3) = (positions.middleCols(m, 3) * turn.transpose()).eval();
    const std::vector<Remark> found = walk.findings();
    ASSERT_EQ(found.size(), 1U) << turns;
    EXPECT_EQ(found[0].severity, Severity::error);
    EXPECT_NE(found[0].says.find("by " + std::to_string(90 * turns) + " degrees"), std::string::npos) << found[0].says;
  }
}

TEST(MisplacedLoads, AreLookedForAtTheLoadsOwnTime) {
  // The loads' clock is 0.9 s behind: each foot is then elsewhere.
  Walk walk;
  std::swap(walk.input.loads->forces[0].body, walk.input.loads->forces[1].body);
  for (body::ExternalForce& force : walk.input.loads->forces) {
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(200, 0.0, 2.0);
    Eigen::MatrixX3d f(200, 3), p(200, 3);
    for (Eigen::Index i = 0; i < 200; ++i) {
      f.row(i) = force.force->at(t[i]).transpose();
      p.row(i) = force.point->at(t[i]).transpose();
    }
    const Eigen::VectorXd later = t.array() + 100.0;
    force.force = columns(later, f);
    force.point = columns(later, p);
  }
  walk.input.loads->set_clock(-100.0, 0.0);
  EXPECT_EQ(walk.findings().size(), 1U);
}

TEST(MisplacedLoads, ABodyHasThePointsOfItsNeighbors) {
  // The toes are a body of their own, and one marker of the foot is 0.4 m up. The force acts on the
  // body of that marker; the marker near the force belongs to the other body.
  for (const bool on_toes : {false, true}) {
    Walk walk;
    body::Marker& heel = walk.model.markers[0];
    body::Marker& toe = walk.model.markers[1];
    (on_toes ? toe : heel).p_BM += Vec3(0.0, 0.4, 0.0);
    walk.with_markers();
    walk.model.bodies.push_back({.name = "toes_r", .mass_kg = 0.2});
    body::Joint joint{.name = "mtp", .class_name = "WeldJoint", .parent = 2, .child = 4};
    joint.X_PF.p = Vec3(0.15, 0.0, 0.0);
    walk.model.joints.push_back(joint);
    toe.body = 4;
    walk.model = body::finalize(std::move(walk.model));
    if (on_toes) walk.input.loads->forces[0].body = 4;
    EXPECT_TRUE(walk.findings().empty()) << on_toes;
  }
}

TEST(MisplacedLoads, OfABodyWithoutAnyMarkerNothingIsSaid) {
  Walk walk;
  walk.with_markers();
  auto& markers = *walk.input.markers;
  markers.names = {markers.names[2], markers.names[3]};  // of the left foot
  markers.positions_m = markers.positions_m.rightCols(6).eval();
  EXPECT_TRUE(walk.findings().empty());
}

}  // namespace
}  // namespace myoid::study
