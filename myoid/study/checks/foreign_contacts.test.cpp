#include "myoid/study/checks/foreign_contacts.h"

#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/study/intake/body_points.h"

namespace myoid::study {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr body::BodyIndex kRight = 2, kLeft = 3;

/// A pelvis on a free path and two feet, each with a marker at the heel and one at the toe.
body::BodyModel two_feet() {
  body::BodyModel model;
  model.bodies = {{.name = "ground"},
                  {.name = "pelvis", .mass_kg = 60.0},
                  {.name = "calcn_r", .mass_kg = 1.0},
                  {.name = "calcn_l", .mass_kg = 1.0}};
  for (int child = 1; child < 4; ++child) {
    body::Joint joint{
        .name = "j" + std::to_string(child), .class_name = "WeldJoint", .parent = child == 1 ? 0 : 1, .child = child};
    joint.X_PF.p = child == 1 ? Vec3(0.0, 0.9, 0.0) : Vec3(0.0, -0.9, child == 2 ? 0.1 : -0.1);
    model.joints.push_back(joint);
  }
  for (const body::BodyIndex foot : {kRight, kLeft}) {
    model.markers.push_back({foot == kRight ? "heel_r" : "heel_l", foot, Vec3(-0.05, 0.02, 0.0)});
    model.markers.push_back({foot == kRight ? "toe_r" : "toe_l", foot, Vec3(0.2, 0.02, 0.0)});
  }
  return body::finalize(std::move(model));
}

/// A person who walks at 1 m/s along x with strides of 1.2 s: each foot stands for 0.7 s at a place
/// 1.2 m further on, and swings over between, 0.1 m high.
struct SteadyGait {
  static constexpr double kStride_s = 1.2, kStance_s = 0.7;
  static double since(double t, body::BodyIndex foot) { return std::fmod(t + (foot == kRight ? 0.0 : 0.6), kStride_s); }
  static bool stands(double t, body::BodyIndex foot) { return since(t, foot) < kStance_s; }
  static Vec3 place(double t, body::BodyIndex foot) {
    const double s = since(t, foot);
    const double begin = t - s;  // where it stands, the body's place in the middle of the stance
    const double swing = std::max(0.0, (s - kStance_s) / (kStride_s - kStance_s));
    const double smooth = swing * swing * (3.0 - 2.0 * swing);
    return {begin + 0.35 + kStride_s * smooth, 0.1 * std::sin(M_PI * swing), foot == kRight ? 0.1 : -0.1};
  }
  /// 0.05 m behind the ankle at the heel's strike, 0.18 m before it at the toe's lift.
  static Vec3 pressure(double t, body::BodyIndex foot) {
    return place(t, foot) + Vec3(-0.05 + 0.23 * since(t, foot) / kStance_s, 0.0, 0.0);
  }
  static Vec3 force(double t, body::BodyIndex foot) {
    return {20.0, stands(t, foot) ? 700.0 * std::sin(M_PI * since(t, foot) / kStance_s) : 0.0, 0.0};
  }
};

body::LoadColumns force_columns(const Eigen::VectorXd& t, const Eigen::MatrixX3d& values) {
  body::LoadColumns result;
  for (Eigen::Index k = 0; k < 3; ++k) result.splines.push_back(math::Spline::interpolate(t, values.col(k), 1));
  return result;
}

struct PlateTrial {
  body::BodyModel model = two_feet();
  MarkerSeries markers;
  body::ExternalLoads loads;
  Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(601, 0.0, 6.0);

  PlateTrial() {
    markers.time_s = time_s;
    markers.positions_m.resize(601, 12);
    for (std::size_t m = 0; m < model.markers.size(); ++m) {
      const body::Marker& marker = model.markers[m];
      markers.names.push_back(marker.name);
      for (Eigen::Index i = 0; i < 601; ++i)
        markers.positions_m.row(i).segment(3 * static_cast<Eigen::Index>(m), 3) =
            (SteadyGait::place(time_s[i], marker.body) + marker.p_BM).transpose();
    }
  }

