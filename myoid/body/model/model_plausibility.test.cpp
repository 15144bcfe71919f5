#include "myoid/body/model/model_plausibility.h"

#include <gtest/gtest.h>

namespace myoid::body {
namespace {

/// A trunk and an arm with one muscle of usual numbers.
BodyModel usual() {
  BodyModel model;
  model.bodies = {{.name = "ground"}, {.name = "trunk", .mass_kg = 60.0}, {.name = "arm", .mass_kg = 4.0}};
  Muscle muscle;
  muscle.name = "BIC";
  model.muscles = {muscle};
  return model;
}

std::vector<std::pair<RemarkCode, Severity>> found(const BodyModel& model) {
  std::vector<std::pair<RemarkCode, Severity>> list;
  for (const Remark& remark : implausible(model)) list.emplace_back(remark.code, remark.severity);
  return list;
}

using CodesFound = std::vector<std::pair<RemarkCode, Severity>>;

TEST(ImplausibleModel, UsualNumbersAreNone) { EXPECT_EQ(found(usual()), CodesFound{}); }

TEST(ImplausibleModel, MassesInGramsAreAnErrorAndNoMassesAWarning) {
  BodyModel model = usual();
  for (Body& body : model.bodies) body.mass_kg *= 1000.0;
  EXPECT_EQ(found(model), (CodesFound{{RemarkCode::mass_impossible, Severity::error}}));
  for (Body& body : model.bodies) body.mass_kg = 0.0;
  EXPECT_EQ(found(model), (CodesFound{{RemarkCode::mass_impossible, Severity::warning}}));
}

TEST(ImplausibleModel, GravityIsThatOfAPlanetOrNone) {
  BodyModel model = usual();
  for (const double g : {0.0, 1.62, 9.80665, 24.8}) {
    model.gravity_G = Vec3(0.0, 0.0, -g);
    EXPECT_EQ(found(model), CodesFound{}) << g;
  }
  for (const double g : {9806.65, 6e13}) {
    model.gravity_G = Vec3(0.0, -g, 0.0);
    EXPECT_EQ(found(model), (CodesFound{{RemarkCode::gravity_impossible, Severity::error}})) << g;
  }
  model.gravity_G = Vec3(0.0, -9.80665e-3, 0.0);
  EXPECT_EQ(found(model), (CodesFound{{RemarkCode::gravity_impossible, Severity::warning}}));
}

TEST(ImplausibleModel, LengthsInMillimetersAndForcesBeyondAnyMuscleNameTheMuscle) {
  BodyModel model = usual();
  model.muscles.push_back(model.muscles.front());
  model.muscles.back().name = "TRI";
  model.muscles.back().properties.optimal_fiber_length_m = 134.0;
  std::vector<Remark> said = implausible(model);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].code, RemarkCode::muscle_impossible);
  EXPECT_EQ(said[0].about, "TRI");
  EXPECT_EQ(said[0].value, 134.0);
  model = usual();
  model.muscles[0].properties.tendon_slack_length_m = 200.0;
  EXPECT_EQ(implausible(model).size(), 1U);
  model = usual();
  model.muscles[0].properties.max_isometric_force_n = -5.0;
  EXPECT_EQ(implausible(model).size(), 1U);
  // A mouse's fibers have 2 mm.
  model = usual();
  model.muscles[0].properties.optimal_fiber_length_m = 0.002;
  EXPECT_TRUE(implausible(model).empty());
}

TEST(ImplausibleModel, PointsOfAPathAreWithinARoom) {
  BodyModel model = usual();
  model.coordinates = {{.name = "elbow", .default_value = 0.5}};
  PathPoint fixed{.name = "P1", .p_BP = Vec3(0.0, -0.3, 0.0)};
  PathPoint moving{.name = "P2"};
  moving.moving =
      PathPoint::Moving{.coordinates = {-1, 0, -1}, .location = {Constant{0.02}, Constant{0.1}, Constant{0.0}}};
  model.muscles[0].path.points = {fixed, moving};
  EXPECT_TRUE(implausible(model).empty());
  model.muscles[0].path.points[0].p_BP.y() = -300.0;  // written in mm
  std::vector<Remark> said = implausible(model);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].code, RemarkCode::muscle_impossible);
  EXPECT_EQ(said[0].about, "BIC");
  EXPECT_EQ(said[0].value, 300.0);
  model.muscles[0].path.points = {fixed, moving};
  model.muscles[0].path.points[1].moving->location[0] = Constant{4294967296.0};
  EXPECT_EQ(implausible(model).size(), 1U);
}

}  // namespace
}  // namespace myoid::body
