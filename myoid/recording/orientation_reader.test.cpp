#include "myoid/recording/orientation_reader.h"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

class Orientations : public ::testing::Test {
 protected:
  OrientationSeries read(const std::string& rows, const std::string& type = "Quaternion") {
    std::ofstream(folder_.path() / "o.sto")
        << "DataRate=100\nDataType=" << type << "\nversion=3\nOpenSimVersion=4.5\nendheader\n"
        << rows;
    return read_orientations(folder_.path() / "o.sto");
  }
  test::TemporaryFolder folder_;
};

// A quarter turn about z takes x to y; its quaternion may have any length.
TEST_F(Orientations, AreReadAsUnitQuaternions) {
  const OrientationSeries series =
      read("time\tpelvis_imu\ttibia_imu\n0\t2,0,0,2\t1,0,0,0\n0.01\tNaN,NaN,NaN,NaN\t0,1,0,0\n");
  ASSERT_EQ(series.names, (std::vector<std::string>{"pelvis_imu", "tibia_imu"}));
  ASSERT_EQ(series.time_s.size(), 2);
  EXPECT_LT((series.rotation(0, 0) * Vec3::UnitX() - Vec3::UnitY()).norm(), 1e-15);
  EXPECT_LT((series.rotation(1, 1) - Mat3(Vec3(1, -1, -1).asDiagonal())).norm(), 1e-15);
  EXPECT_TRUE(std::isnan(series.rotation(1, 0)(0, 0)));
}

TEST_F(Orientations, RefuseWhatIsNoOrientation) {
  const std::string head = "time\ta_imu\tb_imu\n";
  for (const char* rows : {"0\t1,0,0,0\n", "0\t1,0,0\t1,0,0,0\n", "0\t1,0,0,0,0\t1,0,0,0\n", "0\t0,0,0,0\t1,0,0,0\n",
                           "0\t1,0,x,0\t1,0,0,0\n", "", "0.1\t1,0,0,0\t1,0,0,0\n0\t1,0,0,0\t1,0,0,0\n"})
    EXPECT_THROW((void)read(head + rows), ReadError) << rows;
  EXPECT_THROW((void)read("time\n0\n"), ReadError);
  EXPECT_THROW((void)read(head + "0\t1,0,0,0\t1,0,0,0\n", "double"), ReadError);
  try {
    (void)read(head + "0\t1,0,0,0\t1,0,0,0\n0.1\t1,0,0\t1,0,0,0\n");
    FAIL() << "expected an error";
  } catch (const ReadError& error) {
    EXPECT_NE(std::string(error.what()).find(":8:"), std::string::npos) << error.what();
  }
}

// Digits lost at the end of a file would turn a sensor without notice: 0.6, 0.8 lost two of them.
TEST_F(Orientations, LeaveOutARowThatIsCutOff) {
  const OrientationSeries series = read("time\ta_imu\n0\t0.60,0.80,0,0.00\n0.01\t0.60,0,0,0.80\n0.02\t0.60,0,0,0.");
  EXPECT_EQ(series.time_s.size(), 2);
  ASSERT_EQ(series.repairs.size(), 1U);
  EXPECT_EQ(series.repairs[0].message, kLastRowLeftOut);
}

TEST_F(Orientations, StateARowAndANameThatRepeat) {
  const OrientationSeries series =
      read("time\ta\ta\n0.1\t1,0,0,0\t0,1,0,0\n0.1\t1,0,0,0\t1,0,0,0\n0.2\t1,0,0,0\t1,0,0,0\n");
  EXPECT_EQ(series.time_s.size(), 2);
  EXPECT_EQ(series.names, (std::vector<std::string>{"a", "a_2"}));
  EXPECT_EQ(series.repairs.size(), 2U);
}

}  // namespace
}  // namespace myoid::recording
