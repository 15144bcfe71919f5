#include "myoid/program/steps/sweep.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/program/steps/paths.h"
#include "myoid/recording/tables/csv_reader.h"

#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

SweepResult elbow(const std::string& coordinate = "elbow_flexion=10:120") {
  SweepOptions options;
  options.model = "arm4";
  options.coordinate = coordinate;
  return sweep(options);
}

TEST(Sweep, TheMomentArmIsTheSlopeOfTheLength) {
  const SweepResult result = elbow();
  ASSERT_EQ(result.muscles.size(), 4U);
  for (const auto& muscle : result.muscles) {
    ASSERT_EQ(muscle.path.values.size(), kSweepSteps + 1);
    EXPECT_NEAR(muscle.path.values[0], 10.0 * kDegree, 1e-15);
    EXPECT_NEAR(muscle.path.values[kSweepSteps], 120.0 * kDegree, 1e-15);
    const double step = muscle.path.values[1] - muscle.path.values[0];
    for (Eigen::Index i = 0; i < kSweepSteps; ++i) {
      const double slope = (muscle.path.lengths_m[i + 1] - muscle.path.lengths_m[i]) / step;
      // The trapezoid's error: a moment arm of some cm bends by its own size in a radian, 0.02 rad squared over 12.
      EXPECT_NEAR(-slope, 0.5 * (muscle.path.arms_m[i] + muscle.path.arms_m[i + 1]), 1e-5) << muscle.name << i;
    }
  }
}

TEST(Sweep, PathsAlongAMotionGivesTheSameNumbers) {
  const test::TemporaryFolder folder;
  write_file(folder / "m.mot",
             "m\nversion=1\ninDegrees=yes\nendheader\ntime\telbow_flexion\n"
             "0\t10\n1\t37.5\n2\t65\n3\t92.5\n4\t120\n");
  PathsOptions options;
  options.model = "arm4";
  options.motion = folder / "m.mot";
  const body::MuscleKinematics along = paths(options).muscles;
  const SweepResult result = elbow();
  for (std::size_t m = 0; m < result.muscles.size(); ++m) {
    const auto& muscle = result.muscles[m];
    for (const Eigen::Index frame : {0, 1, 2, 3, 4}) {
      EXPECT_NEAR(muscle.path.lengths_m[frame * kSweepSteps / 4], along.length.column(muscle.name)[frame], 1e-12);
      EXPECT_NEAR(muscle.path.arms_m[frame * kSweepSteps / 4],
                  along.moment_arm.at("elbow_flexion").column(muscle.name)[frame], 1e-12);
    }
  }
}

TEST(Sweep, TheTableHasEveryValueInTheStatedUnits) {
  const test::TemporaryFolder folder;
  const SweepResult result = elbow();
  const auto files = write_sweep(result, folder.path());
  const recording::CsvTable table = recording::read_csv_table(files[0]);
  ASSERT_EQ(table.rows.size(), 4U * (kSweepSteps + 1));
  EXPECT_THAT(table.names, testing::ElementsAre("muscle", "elbow_flexion_deg", "moment_arm_m", "length_m",
                                                "full_force_n", "passive_force_n"));
  const auto& last = table.rows.back();
  EXPECT_EQ(last[0], result.muscles.back().name);
  EXPECT_NEAR(std::stod(last[1]), 120.0, 1e-7);
  EXPECT_NEAR(std::stod(last[3]), result.muscles.back().path.lengths_m[kSweepSteps], 1e-9);
  EXPECT_TRUE(std::filesystem::file_size(files[1]) > 1000);
}

TEST(Sweep, NamesTheCoordinatesAndMusclesThatAreThere) {
  const auto message = [](const std::string& coordinate, std::vector<std::string> muscles = {}) {
    SweepOptions options;
    options.model = "arm4";
    options.coordinate = coordinate;
    options.muscles = std::move(muscles);
    try {
      (void)sweep(options);
    } catch (const InvalidInput& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_THAT(message("knee"), testing::HasSubstr("elbow_flexion"));
  EXPECT_THAT(message("elbow_flexion", {"soleus"}), testing::HasSubstr("BIC"));
  for (const char* wrong : {"elbow_flexion=", "elbow_flexion=90", "elbow_flexion=a:b", "elbow_flexion=90:10"})
    EXPECT_FALSE(message(wrong).empty()) << wrong;
  EXPECT_EQ(message("elbow_flexion", {"BIC"}), "");
  SweepOptions timed;
  timed.model = "arm4";
  timed.coordinate = "elbow_flexion";
  timed.call.end_s = 2.0;
  EXPECT_THROW((void)sweep(timed), InvalidInput);
}

}  // namespace
}  // namespace myoid::program