  /// A force of the ground on the body of `foot` at each time (0: none), in the form of a plate's
  /// force: about a fixed point, or with its center of pressure.
  template <typename Foot>
  void load(const char* name, body::BodyIndex body, bool about_a_point, Foot foot_at) {
    const Vec3 middle(2.0, 0.0, 0.0);
    Eigen::MatrixX3d force = Eigen::MatrixX3d::Zero(601, 3), point = force, moment = force;
    for (Eigen::Index i = 0; i < 601; ++i) {
      const double t = time_s[i];
      const body::BodyIndex foot = foot_at(t);
      if (foot == 0) continue;
      const Vec3 f = SteadyGait::force(t, foot);
      Vec3 p = SteadyGait::pressure(t, foot);
      p.y() = 0.0;
      force.row(i) = f.transpose();
      point.row(i) = p.transpose();
      moment.row(i) = ((p - middle).cross(f) + Vec3(0.0, 3.0, 0.0)).transpose();
    }
    body::ExternalForce e{.name = name, .body = body};
    e.force = force_columns(time_s, force);
    e.point = about_a_point ? body::LoadColumns{.splines = {}, .constant = middle} : force_columns(time_s, point);
    if (about_a_point) e.torque = force_columns(time_s, moment);
    loads.forces.push_back(e);
  }
  [[nodiscard]] std::vector<Remark> findings(bool own_clock = false) const {
    return foreign_contacts(model, "walk", contact_table(model, loads, {model, &markers, nullptr}), own_clock).remarks;
  }
};

body::BodyIndex if_stands(double t, body::BodyIndex foot) { return SteadyGait::stands(t, foot) ? foot : 0; }

TEST(ForeignContacts, AreNoneWhereEachFootHasItsOwnForce) {
  for (const bool about_a_point : {false, true}) {
    PlateTrial trial;
    trial.load("right", kRight, about_a_point, [](double t) { return if_stands(t, kRight); });
    trial.load("left", kLeft, about_a_point, [](double t) { return if_stands(t, kLeft); });
    for (const Remark& f : trial.findings()) ADD_FAILURE() << about_a_point << f.says;
  }
}

TEST(ForeignContacts, OneContactOfSeveralIsSaidWithItsTimeShareAndDistances) {
  for (const bool about_a_point : {false, true}) {
    PlateTrial trial;
    // The right foot steps on the plate twice (0 to 0.7, 2.4 to 3.1 s), the left once (4.2 to 4.9).
    trial.load("plate_1", kRight, about_a_point, [](double t) {
      if (t > 4.0 && t < 5.0) return if_stands(t, kLeft);
      return t < 1.0 || (t > 2.0 && t < 3.5) ? if_stands(t, kRight) : 0;
    });
    const std::vector<Remark> found = trial.findings();
    ASSERT_EQ(found.size(), 1U) << about_a_point;
    EXPECT_EQ(found[0].severity, Severity::warning);
    EXPECT_EQ(found[0].where, "walk");
    const std::vector<Stretch> times =
        foreign_contacts(trial.model, "walk",
                         contact_table(trial.model, trial.loads, {trial.model, &trial.markers, nullptr}))
            .times;
    ASSERT_FALSE(times.empty());
    EXPECT_NEAR(times.front().begin_s, 4.2, 0.05);
    EXPECT_NEAR(times.back().end_s, 4.9, 0.05);
    EXPECT_THAT(found[0].says, AllOf(HasSubstr("'plate_1'"), HasSubstr("to calcn_r"), HasSubstr(" 1 of 3 "),
                                     HasSubstr("from 4.2"), HasSubstr("m from calcn_l")));
    const std::size_t at = found[0].says.find(" % of the loaded time");
    EXPECT_NEAR(std::stod(found[0].says.substr(at - 2)), 34.0, 3.0) << found[0].says;
  }
}

TEST(ForeignContacts, AFootOfSomebodyElseIsSaidToo) {
  PlateTrial trial;
  trial.load("plate_1", kRight, false, [](double t) { return t < 4.0 ? if_stands(t, kRight) : 0; });
  body::ExternalForce& force = trial.loads.forces[0];
  Eigen::MatrixX3d f(601, 3), p(601, 3);
  for (Eigen::Index i = 0; i < 601; ++i) {
    const double t = trial.time_s[i];
    const bool stranger = t > 5.2 && t < 5.8;
    f.row(i) = (stranger ? Vec3(0, 500, 0) : force.force->at(t)).transpose();
    p.row(i) = (stranger ? Vec3(2.0, 0.0, 0.0) : force.point->at(t)).transpose();
  }
  force.force = force_columns(trial.time_s, f);
  force.point = force_columns(trial.time_s, p);
  const std::vector<Remark> found = trial.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].says, AllOf(HasSubstr(" 1 of 5 "), HasSubstr("from 5.2"), Not(HasSubstr("calcn_l")),
                                   Not(HasSubstr("another foot")), Not(HasSubstr("loads_offset_s"))));
  EXPECT_THAT(trial.findings(true)[0].says, HasSubstr("[sync] loads_offset_s"));
}

