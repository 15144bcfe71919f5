#include "myoid/program/steps/convert_parts.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/output_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

TEST(ConvertParts, TurnsFollowOneAnotherAndRightAnglesStayExact) {
  ConvertOptions o;
  EXPECT_TRUE(rotation_of(o, Vec3::UnitY()).isIdentity(0.0));
  EXPECT_EQ((rotation_of(o, Vec3::UnitZ()) * Vec3::UnitZ() - Vec3::UnitY()).norm(), 0.0);
  o.turns = {"x:90", "z:90"};
  // x:90 brings y to z, which z:90 leaves; x stays and goes to y.
  const Mat3 R = rotation_of(o, Vec3::UnitY());
  EXPECT_EQ((R * Vec3::UnitY() - Vec3::UnitZ()).norm(), 0.0);
  EXPECT_EQ((R * Vec3::UnitX() - Vec3::UnitY()).norm(), 0.0);
  for (const char* wrong : {"x", "x90", "w:90", "x:many", "x:inf"}) {
    o.turns = {wrong};
    EXPECT_THROW((void)rotation_of(o, Vec3::UnitY()), InvalidInput) << wrong;
  }
}

TEST(ConvertParts, TheNewClockBeginsWithTheOldOneAndEndsWithinIt) {
  ConvertOptions o;
  o.rate_hz = 10.0;
  const Eigen::VectorXd clock = new_clock(o, Eigen::Vector3d(2.0, 2.3, 2.55));
  ASSERT_EQ(clock.size(), 6);
  EXPECT_EQ(clock[0], 2.0);
  EXPECT_DOUBLE_EQ(clock[5], 2.5);
  o.rate_hz = 1.0;
  EXPECT_THROW((void)new_clock(o, Eigen::Vector3d(2.0, 2.3, 2.55)), InvalidInput);
}

TEST(ConvertParts, EveryPlateNeedsABodyOrAnEmptyOne) {
  recording::Recording file;
  file.plates.resize(2);
  file.plates[0].number = 1;
  file.plates[1].number = 3;
  ConvertOptions o;
  EXPECT_EQ(plate_numbers(o, file), (std::vector<int>{1, 3}));
  o.bodies = {"calcn_r"};
  EXPECT_THROW((void)plate_numbers(o, file), InvalidInput);
  o.bodies = {"calcn_r", ""};
  EXPECT_EQ(plate_numbers(o, file).size(), 2U);
}

TEST(OutputFile, NeitherAnInputNorWithoutOverwriteAnExistingFileIsReplaced) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.sto", "text");
  EXPECT_NO_THROW(check_output(folder / "b.sto", {folder / "a.sto"}, false));
  EXPECT_THROW(check_output(folder / "a.sto", {}, false), InvalidInput);
  EXPECT_NO_THROW(check_output(folder / "a.sto", {}, true));
  EXPECT_THROW(check_output(folder / "a.sto", {folder / "a.sto"}, true), InvalidInput);
  EXPECT_THROW(check_output(folder.path() / "x/../a.sto", {folder / "a.sto"}, true), InvalidInput);
  EXPECT_THROW(check_output("", {}, true), InvalidInput);
}

}  // namespace
}  // namespace myoid::program
