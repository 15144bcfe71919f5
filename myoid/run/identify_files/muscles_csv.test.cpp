#include "myoid/run/identify_files/muscles_csv.h"

#include <array>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/units.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/muscle/literature.h"

#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::run {
namespace {

const std::string kHeader =
    "muscle,max_isometric_force,optimal_fiber_length,tendon_slack_length,force_length_width,"
    "max_shortening_speed,concentric_curvature,eccentric_curvature_product,eccentric_plateau";
const std::string kBiceps = "BIC,1000,0.12,0.2,0.055,1.2,0.28,0.2,1.4";

MuscleTable table_of(const std::string& text, bool within_bounds = true) {
  const test::TemporaryFolder folder;
  write_file(folder / "muscles.csv", text);
  return read_muscles_csv(folder / "muscles.csv", within_bounds);
}

std::string csv_message(const std::string& text) {
  return test::message_of([&] { (void)table_of(text); });
}

TEST(MusclesCsv, AParameterHeldOrFreedByItsColumnIsHeldOrFreed) {
  const MuscleTable table = table_of(kHeader + ",max_shortening_speed_fixed,passive_force_fixed,emg\n" + kBiceps +
                                     ",yes,no,Ch 1\nBRA" + kBiceps.substr(3) + ",,,\n");
  ASSERT_EQ(table.muscles.size(), 2U);
  EXPECT_EQ(table.muscles[0].start.max_isometric_force_n, 1000.0);
  EXPECT_EQ(table.muscles[0].fixed, std::vector<std::string>{"max_shortening_speed"});
  EXPECT_EQ(table.muscles[0].emg_channel, "Ch 1");
  EXPECT_EQ(table.muscles[1].emg_channel, "BRA");
  ASSERT_EQ(table.rules.size(), 1U);
  EXPECT_EQ(table.rules[0].parameter, "passive_force");
  EXPECT_EQ(table.rules[0].owners, std::vector<std::string>{"BIC"});
}

TEST(MusclesCsv, SemicolonsAndDecimalCommasAreRead) {
  std::string text = kHeader + "\n" + kBiceps + "\n";
  for (char& c : text) c = c == ',' ? ';' : c;
  for (char& c : text) c = c == '.' ? ',' : c;
  EXPECT_EQ(table_of(text).muscles.at(0).start.optimal_fiber_length_m, 0.12);
}

TEST(MusclesCsv, WhatCannotBeMeantIsRefusedAtItsLine) {
  EXPECT_NE(csv_message("emg\nBIC\n").find("no column 'muscle'"), std::string::npos);
  EXPECT_NE(csv_message(kHeader + ",colour\n" + kBiceps + ",red\n").find("unknown column 'colour'"), std::string::npos);
  EXPECT_NE(
      csv_message(kHeader + "\n" + kBiceps + "\n" + kBiceps + "\n").find("muscles.csv:3: muscle 'BIC' is listed twice"),
      std::string::npos);
  EXPECT_NE(csv_message(kHeader + "\nBIC,strong,0.12,0.2,0.055,1.2,0.28,0.2,1.4\n")
                .find("muscles.csv:2: max_isometric_force: expected a number, found 'strong'"),
            std::string::npos);
  EXPECT_NE(csv_message(kHeader + "\nBIC,,0.12,0.2,0.055,1.2,0.28,0.2,1.4\n").find("'BIC' has no max_isometric_force"),
            std::string::npos);
}

TEST(MusclesCsv, APennationInDegreesIsRefusedUnlessItsColumnSaysSo) {
  const std::string row = "\n" + kBiceps + ",25\n";
  const std::string said = csv_message(kHeader + ",pennation_angle" + row);
  for (const char* part : {"muscles.csv:2", "'BIC'", "pennation_angle = 25, expected 0 to 1 rad", "[deg]", "0.4363"})
    EXPECT_NE(said.find(part), std::string::npos) << said;
  EXPECT_NE(csv_message(kHeader + ",pennation_angle\n" + kBiceps + ",-0.1\n").find("expected 0 to 1 rad"),
            std::string::npos);
  const MuscleTable table = table_of(kHeader + ",pennation_angle [deg]" + row);
  EXPECT_NEAR(table.muscles.at(0).extras.pennation_angle_rad, 25.0 * kDegree, 1e-12);
}

TEST(MusclesCsv, AFileOfAnotherKindIsNamedAsThat) {
  const test::TemporaryFolder folder;
  write_file(folder / "subject.xml", "<subject>\n</subject>\n");
  const std::string said = test::message_of([&] { (void)read_muscles_csv(folder / "subject.xml", true); });
  EXPECT_NE(said.find("subject.xml: this is a .xml file (a set-up), but a table of muscles"), std::string::npos)
      << said;
}

TEST(MusclesCsv, NameForceAndLengthAreEnough) {
  const MuscleTable table =
      table_of("Name,maxIsometricForce,optimalFiberLength [cm],tendonSlackLength\nTA,905,9.8,0.223\n");
  const auto& start = table.muscles.at(0).start;
  const auto literature = muscle::literature_parameters({"TA", 905.0, 0.098, 0.223, 0.0});  // theory/muscle.md's table
  for (const muscle::HillField& field : muscle::kHillFields)
    EXPECT_NEAR(start.*field.member, literature.*field.member, 1e-15) << field.name;
  EXPECT_EQ(table.assumed.size(), 5U) << "width, three of the velocity, v_max";
  EXPECT_TRUE(table_of(kHeader + "\n" + kBiceps + "\n").assumed.empty());
  // Of two muscles the one that lacks a number is named.
  const MuscleTable two = table_of("muscle,F_max,l0,concentric_curvature\nA,100,0.1,0.3\nB,100,0.1,\n");
  EXPECT_EQ(two.muscles[0].start.concentric_curvature, 0.3);
  EXPECT_EQ(two.assumed.at("concentric_curvature"), std::vector<std::string>{"B"});
  // OpenSim's speed is in fiber lengths per second.
  EXPECT_NEAR(
      table_of("name,Fmax,lMo,max_contraction_velocity\nA,100,0.1,8\n").muscles[0].start.max_shortening_speed_mps, 0.8,
      1e-15);
}

TEST(MusclesCsv, EveryLegalCombinationOfExtremesStartsWithinItsBounds) {
  // What is given lies on the bounds; what is absent follows from it.
  const auto cells = [](const char* name) {
    const muscle::Range bounds = muscle::hill_field(name).bounds;
    return std::array<std::string, 3>{fmt::format("{}", bounds.lower), fmt::format("{}", bounds.upper), ""};
  };
  const std::string header = "muscle,max_isometric_force,optimal_fiber_length,concentric_curvature,eccentric_plateau\n";
  for (const std::string force : {"5", "20000"}) {
    for (const std::string length : {"0.01", "0.6"}) {
      for (const std::string& curvature : cells("concentric_curvature")) {
        for (const std::string& plateau : cells("eccentric_plateau")) {
          const MuscleTable table =
              table_of(header + "A," + force + ',' + length + ',' + curvature + ',' + plateau + '\n');
          const auto& muscle = table.muscles.at(0);
          for (const muscle::HillField& field : muscle::kHillFields) {
            const double value = muscle.start.*field.member;
            const auto own = muscle.bounds.find(std::string(field.name));
            const muscle::Range bounds = own == muscle.bounds.end() ? field.bounds : own->second;
            EXPECT_GE(value, bounds.lower) << field.name << header;
            EXPECT_LE(value, bounds.upper) << field.name;
          }
        }
      }
    }
  }
}

TEST(MusclesCsv, TheSlopesRatioAloneStandsForTheProduct) {
  const std::string header =
      "muscle,max_isometric_force,optimal_fiber_length,force_length_width,max_shortening_speed,"
      "concentric_curvature,eccentric_plateau,eccentric_slope_ratio";
  const std::string values = ",1000,0.12,0.055,1.2,0.28,1.4,1.6";
  const MuscleTable table = table_of(header + "\nBIC" + values + "\n");
  // P = (V_ml - 1) V_sh / (S (1 + V_sh)) = 0.4 * 0.28 / (1.6 * 1.28)
  EXPECT_NEAR(table.muscles.at(0).start.eccentric_curvature_product, 0.0546875, 1e-12);
  ASSERT_EQ(table.rules.size(), 1U);
  EXPECT_EQ(table.rules[0].parameter, "eccentric_slope_ratio");
  EXPECT_EQ(table.rules[0].free, true);
  EXPECT_EQ(table.rules[0].value, 1.6);
  const MuscleTable held = table_of(header + ",eccentric_slope_ratio_fixed\nBIC" + values + ",true\n");
  ASSERT_EQ(held.rules.size(), 1U);
  EXPECT_EQ(held.rules[0].free, false);
  EXPECT_EQ(held.rules[0].value, 1.6);
  EXPECT_NE(csv_message(header + "\nBIC,1000,0.12,0.055,1.2,0.28,1.4,-1\n").find("positive number"), std::string::npos);
  // The plateau is the literature's 1.4 then, and the ratio holds with it.
  const MuscleTable assumed = table_of(header + "\nBIC,1000,0.12,0.055,1.2,0.28,,1.6\n");
  EXPECT_NEAR(assumed.muscles.at(0).start.eccentric_curvature_product, 0.0546875, 1e-12);
  EXPECT_FALSE(assumed.assumed.contains("eccentric_curvature_product"));
}

TEST(MusclesCsv, AStartOutsideItsBoundsIsRefusedOnlyWhereTheMethodKeepsToThem) {
  const std::string millimeters = kHeader + "\nBIC,1000,120,200,55,1200,0.28,0.2,1.4\n";
  EXPECT_NE(csv_message(millimeters).find("optimal_fiber_length"), std::string::npos);
  EXPECT_EQ(table_of(millimeters, false).muscles.at(0).start.optimal_fiber_length_m, 120.0);
}

}  // namespace
}  // namespace myoid::run