TEST(ForeignContacts, ASecondFootOnThePlateIsSaid) {
  PlateTrial trial;
  // From 1.0 to 2.0 s both feet stand side by side, 0.3 m apart, and the plate bears both of them.
  const auto both = [](double t) { return t > 1.0 && t < 2.0; };
  for (Eigen::Index i = 0; i < 601; ++i) {
    if (!both(trial.time_s[i])) continue;
    for (std::size_t m = 0; m < trial.model.markers.size(); ++m) {
      const body::Marker& marker = trial.model.markers[m];
      trial.markers.positions_m.row(i).segment(3 * static_cast<Eigen::Index>(m), 3) =
          (Vec3(1.0, 0.0, marker.body == kRight ? 0.15 : -0.15) + marker.p_BM).transpose();
    }
  }
  Eigen::MatrixX3d f = Eigen::MatrixX3d::Zero(601, 3), p = f;
  for (Eigen::Index i = 0; i < 601; ++i) {
    const double t = trial.time_s[i];
    if (both(t)) {
      f.row(i) << 0, 700, 0;
      p.row(i) << 1.08, 0, 0;
    } else if (t > 2.4 && t < 3.1) {
      f.row(i) = SteadyGait::force(t, kRight).transpose();
      p.row(i) = SteadyGait::pressure(t, kRight).transpose();
    }
  }
  body::ExternalForce force{.name = "plate_1", .body = kRight};
  force.force = force_columns(trial.time_s, f);
  force.point = force_columns(trial.time_s, p);
  trial.loads.forces = {force};
  const std::vector<Remark> found = trial.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].says,
              AllOf(HasSubstr(" 1 of 2 "), HasSubstr("from 1.0"), HasSubstr("second foot"), HasSubstr("from calcn_l")));
}

// A load cell 1.1 m above the floor that a hand pushes up against, and a weight of 80 N that hangs from a foot: neither
// is a plate in the floor. The same force upward on the floor belongs to another foot.
TEST(ForeignContacts, AreLookedForOnPlatesInTheFloorAlone) {
  for (const bool hand : {true, false}) {
    PlateTrial trial;
    const auto put = [&](double push_n, double height_m) {
      Eigen::MatrixX3d f = Eigen::MatrixX3d::Zero(601, 3), p = f;
      for (Eigen::Index i = 0; i < 601; ++i) {
        f(i, 1) = push_n;
        p.row(i) = SteadyGait::place(trial.time_s[i], kLeft).transpose();
        p(i, 1) += height_m;
      }
      body::ExternalForce force{.name = "cell", .body = kRight};
      force.force = force_columns(trial.time_s, f);
      force.point = force_columns(trial.time_s, p);
      trial.loads.forces = {force};
      return trial.findings();
    };
    EXPECT_TRUE((hand ? put(200.0, 1.1) : put(-80.0, 0.0)).empty());
    EXPECT_EQ(put(200.0, 0.0).size(), 1U);
  }
}

TEST(BodyPoints, AreThoseOfTheMarkersOrOfTheModelInTheMotion) {
  const body::BodyModel model = two_feet();
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(2, 0.0, 1.0);
  markers.names = {"toe_r", "nobody"};
  markers.positions_m.resize(2, 6);
  markers.positions_m << 1, 2, 3, 4, 5, 6, 1, 2, 4, 4, 5, 6;
  BodyPoints points(model, &markers, nullptr);
  EXPECT_EQ(points.frame_count(), 2);
  points.pose(1);
  ASSERT_EQ(points.of(kRight).size(), 1U);
  EXPECT_EQ(points.of(kRight)[0], Vec3(1, 2, 4));
  EXPECT_NEAR(points.of_one(Vec3(1, 2, 1), kRight), 3.0, 1e-15);
  EXPECT_NEAR(points.distance(Vec3(1, 2, 1), 1), 3.0, 1e-15);  // of the pelvis' neighbor
  EXPECT_TRUE(points.of(kLeft).empty());

  const TimeSeries motion(markers.time_s, {{"none", Unit::radian}}, Eigen::MatrixXd::Zero(2, 1));
  BodyPoints of_model(model, nullptr, &motion);
  of_model.pose(0);
  // The weld stands 0.9 m up and the foot as much below, its toe 0.2 m before it.
  EXPECT_NEAR(of_model.of_one(Vec3(0.2, 0.02, 0.1), kRight), 0.0, 1e-12);
}

}  // namespace
}  // namespace myoid::study
