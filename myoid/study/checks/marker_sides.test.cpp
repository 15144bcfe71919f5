#include "myoid/study/checks/marker_sides.h"

#include <limits>
#include <map>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/recording/laboratory_up.h"
#include "myoid/study/trial_up.h"

#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

TEST(OtherSide, IsToldByALetterOrWordThatStandsApart) {
  EXPECT_EQ(other_side("R.Knee"), "L.Knee");
  EXPECT_EQ(other_side("LASI"), "RASI");
  EXPECT_EQ(other_side("knee_r"), "knee_l");
  EXPECT_EQ(other_side("r_acromion"), "l_acromion");
  EXPECT_EQ(other_side("LeftHeel"), "RightHeel");
  EXPECT_EQ(other_side("ANKLE_L"), "ANKLE_R");
  EXPECT_EQ(other_side("rightknee"), "leftknee");
  EXPECT_EQ(other_side("Radius"), std::nullopt);
  EXPECT_EQ(other_side("lateral"), std::nullopt);
  EXPECT_EQ(other_side("Sternum"), std::nullopt);
}

/// A free trunk with a head that looks forward (x), and on each side of it four markers.
body::BodyModel trunk(double width = 1.0) {
  body::BodyModel model;
  model.bodies = {{.name = "ground"}, {.name = "trunk", .mass_kg = 40.0}};
  body::Joint root{.name = "root", .class_name = "CustomJoint", .parent = 0, .child = 1};
  const Vec3 axes[3] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (int k = 0; k < 3; ++k) {
    root.coordinates.push_back(k);
    root.coordinates.push_back(3 + k);
    root.rotation[static_cast<std::size_t>(k)] = {axes[k], k, body::Linear{1.0, 0.0}};
    root.translation[static_cast<std::size_t>(k)] = {axes[k], 3 + k, body::Linear{1.0, 0.0}};
  }
  model.joints = {root};
  for (int k = 0; k < 6; ++k) {
    model.coordinates.push_back({.name = "q" + std::to_string(k), .joint = 0});
    if (k > 2) model.coordinates.back().motion = body::MotionType::translational;
  }
  model.markers = {{"nose", 1, Vec3(0.15, 0.6, 0.0)}, {"chin", 1, Vec3(0.12, 0.5, 0.0)}};
  for (const double side : {width, -width}) {
    const std::string letter = side > 0.0 ? "R." : "L.";
    model.markers.push_back({letter + "Shoulder", 1, Vec3(0.0, 0.4, 0.2 * side)});
    model.markers.push_back({letter + "ASIS", 1, Vec3(0.1, 0.0, 0.15 * side)});
    model.markers.push_back({letter + "PSIS", 1, Vec3(-0.12, 0.02, 0.06 * side)});
    model.markers.push_back({letter + "Ear", 1, Vec3(0.0, 0.58, 0.08 * side)});
  }
  return body::finalize(std::move(model));
}

MarkerSeries measured(const body::BodyModel& model) {
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::LinSpaced(3, 0.0, 0.02);
  markers.positions_m.resize(3, static_cast<Eigen::Index>(3 * model.markers.size()));
  const Mat3 R = Eigen::AngleAxisd(0.4, Vec3::UnitY()).toRotationMatrix();
  for (std::size_t m = 0; m < model.markers.size(); ++m) {
    markers.names.push_back(model.markers[m].name);
    markers.positions_m.middleCols(3 * static_cast<Eigen::Index>(m), 3) =
        (R * model.markers[m].p_BM + Vec3(1.0, 0.9, 0.3)).transpose().replicate(3, 1);
  }
  return markers;
}

TEST(ExchangedSides, AreFoundAndRightOnesAreNot) {
  const body::BodyModel model = trunk();
  MarkerSeries markers = measured(model);
  TrialSpec trial;
  trial.name = "walk";
  trial.markers = "walk.trc";
  EXPECT_FALSE(exchanged_sides(model, trial, markers, {}));
  for (std::string& name : markers.names) name = other_side(name).value_or(name);
  const auto found = exchanged_sides(model, trial, markers, {});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->severity, Severity::error);
  EXPECT_NE(found->says.find("walk.trc"), std::string::npos) << found->says;
  // A model that fits neither way says nothing.
  markers.positions_m *= 1.5;
  EXPECT_FALSE(exchanged_sides(model, trial, markers, {}));
}

/// Returns the finding for markers of this model with left and right labels exchanged.
struct Exchanged {
  body::BodyModel model;
  MarkerSeries markers;
  std::map<std::string, double> weights;

  explicit Exchanged(double width = 1.0) : model(trunk(width)), markers(measured(model)) {
    for (std::string& name : markers.names) name = other_side(name).value_or(name);
  }
  [[nodiscard]] bool said() const {
    TrialSpec trial;
    trial.name = "walk";
    return exchanged_sides(model, trial, markers, weights).has_value();
  }
};

TEST(ExchangedSides, AreLookedForInTheFrameWithTheMostMarkers) {
  Exchanged e;
  e.markers.positions_m.row(0).tail(21).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(e.said());
}

