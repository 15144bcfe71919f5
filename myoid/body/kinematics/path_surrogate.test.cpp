#include "myoid/body/kinematics/path_surrogate.h"

#include <cmath>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/arm/planar_elbow.h"
#include "myoid/body/kinematics/muscle_kinematics.h"
#include "myoid/body/model/constraints.h"
#include "myoid/body/model/path_survey.h"
#include "myoid/body/osim/osim_reader.h"

#include "tests/support/data_folder.h"

namespace myoid::body {
namespace {

TEST(Exponents, AreAllOfASumUpToTheDegreeLowSumsFirst) {
  const Eigen::MatrixXi e = exponents(3, 4);
  EXPECT_EQ(e.rows(), 35);  // (3 + 4) choose 4
  EXPECT_EQ(e.row(0).sum(), 0);
  for (Eigen::Index k = 1; k < e.rows(); ++k) {
    EXPECT_GE(e.row(k).sum(), e.row(k - 1).sum());
    EXPECT_LE(e.row(k).sum(), 4);
    for (Eigen::Index j = 0; j < k; ++j) EXPECT_NE(e.row(k), e.row(j));
  }
}

TEST(ActingCoordinates, AreThoseBetweenTheBodiesOfThePath) {
  MYOID_REQUIRE_DATA(test::data_folder() / "opensim/arm26");
  const body::BodyModel m = body::read_osim(test::data_folder() / "opensim/arm26/model.osim");
  const int shoulder = m.coordinate_index("r_shoulder_elev");
  const int elbow = m.coordinate_index("r_elbow_flex");
  const auto acting = [&](const char* name) {
    return acting_coordinates(m, m.muscles[static_cast<std::size_t>(m.muscle_index(name))].path);
  };
  EXPECT_EQ(acting("BRA"), std::vector<int>{elbow});
  EXPECT_EQ(acting("BIClong"), (std::vector<int>{shoulder, elbow}));
}

TEST(PathSurrogate, OfTheBuiltInArmIsTheClosedFormWithinTheErrorsItReports) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim({}), "arm4.osim");
  const body::PlanarElbow elbow = body::planar_elbow({});
  const int c = m.coordinate_index("elbow_flexion");
  const std::vector<PathSurrogate> all =
      fit_surrogates(m, {.length_tolerance_m = 1e-5, .arm_tolerance_m = 1e-4, .max_degree = 20});
  ASSERT_EQ(all.size(), 4U);
  SurrogateWorkspace w;
  body::PathResult result;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const PathSurrogate& s = all[i];
    EXPECT_EQ(s.coordinates, std::vector<int>{c});
    EXPECT_TRUE(s.within_tolerance) << s.muscle << " " << s.length_error_m << " " << s.arm_error_m;
    EXPECT_LE(s.length_rms_m, s.length_error_m);
    const body::Coordinate& range = m.coordinates[static_cast<std::size_t>(c)];
    Eigen::VectorXd q = m.default_q();
    Eigen::VectorXd qdot = Eigen::VectorXd::Zero(q.size());
    qdot[c] = 1.5;
    for (int k = 0; k <= 100; ++k) {
      q[c] = range.lower + 0.01 * k * (range.upper - range.lower);
      const body::MuscleTravel truth = body::travel(elbow.muscles[i], q[c]);
      evaluate(s, q, qdot, w, result);
      EXPECT_TRUE(covers(m, s, q));
      // Unseen points are many on a line: no error in between is much greater.
      EXPECT_NEAR(result.length_m, truth.length_m, 1.1 * s.length_error_m + 1e-12);
      EXPECT_NEAR(result.moment_arm_m[c], truth.moment_arm_m, 1.1 * s.arm_error_m + 1e-12);
      EXPECT_EQ(result.speed_mps, -1.5 * result.moment_arm_m[c]);
    }
    q[c] = range.upper + 0.01;
    EXPECT_FALSE(covers(m, s, q));
  }
}

TEST(PathSurrogate, MomentArmsAreItsExactDerivatives) {
  MYOID_REQUIRE_DATA(test::data_folder() / "opensim/gait2354");
  body::BodyModel m = body::read_osim(test::data_folder() / "opensim/gait2354/model.osim");
  std::erase_if(m.muscles, [](const body::Muscle& muscle) { return muscle.name != "rect_fem_r"; });
  ASSERT_EQ(m.muscles.size(), 1U);
  const std::vector<PathSurrogate> all = fit_surrogates(m, {.max_degree = 4});
  const PathSurrogate& s = all[0];
  EXPECT_EQ(s.coordinates.size(), 4U);  // three of the hip, the knee
  SurrogateWorkspace w;
  body::PathResult here, ahead, behind;
  const double h = 1e-5;
  for (std::uint64_t k = 0; k < 5; ++k) {
    const Eigen::VectorXd q = body::random_posture(m, 3, k);
    const Eigen::VectorXd still = Eigen::VectorXd::Zero(q.size());
    evaluate(s, q, still, w, here);
    for (const int c : s.coordinates) {
      const Eigen::VectorXd step = h * Eigen::VectorXd::Unit(q.size(), c);
      evaluate(s, q + step, still, w, ahead);
      evaluate(s, q - step, still, w, behind);
      EXPECT_NEAR(here.moment_arm_m[c], -(ahead.length_m - behind.length_m) / (2.0 * h), 1e-9);
    }
  }
}

