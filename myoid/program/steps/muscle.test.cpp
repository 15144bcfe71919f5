#include "myoid/program/steps/muscle.h"

#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/program/steps/muscle_input.h"

#include "tests/support/data_folder.h"
#include "tests/support/message_of.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

using testing::HasSubstr;

/// Half a second in which the rat soleus swings by 1 mm, driven fully but for the last tenth.
MuscleOptions swing(const test::TemporaryFolder& folder) {
  std::string length = "time,length\n";
  for (int k = 0; k <= 100; ++k) length += std::to_string(0.005 * k) + "," + std::to_string(std::sin(0.1 * k)) + "\n";
  write_file(folder / "l.csv", length);
  write_file(folder / "a.csv", "time,activation\n0,1\n0.4,1\n");
  MuscleOptions options;
  options.muscle = test::source_dir() / "examples/rat_soleus/muscle.toml";
  options.lengths = {folder / "l.csv"};
  options.scales = {0.001};
  options.offset_m = 0.0321;
  options.activation = {folder / "a.csv"};
  return options;
}

TEST(MuscleFunction, ComparesWithWhatItWroteAndFindsNoError) {
  const test::TemporaryFolder folder;
  MuscleOptions options = swing(folder);
  const MuscleResult first = muscle(options);
  ASSERT_TRUE(first.simulated);
  ASSERT_EQ(first.remarks.size(), 1U);
  EXPECT_THAT(first.remarks[0].says, HasSubstr("covers 0 to 0.4 s only"));
  std::string force = "time,force\n";
  const TimeSeries& series = first.simulated->simulated.series;
  for (Eigen::Index i = 0; i < series.sample_count(); ++i)
    force += std::to_string(series.time_s()[i]) + "," + std::to_string(2.0 * series.column("tendon_force")[i]) + "\n";
  write_file(folder / "f.csv", force);
  options.measured = {folder / "f.csv"};
  const MuscleResult second = muscle(options);
  ASSERT_TRUE(second.simulated->comparison);
  // Twice the force: the error is the mean force itself, to the six decimals of the file.
  EXPECT_NEAR(second.simulated->comparison->error_n, series.column("tendon_force").mean(), 1e-6);
}

TEST(MuscleFunction, LeavesSamplesWithoutAForceOut) {
  const test::TemporaryFolder folder;
  MuscleOptions options = swing(folder);
  const TimeSeries series = muscle(options).simulated->simulated.series;
  std::string force = "time,force\n";
  Eigen::Index gaps = 0;
  for (Eigen::Index i = 0; i < series.sample_count(); ++i) {
    const bool gap = i % 10 == 5;
    gaps += gap ? 1 : 0;
    force += fmt::format("{:.9f},{}\n", series.time_s()[i],
                         gap ? "NaN" : fmt::format("{:.9f}", series.column("tendon_force")[i]));
  }
  write_file(folder / "gaps.csv", force);
  options.measured = {folder / "gaps.csv"};
  const MuscleResult compared = muscle(options);
  ASSERT_TRUE(compared.simulated->comparison);
  EXPECT_EQ(compared.simulated->comparison->samples, series.sample_count() - gaps);
  EXPECT_NEAR(compared.simulated->comparison->error_n, 0.0, 1e-6);
  EXPECT_GT(compared.remarks.size(), 1U);  // the gaps, and a drive that ends early
  // The fit finds the strength that made the force.
  options.fit = {"max_isometric_force"};
  const MuscleResult fitted = muscle(options);
  const muscle::IsolatedEstimate& strength = fitted.fit->all.estimates[0];
  EXPECT_NEAR(strength.value, strength.start, 1e-3 * strength.start);
  write_file(folder / "none.csv", "time,force\n0,NaN\n0.1,NaN\n");
  options.measured = {folder / "none.csv"};
  EXPECT_THROW((void)muscle(options), ReadError);
}

TEST(MuscleFunction, RefusesANameOfAnotherFormat) {
  const test::TemporaryFolder folder;
  MuscleOptions options = swing(folder);
  options.measured = {folder / "missing.csv"};
  options.fit = {"max_isometric_force"};
  // A file that is missing is a ReadError; names are refused before.
  const auto is_refused_early = [&] {
    try {
      (void)muscle(options);
    } catch (const ReadError&) {
      return false;
    } catch (const InvalidInput&) {
      return true;
    }
    return false;
  };
  options.out = folder / "fit.sto";
  EXPECT_TRUE(is_refused_early());
  options.out = folder / "fit.csv";
  EXPECT_FALSE(is_refused_early());
  options.fitted = folder / "muscle.csv";
  EXPECT_TRUE(is_refused_early());
  options.fitted = folder / "muscle.toml";
  EXPECT_FALSE(is_refused_early());
}

TEST(MuscleFunction, HearsOfTheDriveAlthoughTheLengthIsRefusedLater) {
  const test::TemporaryFolder folder;
  MuscleOptions options = swing(folder);
  std::vector<std::string> heard;
  options.call.listener = [&](const Remark& remark) { heard.push_back(remark.says); };
  options.initial_activation = "soon";
  EXPECT_THROW((void)muscle(options), InvalidInput);
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_THAT(heard[0], HasSubstr("0.4 s"));
}

