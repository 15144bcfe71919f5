#include "myoid/study/checks/model_mass.h"

#include <gtest/gtest.h>

#include "tests/support/vertical_slider.h"

namespace myoid::study {
namespace {

body::BodyModel of_mass(double mass_kg) {
  body::BodyModel model;
  model.bodies = {
      {.name = "ground"}, {.name = "trunk", .mass_kg = 0.9 * mass_kg}, {.name = "arm", .mass_kg = 0.1 * mass_kg}};
  return model;
}

std::vector<Remark> found(double model_kg, std::optional<double> person_kg) {
  Study study;
  study.subject.mass_kg = person_kg;
  return unlikely_mass(study, of_mass(model_kg));
}

TEST(UnlikelyMass, OfAPersonOrOfAPartOfThePersonIsNone) {
  for (const double model_kg : {73.0, 85.0, 40.0, 4.0, 0.5}) {
    EXPECT_TRUE(found(model_kg, 73.0).empty()) << model_kg;
    EXPECT_TRUE(found(model_kg, std::nullopt).empty()) << model_kg;
  }
}

TEST(UnlikelyMass, OfAHeavierBodyThanThePersonsIsAWarning) {
  const std::vector<Remark> said = found(85.27, 40.0);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].severity, Severity::warning);
  EXPECT_EQ(said[0].code, RemarkCode::mass_impossible);
  EXPECT_NE(said[0].says.find("85.27 kg, 2.13 times"), std::string::npos) << said[0].says;
}

TEST(UnlikelyMass, ThatNoPersonHasIsOfTheModelAlone) {
  for (const double model_kg : {40106.0, 0.04}) EXPECT_TRUE(found(model_kg, 73.0).empty()) << model_kg;
}

TEST(UnlikelyMass, OfAWholeBodyThatIsLighterThanThePersonIsAWarning) {
  body::BodyModel model;
  model.bodies = {{.name = "ground"}, {.name = "trunk", .mass_kg = 60.0}, {.name = "leg", .mass_kg = 25.0}};
  body::Joint hip{.name = "hip", .class_name = "PinJoint", .parent = 1, .child = 2};
  hip.X_PF.p = Vec3(0.0, -0.4, 0.0);
  hip.coordinates = {1};
  hip.rotation = {body::TransformAxis{Vec3::UnitZ(), 1, body::Linear{1.0, 0.0}}, body::TransformAxis{Vec3::UnitX()},
                  body::TransformAxis{Vec3::UnitY()}};
  model.joints = {test::vertical_slider(), hip};
  model.coordinates = {{.name = "height", .joint = 0, .motion = body::MotionType::translational},
                       {.name = "hip_flexion", .joint = 1}};
  model = body::finalize(std::move(model));
  Study study;
  study.subject.mass_kg = 180.0;
  const std::vector<Remark> said = unlikely_mass(study, model);
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].severity, Severity::warning);
  EXPECT_NE(said[0].says.find("pounds"), std::string::npos) << said[0].says;
  study.subject.mass_kg = 95.0;
  EXPECT_TRUE(unlikely_mass(study, model).empty());
}

}  // namespace
}  // namespace myoid::study