TEST(PathSurrogate, StandsForThePathInACoupledModel) {
  // The patella follows the knee: the polynomial knows the knee alone, arms count both.
  MYOID_REQUIRE_DATA(test::data_folder() / "opensim/rajagopal2016");
  body::BodyModel m = body::read_osim(test::data_folder() / "opensim/rajagopal2016/model.osim");
  std::erase_if(m.muscles, [](const body::Muscle& muscle) { return muscle.name != "vasint_r"; });
  ASSERT_EQ(m.muscles.size(), 1U);
  const SurrogateOptions options{.length_tolerance_m = 1e-3, .arm_tolerance_m = 3e-3, .max_degree = 12};
  const std::vector<PathSurrogate> all = fit_surrogates(m, options);
  EXPECT_TRUE(all[0].within_tolerance) << all[0].length_error_m << " " << all[0].arm_error_m;
  EXPECT_EQ(all[0].coordinates, std::vector<int>{m.coordinate_index("knee_angle_r")});
  // A motion of the knee, with and without.
  const Eigen::VectorXd t = Eigen::VectorXd::LinSpaced(101, 0.0, 1.0);
  const Eigen::VectorXd knee = 0.8 + 0.6 * (6.0 * t.array()).sin();
  Eigen::MatrixXd q(101, static_cast<Eigen::Index>(m.coordinates.size()));
  std::vector<Channel> channels;
  for (const body::Coordinate& c : m.coordinates) channels.push_back({c.name, Unit::radian});
  for (Eigen::Index row = 0; row < 101; ++row) {
    Eigen::VectorXd posture = m.default_q();
    posture[m.coordinate_index("knee_angle_r")] = knee[row];
    body::apply_couplers(m, posture);
    q.row(row) = posture.transpose();
  }
  const JointMotion motion = joint_motion(m, {t, channels, q}).motion;
  const MuscleKinematics path = muscle_kinematics(m, motion);
  const MuscleKinematics fitted = muscle_kinematics(m, motion, {.surrogates = &all});
  EXPECT_EQ(path.from_surrogates, 0);
  EXPECT_EQ(fitted.from_surrogates, 101);
  EXPECT_LT((fitted.length.values() - path.length.values()).cwiseAbs().maxCoeff(), 1.1 * all[0].length_error_m);
  for (const char* name : {"knee_angle_r", "knee_angle_r_beta"}) {
    // By the patella's own coordinate the knee follows: about the inverse of their ratio.
    const double ratio = std::string(name) == "knee_angle_r" ? 1.0 : 3.0;
    EXPECT_LT((fitted.moment_arm.at(name).values() - path.moment_arm.at(name).values()).cwiseAbs().maxCoeff(),
              ratio * options.arm_tolerance_m)
        << name;
  }
}

TEST(PathSurrogate, SaysWhereAPathCannotBeMet) {
  // A via point that switches on: the length jumps by centimeters.
  body::BodyModel m = body::parse_osim(body::arm4_osim({}), "arm4.osim");
  body::PathPoint via = m.muscles[0].path.points.front();
  via.moving.reset();
  via.p_BP += Vec3(0.08, -0.05, 0.0);
  const int c = m.coordinate_index("elbow_flexion");
  via.condition = body::PathPoint::Condition{c, 1.0, 10.0};
  auto& points = m.muscles[0].path.points;
  points.insert(points.begin() + 1, via);
  const std::vector<PathSurrogate> all = fit_surrogates(m);
  EXPECT_FALSE(all[0].within_tolerance);
  EXPECT_GT(all[0].length_error_m, 1e-3);
  EXPECT_TRUE(all[1].within_tolerance);
}

TEST(PathSurrogate, IsTheSameForEveryNumberOfThreads) {
  const body::BodyModel m = body::parse_osim(body::arm4_osim({}), "arm4.osim");
  const std::vector<PathSurrogate> many = fit_surrogates(m);
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  const std::vector<PathSurrogate> single = fit_surrogates(m);
  for (std::size_t i = 0; i < many.size(); ++i) EXPECT_EQ(many[i].coefficient_m, single[i].coefficient_m);
}

}  // namespace
}  // namespace myoid::body
