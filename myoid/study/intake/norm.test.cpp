#include "myoid/study/intake/norm.h"

#include <optional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Norm norm_of(const std::string& text, const std::optional<double>& mass_kg = {}) {
  const test::TemporaryFolder folder;
  const auto file = folder / "norm.csv";
  write_file(file, text);
  Study study;
  study.subject.mass_kg = mass_kg;
  return read_norm({"adults", file, {}}, study);
}

std::string refusal(const std::string& text) {
  try {
    (void)norm_of(text);
  } catch (const ReadError& error) {
    return error.what();
  }
  return "";
}

TEST(Norm, IsReadInDegreesAndNewtonMeters) {
  const Norm norm = norm_of(
      "percent,elbow_flexion_mean [rad],elbow_flexion_sd [rad],knee_angle_r_mean,"
      "elbow_flexion_moment_mean [N m/kg],elbow_flexion_moment_sd [N m/kg]\n"
      "0,0.5,0.1,3,0.02,0.01\n50,1,0.2,4,0.04,0.02\n100,0.5,0.1,3,0.02,0.01\n",
      70.0);
  EXPECT_EQ(norm.name, "adults");
  EXPECT_THAT(norm.percent, ElementsAre(0.0, 50.0, 100.0));
  ASSERT_EQ(norm.curves.size(), 2U);  // the knee is no coordinate of the study
  EXPECT_FALSE(norm.curves[0].torque);
  EXPECT_NEAR(norm.curves[0].mean[1], 57.29577951308232, 1e-12);
  EXPECT_NEAR(norm.curves[0].sd[1], 11.459155902616464, 1e-12);
  EXPECT_TRUE(norm.curves[1].torque);
  EXPECT_NEAR(norm.curves[1].mean[1], 2.8, 1e-12);
  EXPECT_NEAR(norm.curves[1].sd[0], 0.7, 1e-12);
}

TEST(Norm, SemicolonsAllowDecimalCommas) {
  const Norm norm = norm_of("percent;elbow_flexion_mean;elbow_flexion_sd\r\n0;12,5;1,5\r\n100;20;2\r\n");
  EXPECT_NEAR(norm.curves.at(0).mean[0], 12.5, 1e-12);
  EXPECT_NEAR(norm.curves.at(0).sd[0], 1.5, 1e-12);
}

TEST(Norm, EveryFaultIsNamedWithItsLine) {
  const std::string head = "percent,elbow_flexion_mean,elbow_flexion_sd\n";
  EXPECT_THAT(refusal("time,elbow_flexion_mean,elbow_flexion_sd\n0,1,1\n1,1,1\n"),
              HasSubstr("norm.csv:1: no column 'percent'"));
  EXPECT_THAT(refusal("percent,elbow_flexion_mean\n0,1\n100,1\n"), HasSubstr(":1: no column 'elbow_flexion_sd'"));
  EXPECT_THAT(refusal(head + "0,1,1\n0,1,1\n"), HasSubstr(":3: percent is 0; expected numbers"));
  EXPECT_THAT(refusal(head + "0,1,1\n120,1,1\n"), HasSubstr(":3: percent is 120"));
  EXPECT_THAT(refusal(head + "0,1,1\n100,x,1\n"), HasSubstr(":3: column 'elbow_flexion_mean'"));
  EXPECT_THAT(refusal(head + "0,1,nan\n100,1,1\n"), HasSubstr(":2: column 'elbow_flexion_sd'"));
  EXPECT_THAT(refusal(head + "0,1,1\n100,1,-1\n"), HasSubstr(":3: column 'elbow_flexion_sd'"));
  EXPECT_THAT(refusal(head + "0,1,1\n"), HasSubstr(":1: "));
  EXPECT_THAT(refusal("percent,knee_mean,knee_sd\n0,1,1\n100,1,1\n"), HasSubstr("elbow_flexion"));
  EXPECT_THAT(refusal("percent,elbow_flexion_mean [mm],elbow_flexion_sd [mm]\n0,1,1\n100,1,1\n"), HasSubstr("'mm'"));
  EXPECT_THAT(refusal("percent,elbow_flexion_moment_mean [N m/kg],elbow_flexion_moment_sd [N "
                      "m/kg]\n0,1,1\n100,1,1\n"),
              HasSubstr("mass_kg"));
  EXPECT_THROW((void)read_norm({"adults", "absent.csv", {}}, Study{}), ReadError);
}

}  // namespace
}  // namespace myoid::study
