#include "myoid/muscle/muscle_file.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::muscle {
namespace {

constexpr const char* kSoleus = R"(
[muscle]
name = "soleus"
max_isometric_force = 1.276
optimal_fiber_length = 0.0171
tendon_slack_length = 0.0171
max_contraction_velocity = 5.3
pennation_deg = 6
)";

TEST(MuscleFile, TakesThePublishedDefaultsForWhatItLeavesOut) {
  const MuscleFile file = parse_muscle_file(kSoleus, "m.toml");
  EXPECT_EQ(file.name, "soleus");
  EXPECT_EQ(file.laws.length, muscle::LengthLaw::millard);
  EXPECT_EQ(file.laws.mode, muscle::TendonMode::equilibrium);
  EXPECT_EQ(file.parameters.tendon_strain, 0.049);
  EXPECT_EQ(file.parameters.damping, 0.1);
  EXPECT_NEAR(file.parameters.hill.max_shortening_speed_mps, 5.3 * 0.0171, 1e-16);
  EXPECT_NEAR(file.parameters.pennation_at_optimal_rad, 6.0 * kDegree, 1e-16);
  EXPECT_EQ(file.response.activation.law, muscle::ActivationLaw::thelen);
  EXPECT_EQ(file.response.activation.activation_time_s, 0.010);
}

TEST(MuscleFile, WhatIsWrittenIsReadAsTheSameMuscle) {
  for (const char* laws : {"laws = \"soest\"", "laws = \"millard\"\neccentric_plateau = 1.6\npassive_strain = 0.5"}) {
    MuscleFile file = parse_muscle_file(std::string(kSoleus) + laws + R"(
passive_slack = 1.1
[activation]
law = "one_lag"
calcium = true
calcium_half = 0.25
excitation_delay = 0.007
)",
                                        "m.toml");
    const MuscleFile again = parse_muscle_file(muscle_toml(file), "again.toml");
    EXPECT_EQ(again.name, file.name);
    EXPECT_TRUE(again.laws == file.laws);
    EXPECT_EQ(again.millard.velocity.max_eccentric_multiplier, file.millard.velocity.max_eccentric_multiplier);
    if (file.laws.passive == PassiveLaw::millard) {
      EXPECT_EQ(again.millard.passive.strain_at_one, file.millard.passive.strain_at_one);
    }
    std::vector<double> numbers, read;
    visit_parameters(file.parameters, [&](std::string_view, Unit, double x) { numbers.push_back(x); });
    visit_response(file.response, [&](std::string_view, Unit, double x) { numbers.push_back(x); });
    visit_parameters(again.parameters, [&](std::string_view, Unit, double x) { read.push_back(x); });
    visit_response(again.response, [&](std::string_view, Unit, double x) { read.push_back(x); });
    ASSERT_EQ(numbers.size(), read.size());
    // The angle is written in degrees: two roundings.
    for (std::size_t i = 0; i < numbers.size(); ++i) EXPECT_NEAR(read[i], numbers[i], 1e-15 * numbers[i]);
  }
}

TEST(MuscleFile, EveryElementCanFollowItsOwnLaw) {
  const MuscleFile file = parse_muscle_file(std::string(kSoleus) + R"(
laws = "paper"
tendon = "mass"
passive_law = "thelen"
tendon_law = "millard"
tendon_strain = 0.05
muscle_mass = 0.002
[activation]
law = "two_lags"
excitation_time = 0.03
)",
                                            "m.toml");
  EXPECT_EQ(file.laws.mode, muscle::TendonMode::mass);
  EXPECT_EQ(file.laws.length, muscle::LengthLaw::gaussian);
  EXPECT_EQ(file.laws.velocity, muscle::VelocityLaw::hill);
  EXPECT_EQ(file.laws.passive, muscle::PassiveLaw::thelen);
  EXPECT_EQ(file.laws.tendon, muscle::TendonLaw::millard);
  EXPECT_EQ(file.parameters.tendon_strain, 0.05);
  EXPECT_EQ(file.parameters.muscle_mass_kg, 0.002);
  EXPECT_EQ(file.response.activation.law, muscle::ActivationLaw::two_lags);
  EXPECT_EQ(file.response.activation.excitation_time_s, 0.03);
}

void expect_error(const std::string& text, const std::string& part) {
  try {
    static_cast<void>(parse_muscle_file(text, "m.toml"));
    ADD_FAILURE() << "accepted: " << text;
  } catch (const ReadError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("m.toml"));
    EXPECT_THAT(error.what(), testing::HasSubstr(part));
  }
}

TEST(MuscleFile, SaysWhatIsWrongAndWhere) {
  expect_error("name = 3", "[muscle]");
  expect_error("[muscle]\nmax_isometric_force = 1", "optimal_fiber_length");
  expect_error(std::string(kSoleus) + "tendon_slak_length = 1", "tendon_slack_length");
  expect_error(std::string(kSoleus) + "laws = \"hill\"", "millard");
  expect_error(std::string(kSoleus) + "damping = 0", "damping");
  expect_error(std::string(kSoleus) + "damping = -1", "damping");
  expect_error(std::string(kSoleus) + "max_shortening_speed = 1", "once");
  expect_error(std::string(kSoleus) + "pennation_deg = 90", "pennation");
  expect_error(std::string(kSoleus) + "passive_strain = 0", "passive");
  expect_error(std::string(kSoleus) + "[activation]\nactivation_time = 0", "activation_time");
  expect_error("[muscle]\nmax_isometric_force = -5", "max_isometric_force");
}

}  // namespace
}  // namespace myoid::muscle