TEST(ExchangedSides, OfTwoPairsNothingIsSaid) {
  Exchanged e;
  for (const int keep : {3, 2}) {  // pairs: nose, chin, then four of either side
    MarkerSeries few = e.markers;
    few.names.clear();
    few.positions_m.resize(3, 0);
    for (int m = 0; m < 10; ++m) {
      if (m >= 2 && (m - 2) % 4 >= keep) continue;
      few.names.push_back(e.markers.names[static_cast<std::size_t>(m)]);
      few.positions_m.conservativeResize(Eigen::NoChange, few.positions_m.cols() + 3);
      few.positions_m.rightCols(3) = e.markers.positions_m.middleCols(3 * m, 3);
    }
    Exchanged with = e;
    with.markers = few;
    EXPECT_EQ(with.said(), keep == 3) << keep << " pairs";
  }
}

TEST(ExchangedSides, WhereTheyAreNarrowTheMarkersFitEitherWay) {
  EXPECT_FALSE(Exchanged(0.12).said());
  EXPECT_TRUE(Exchanged(0.7).said());
}

TEST(ExchangedSides, AMarkerWithoutWeightDecidesNothing) {
  Exchanged e;
  e.markers.positions_m.leftCols(3).array() += 0.6;  // the nose
  EXPECT_FALSE(e.said());
  e.weights["nose"] = 0.0;
  EXPECT_TRUE(e.said());
}

/// The markers of the built-in arm with a bent elbow, in the model's ground.
MarkerSeries arm_markers() {
  const body::BodyModel& arm = test_trials::arm();
  Eigen::VectorXd q = arm.default_q();
  q[arm.coordinate_index("elbow_flexion")] = 1.2;
  body::BodyState state = body::make_state(arm);
  body::compute_poses(arm, q, state);
  MarkerSeries markers;
  markers.time_s = Eigen::VectorXd::Zero(1);
  markers.positions_m.resize(1, static_cast<Eigen::Index>(3 * arm.markers.size()));
  for (std::size_t m = 0; m < arm.markers.size(); ++m) {
    markers.names.push_back(arm.markers[m].name);
    markers.positions_m.middleCols(3 * static_cast<Eigen::Index>(m), 3) =
        (state.X_GB[static_cast<std::size_t>(arm.markers[m].body)] * arm.markers[m].p_BM).transpose();
  }
  return markers;
}

TEST(TurnedMarkers, OfAnArmAreToldByTheAxisThatIsUp) {
  const body::BodyModel& arm = test_trials::arm();
  TrialSpec trial;
  trial.markers = "slow.trc";
  EXPECT_FALSE(turned_markers(arm, trial, arm_markers(), Vec3::UnitY(), {}));
  for (const auto& [name, axis] : {std::pair{"z", Vec3::UnitZ()}, {"x", Vec3::UnitX()}}) {
    // Written with this axis up, and read as if y were up.
    const auto file = rotated(arm_markers(), rotation_onto(arm, axis).transpose());
    const auto found = turned_markers(arm, trial, file, Vec3::UnitY(), {});
    ASSERT_TRUE(found) << name;
    EXPECT_EQ(found->severity, Severity::error);
    EXPECT_EQ(found->remedy, fmt::format("[markers] up = \"{}\"", name)) << sentence(*found);
    EXPECT_NE(found->says.find("slow.trc"), std::string::npos) << found->says;
  }
}

TEST(TurnedMarkers, OfTheOtherArmAreAMirrorImage) {
  MarkerSeries left = arm_markers();
  for (Eigen::Index c = 2; c < left.positions_m.cols(); c += 3) left.positions_m.col(c) *= -1.0;
  const auto found = turned_markers(test_trials::arm(), {}, left, Vec3::UnitY(), {});
  ASSERT_TRUE(found);
  EXPECT_NE(sentence(*found).find("mirror image; if they are of the other side of the body, use that side's model"),
            std::string::npos)
      << sentence(*found);
}

TEST(TurnedMarkers, OfOneSegmentTellNoWay) {
  // The landmarks of an elbow and a wrist, and of a left arm: three on the upper arm, two on the forearm.
  const MarkerSeries all = arm_markers();
  MarkerSeries few;
  few.time_s = all.time_s;
  few.positions_m.resize(1, 0);
  for (std::size_t m = 0; m < all.names.size(); ++m) {
    const std::string& name = all.names[m];
    if (name != "r_elbow" && !name.starts_with("r_epicondyle") && !name.starts_with("r_styloid")) continue;
    few.names.push_back(name);
    few.positions_m.conservativeResize(Eigen::NoChange, few.positions_m.cols() + 3);
    few.positions_m.rightCols(3) = all.positions_m.middleCols(3 * static_cast<Eigen::Index>(m), 3);
  }
  ASSERT_EQ(few.names.size(), 5U);
  for (Eigen::Index c = 2; c < few.positions_m.cols(); c += 3) few.positions_m.col(c) *= -1.0;
  EXPECT_FALSE(turned_markers(test_trials::arm(), {}, few, Vec3::UnitY(), {}));
}

TEST(TurnedMarkers, ThatFitNoWayAreNotGuessedAt) {
  MarkerSeries far = arm_markers();
  far.positions_m *= 3.0;
  EXPECT_FALSE(turned_markers(test_trials::arm(), {}, far, Vec3::UnitY(), {}));
}

}  // namespace
}  // namespace myoid::study
