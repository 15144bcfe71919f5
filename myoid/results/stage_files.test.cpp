#include "myoid/results/stage_files.h"

#include <limits>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/units.h"
#include "myoid/recording/tables/storage_reader.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

TEST(WriteMotion, RotationsAreWrittenInDegrees) {
  const test::TemporaryFolder folder;
  const body::BodyModel arm = body::parse_osim(body::arm4_osim(), "arm4.osim");
  const Eigen::VectorXd time_s = Eigen::VectorXd::LinSpaced(3, 0.0, 0.02);
  Eigen::MatrixXd angles(3, 1);
  angles << 0.0, 0.5 * kPi, kPi;
  write_motion(arm, {time_s, {{"elbow_flexion", Unit::radian}}, angles}, folder / "m.mot", {});
  const recording::Storage file = recording::read_storage(folder / "m.mot");
  EXPECT_TRUE(file.in_degrees);
  EXPECT_NEAR(file.data.column("elbow_flexion")[1], 90.0, 1e-9);
}

TEST(WriteMarkerErrors, AMarkerThatWasMissingAndFramesWithoutAnyAreLeftOut) {
  const test::TemporaryFolder folder;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  body::IkResult ik;
  Eigen::MatrixXd values(3, 5);
  values << 1e-4, 0.007, 0.01, 0.01, 0.005,  //
      kNone, kNone, kNone, kNone, kNone,     //
      4e-4, 0.02, 0.02, 0.02, kNone;
  ik.errors = TimeSeries(Eigen::Vector3d(0.0, 0.01, 0.02),
                         {{"total_squared_error", Unit::dimensionless},
                          {"marker_error_RMS", Unit::meter},
                          {"marker_error_max", Unit::meter},
                          {"ELB", Unit::meter},
                          {"WRI", Unit::meter}},
                         values);
  write_marker_errors(ik, folder / "e.sto");
  const TimeSeries read = recording::read_storage(folder / "e.sto").data;
  ASSERT_EQ(read.sample_count(), 2);
  EXPECT_EQ(read.time_s()[1], 0.02);
  EXPECT_TRUE(read.find("ELB"));
  EXPECT_FALSE(read.find("WRI"));
}

}  // namespace
}  // namespace myoid::results
