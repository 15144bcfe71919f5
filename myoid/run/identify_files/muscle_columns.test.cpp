#include "myoid/run/identify_files/muscle_columns.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/message_of.h"

namespace myoid::run {
namespace {

std::map<std::string, MuscleColumn> columns_of(const std::string& header) {
  return muscle_columns(recording::parse_csv_table(header + "\n", "muscles.csv"), "muscles.csv");
}

std::string columns_message(const std::string& header) {
  return test::message_of([&] { (void)columns_of(header); });
}

TEST(MuscleColumns, NamesOfOtherProgramsAreUnderstood) {
  for (const char* header : {"muscle,max_isometric_force,optimal_fiber_length,tendon_slack_length,pennation_angle",
                             "name,maxIsometricForce,optimalFiberLength,tendonSlackLength,pennationAngle",
                             "Muscle Name,F_max,l_m_0,l_t_s,alpha0", "MUSCLE,FMAX,LOPT,LSLACK,PENNATION",
                             "name,FoM,lMo,lTs,pennation_angle_at_optimal"}) {
    const auto columns = columns_of(header);
    EXPECT_EQ(columns.at("muscle").index, 0U) << header;
    EXPECT_EQ(columns.at("max_isometric_force").index, 1U) << header;
    EXPECT_EQ(columns.at("optimal_fiber_length").index, 2U) << header;
    EXPECT_EQ(columns.at("tendon_slack_length").index, 3U) << header;
    EXPECT_EQ(columns.at("pennation_angle").index, 4U) << header;
  }
}

TEST(MuscleColumns, AUnitInTheHeaderScales) {
  const auto columns = columns_of("muscle,F_max [kN],lMo (mm),max_contraction_velocity");
  EXPECT_EQ(columns.at("max_isometric_force").to_si, 1000.0);
  EXPECT_EQ(columns.at("optimal_fiber_length").to_si, 0.001);
  EXPECT_TRUE(columns.at("max_shortening_speed").in_fiber_lengths);
  EXPECT_FALSE(columns.at("optimal_fiber_length").in_fiber_lengths);
}

TEST(MuscleColumns, NamesThatMayBeMeantAreNamed) {
  EXPECT_NE(columns_message("muscle,max_isometric_forse,l0").find("'max_isometric_force'?"), std::string::npos);
  EXPECT_NE(columns_message("muscle,F_max,Fiso,l0").find("two columns give"), std::string::npos);
  EXPECT_NE(columns_message("muscle,F_max [m],l0").find("expected a unit of"), std::string::npos);
  EXPECT_NE(columns_message("muscle,F_max").find("no column 'optimal_fiber_length'"), std::string::npos);
}

}  // namespace
}  // namespace myoid::run
