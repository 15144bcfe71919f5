#include "myoid/study/checks/unloaded_times.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace myoid::study {
namespace {

constexpr double kWeight_n = 60.0 * 9.80665;

/// A trunk of 60 kg that may rise and sink above the ground; `up` is an axis of the model's.
body::BodyModel trunk(const Vec3& up) {
  body::BodyModel model;
  model.gravity_G = -9.80665 * up;
  model.bodies = {{.name = "ground"}, {.name = "trunk", .mass_kg = 60.0}};
  body::Joint root{.name = "root", .class_name = "CustomJoint", .parent = 0, .child = 1};
  root.coordinates = {0};
  root.rotation = {body::TransformAxis{Vec3::UnitX()}, body::TransformAxis{Vec3::UnitY()},
                   body::TransformAxis{Vec3::UnitZ()}};
  root.translation = {body::TransformAxis{Vec3::UnitX()}, body::TransformAxis{up, 0, body::Linear{1.0, 0.0}},
                      body::TransformAxis{up.unitOrthogonal()}};
  model.joints = {root};
  model.coordinates.push_back({.name = "height", .joint = 0, .motion = body::MotionType::translational});
  model.markers.push_back({"sternum", 1, Vec3(0.0, 0.3, 0.1)});
  return body::finalize(std::move(model));
}

/// Two seconds over a plate that bears `before` of the weight, and `in_gap` of it from 0.8 s on for
/// `gap_s`, in which the body falls freely or not.
struct WalkWithGap {
  double before = 1.0;
  double in_gap = 0.0;
  double gap_s = 0.4;
  bool falls = false;
  bool markers = false;
  double fades_s = 0.0;  ///< So long the load fades to nothing before the gap.
  int up = 1;            ///< The model's axis against gravity.
  double clock_s = 0.0;  ///< The loads' time at the motion's 0 s.

  [[nodiscard]] std::vector<Remark> findings() const {
    const Eigen::Index n = 401;
    const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(n, 0.0, 2.0);
    Eigen::VectorXd share(n), height(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const double into = t[i] - 0.8;
      const bool gap = into > 0.0 && into < gap_s - 1e-3;
      share[i] = gap ? in_gap : before;
      if (into <= 0.0 && into > -fades_s) share[i] = before * -into / fades_s;
      height[i] = gap && falls ? 0.5 * 9.80665 * into * (gap_s - into) : 0.0;
    }
    const auto upward = [&](const Eigen::VectorXd& values) {
      body::LoadColumns columns;
      for (int axis = 0; axis < 3; ++axis)
        columns.splines.push_back(math::Spline::interpolate(t.array() + clock_s, (axis == up ? 1.0 : 0.0) * values, 1));
      return columns;
    };
    TrialInput input;
    input.loads.emplace();
    input.loads->forces.push_back(
        {.name = "plate", .body = 1, .force = upward(kWeight_n * share), .point = upward(0.0 * share), .torque = {}});
    // A force of the person on the ground carries no weight.
    input.loads->forces.push_back({.name = "ground",
                                   .body = 0,
                                   .force = upward(Eigen::VectorXd::Constant(n, kWeight_n)),
                                   .point = upward(0.0 * share),
                                   .torque = {}});
    input.loads->set_clock(-clock_s, 0.0);
    if (markers) {
      input.markers.emplace();
      input.markers->time_s = t;
      input.markers->names = {"sternum", "lost"};
      input.markers->positions_m = Eigen::MatrixXd::Zero(n, 6);
      input.markers->positions_m.col(up) = height.array() + 1.3;
      input.markers->positions_m(170, 4) = std::numeric_limits<double>::quiet_NaN();
    } else {
      input.motion = TimeSeries(t, {{"height", Unit::meter}}, height);
    }
    TrialSpec trial;
    trial.name = "walk";
    return unloaded_times(trunk(Vec3::Unit(up)), trial, input);
  }
};

TEST(UnloadedTimes, AreThoseInWhichNobodyFliesAndNoPlateBears) {
  for (const bool markers : {false, true}) {
    SCOPED_TRACE(markers);
    const std::vector<Remark> found = WalkWithGap{.markers = markers}.findings();
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].severity, Severity::warning);
    // 79 samples strictly inside 0.8 to 1.2 s, from the first to the last: 0.39 of 2 s.
    EXPECT_THAT(found[0].says, testing::HasSubstr("(0.805 to 1.195 s)"));
    EXPECT_TRUE((WalkWithGap{.falls = true, .markers = markers}.findings().empty()));
  }
}

TEST(UnloadedTimes, ReachToWhereThreeQuartersOfTheWeightAreCarriedAsInRun) {
  // The load falls from the weight at 0.41 s to nothing at 0.8 s: a quarter of it is missing from 0.5075 s on.
  const std::vector<Remark> found = WalkWithGap{.fades_s = 0.39}.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].says, testing::HasSubstr("(0.51 to 1.195 s)"));
}

TEST(UnloadedTimes, OfAModelWhoseThirdAxisPointsUpAreTheSame) {
  for (const bool markers : {false, true}) {
    EXPECT_EQ((WalkWithGap{.markers = markers, .up = 2}.findings().size()), 1U);
    EXPECT_TRUE((WalkWithGap{.falls = true, .markers = markers, .up = 2}.findings().empty()));
  }
}

TEST(UnloadedTimes, AreToldOnTheMotionsClock) {
  const std::vector<Remark> found = WalkWithGap{.clock_s = 60.0}.findings();
  ASSERT_EQ(found.size(), 1U);
  EXPECT_THAT(found[0].says, testing::HasSubstr("0.805 to 1.195 s"));
}

TEST(UnloadedTimes, ABriefGapAndALightStepAreNone) {
  EXPECT_TRUE(WalkWithGap{.gap_s = 0.09}.findings().empty());
  EXPECT_EQ(WalkWithGap{.gap_s = 0.12}.findings().size(), 1U);
  EXPECT_TRUE(WalkWithGap{.in_gap = 0.08}.findings().empty());
  EXPECT_EQ(WalkWithGap{.in_gap = 0.03}.findings().size(), 1U);
}

TEST(UnloadedTimes, APlateThatNeverBearsThePersonIsNotStoodUpon) {
  EXPECT_TRUE(WalkWithGap{.before = 0.4}.findings().empty());
  EXPECT_EQ(WalkWithGap{.before = 0.6}.findings().size(), 1U);
}

}  // namespace
}  // namespace myoid::study
