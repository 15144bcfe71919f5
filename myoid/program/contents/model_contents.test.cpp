#include "myoid/program/contents/model_contents.h"

#include <string>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::program {
namespace {

TEST(ModelContents, CountsAndNamesWhatTheModelHas) {
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const nlohmann::ordered_json contents = model_contents(arm);
  EXPECT_EQ(contents.at("muscles").size(), 4U);
  double mass_kg = 0.0;
  for (const body::Body& body : arm.bodies) mass_kg += body.mass_kg;
  EXPECT_NEAR(contents.at("mass_kg").get<double>(), mass_kg, 1e-12);
  bool elbow = false;
  for (const auto& c : contents.at("coordinates"))
    elbow = elbow || (c.at("name") == "elbow_flexion" && c.at("unit") == "deg" && c.at("lower") < c.at("upper"));
  EXPECT_TRUE(elbow);
  EXPECT_EQ(contents.at("muscles").at(0).at("max_isometric_force_n"), arm.muscles[0].properties.max_isometric_force_n);
  EXPECT_FALSE(contents.contains("jumps"));
  EXPECT_TRUE(model_contents(arm, {.jumps = true}).contains("jumps"));
}

}  // namespace
}  // namespace myoid::program