TEST(MuscleFunction, AColumnMayBeInAnotherUnitOfItsKind) {
  const test::TemporaryFolder folder;
  write_file(folder / "f.csv", "time,force [mN],length [mm]\n0,1500,30\n0.1,2500,31\n");
  Remarks remarks{Call{}};
  const ColumnChoice force{"--measured-column", "force", Unit::newton};
  EXPECT_EQ(read_column(folder / "f.csv", force, remarks).values, Eigen::Vector2d(1.5, 2.5));
  EXPECT_THROW((void)read_column(folder / "f.csv", {"--measured-column", "length", Unit::newton}, remarks), ReadError);
}

TEST(MuscleFunction, ReadsAColumnByItsName) {
  const test::TemporaryFolder folder;
  write_file(folder / "two.csv", "time,a,b\n0,1,3\n1,2,4\n");
  Remarks remarks{Call{}};
  EXPECT_EQ(read_column(folder / "two.csv", {"--column", "b"}, remarks).values, Eigen::Vector2d(3.0, 4.0));
  EXPECT_THAT(test::message_of([&] {
                (void)read_column(folder / "two.csv", {"--measured-column", ""}, remarks);
              }),
              HasSubstr("columns a, b: choose one with --measured-column"));
  EXPECT_THAT(test::message_of([&] {
                (void)read_column(folder / "two.csv", {"--drive-column", "c"}, remarks);
              }),
              HasSubstr("'c' (--drive-column)"));
}

TEST(MuscleFunction, ReadsLengthStimulusAndForceOfOneFile) {
  const test::TemporaryFolder folder;
  MuscleOptions options = swing(folder);
  std::string table = "time,length,stim,force\n";
  for (int k = 0; k <= 100; ++k)
    table += fmt::format("{},{},{},{}\n", 0.005 * k, std::sin(0.1 * k), k < 50 ? 0 : 1, k < 50 ? 0.5 : 1.0);
  write_file(folder / "in_situ.csv", table);
  options.lengths = options.measured = options.activation = {folder / "in_situ.csv"};
  options.column = "length";
  options.drive_column = "stim";
  options.measured_column = "force";
  const MuscleResult result = muscle(options);
  const Eigen::VectorXd activation = result.simulated->simulated.series.column("activation");
  EXPECT_EQ(activation[10], 0.0);
  EXPECT_EQ(activation[90], 1.0);
  EXPECT_EQ(result.simulated->comparison->samples, 101);
}

TEST(MuscleFunction, TakesOneDriveForAllExperimentsOrOneEach) {
  const test::TemporaryFolder folder;
  MuscleOptions options = swing(folder);
  options.lengths = {folder / "l.csv", folder / "l.csv"};
  options.activation = {"1", folder / "a.csv"};
  const muscle::MuscleFile file = muscle::read_muscle_file(options.muscle);
  Remarks remarks{Call{}};
  EXPECT_EQ(read_experiment(options, 0, file, remarks).drive.size(), 1);
  EXPECT_EQ(read_experiment(options, 1, file, remarks).drive.size(), 2);
  options.fit = {"tendon_strain"};
  options.measured = options.lengths;
  options.activation = {"1", "1", "1"};
  EXPECT_THAT(test::message_of([&] { (void)muscle(options); }), HasSubstr("--activation: 3 files for 2 of --length"));
}

TEST(MuscleFunction, RefusesUnknownLawsAndValuesOfTheirOwnOfWhatIsNotFitted) {
  const test::TemporaryFolder folder;
  MuscleOptions options = swing(folder);
  options.measured = options.lengths;
  options.fit = {"max_isometric_force"};
  options.laws = {"thelen", "hill"};
  EXPECT_THAT(test::message_of([&] { (void)muscle(options); }), HasSubstr("hill"));
  options.laws.clear();
  options.own = {"tendon_strain"};
  EXPECT_THAT(test::message_of([&] { (void)muscle(options); }), HasSubstr("'tendon_strain'"));
}

TEST(MuscleFunction, FitsADeepShorteningThatTakesManySteps) {
  // 8 mm of a muscle of 14 mm: it is slack on the way, and the integration takes more than 20,000 steps.
  const std::filesystem::path file = test::data_folder() / "rat-gastrocnemius/GMe1/SSC/GMe1_SSC_PB02_1.csv";
  MYOID_REQUIRE_DATA(file);
  MuscleOptions options;
  options.muscle = test::source_dir() / "examples/single_muscles/gastrocnemius.toml";
  options.lengths = options.excitation = options.measured = {file};
  options.column = "length";
  options.drive_column = "stim";
  options.measured_column = "force";
  options.fit = {"max_isometric_force"};
  const MuscleResult result = muscle(options);
  ASSERT_TRUE(result.fit);
  EXPECT_TRUE(result.fit->converged);
  EXPECT_LT(result.fit->errors[0].fitted, result.fit->errors[0].starting_values);
}

}  // namespace
}  // namespace myoid::program
