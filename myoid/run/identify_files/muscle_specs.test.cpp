#include "myoid/run/identify_files/muscle_specs.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::run {
namespace {

TEST(MuscleSpecs, ATableIsMusclesWithStartsAndParametersWithTheRest) {
  const test::TemporaryFolder folder;
  write_file(folder / "muscles.csv",
             "muscle,emg,max_isometric_force,optimal_fiber_length,concentric_curvature_fixed,"
             "max_isometric_force_prior_sd,optimal_fiber_length_lower,pennation_angle,tendon_strain_fixed\n"
             "BIC,biceps,900,0.1,true,50,0.08,0.2,false\n"
             "TRI,,1200,0.12,,,,,\n");
  const MuscleTable table = read_muscles_csv(folder / "muscles.csv", true);
  const std::vector<study::MuscleSpec> specs = muscle_specs(table);
  ASSERT_EQ(specs.size(), 2U);
  EXPECT_EQ(specs[0].emg, "biceps");
  EXPECT_EQ(specs[1].emg, "TRI");
  EXPECT_EQ(specs[0].osim, std::vector<std::string>{"BIC"});
  EXPECT_EQ(specs[0].start.at("max_isometric_force"), 900.0);
  EXPECT_FALSE(specs[1].start.contains("concentric_curvature")) << "the literature's";
  EXPECT_EQ(specs[0].fixed, std::vector<std::string>{"concentric_curvature"});
  EXPECT_TRUE(specs[1].fixed.empty());
  const std::vector<fit::ParameterRule> rules = parameter_rules(table);
  const auto rule = [&](const char* name) { return *std::ranges::find(rules, name, &fit::ParameterRule::parameter); };
  EXPECT_EQ(rules.size(), 4U);
  EXPECT_EQ(rule("max_isometric_force").prior_sd, 50.0);
  EXPECT_EQ(rule("max_isometric_force").prior_mean, 900.0);
  EXPECT_EQ(rule("optimal_fiber_length").lower, 0.08);
  EXPECT_EQ(rule("pennation_angle").value, 0.2);
  EXPECT_EQ(rule("tendon_strain").free, true);
  for (const fit::ParameterRule& each : rules) EXPECT_EQ(each.owners, std::vector<std::string>{"BIC"});
}

TEST(MuscleSpecs, AMuscleWithoutEmgHasNoChannel) {
  const test::TemporaryFolder folder;
  const auto table_of = [&](const std::string& rows) {
    write_file(folder / "muscles.csv",
               "muscle,emg,without_emg,max_isometric_force,optimal_fiber_length\nBIC,biceps,,900,0.1\n" + rows);
    return read_muscles_csv(folder / "muscles.csv", true);
  };
  const std::vector<study::MuscleSpec> specs = muscle_specs(table_of("BRA,,unseen,900,0.1\n"));
  EXPECT_EQ(specs.at(0).without_emg, std::nullopt);
  EXPECT_EQ(specs.at(1).without_emg, fit::WithoutEmg::unseen);
  EXPECT_EQ(specs.at(1).emg, "");
  EXPECT_THROW((void)table_of("BRA,,passive,900,0.1\n"), ReadError);
  EXPECT_THROW((void)table_of("BRA,biceps,unseen,900,0.1\n"), ReadError);
}

}  // namespace
}  // namespace myoid::run
