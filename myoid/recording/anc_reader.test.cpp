#include "myoid/recording/anc_reader.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_signals.h"

#include "tests/support/data_folder.h"
#include "tests/support/whole_c3d.h"

namespace myoid::recording {
namespace {

constexpr const char* kSmall =
    "File_Type:\tAnalog R/C ASCII\tGeneration#:\t2\r\nBoard_Type:\tX\tPolarity:\tBipolar\r\n"
    "Trial_Name:\tt\tTrial#:\t1\tDuration(Sec.):\t0.002\t#Channels:\t2\r\n"
    "BitDepth:\t12\tPreciseRate:\t1000.0\r\n\r\nName\tEMG a\tEMG a\t\r\nRate\t1000\t1000\t\r\n"
    "Range\t1000\t10000\t\r\n0.000\t4095\t-4095\t\r\n0.001\t0\t819\t\r\n0.002\t1\r\n";

TEST(Anc, CountsBecomeVolts) {
  const AncFile file = parse_anc(kSmall, "a.anc");
  ASSERT_EQ(file.data.sample_count(), 2);  // the last row is cut off
  EXPECT_EQ(file.data.channels()[1], (Channel{"EMG a_2", Unit::volt}));
  EXPECT_DOUBLE_EQ(file.data.values()(0, 0), 2.0);  // the full span of ±1 V
  EXPECT_DOUBLE_EQ(file.data.values()(0, 1), -20.0);
  EXPECT_DOUBLE_EQ(file.data.values()(1, 1), 4.0);
}

TEST(Anc, NonsenseIsRefusedWithItsLine) {
  std::string text = kSmall;
  text.replace(text.find("819"), 3, "8x9");
  try {
    static_cast<void>(parse_anc(text, "a.anc"));
    FAIL();
  } catch (const ReadError& error) {
    EXPECT_EQ(error.line(), 10U);
  }
  EXPECT_THROW(static_cast<void>(parse_anc("Name\ta\n", "a.anc")), ReadError);
  text = kSmall;
  text.replace(text.find("BitDepth"), 8, "Bitdeath");
  EXPECT_THROW(static_cast<void>(parse_anc(text, "a.anc")), ReadError);
}

TEST(Anc, TheSameTrialAsC3dHoldsTheSameVolts) {
  const auto folder = test::data_folder();
  MYOID_REQUIRE_DATA(folder / "anc/Gait.anc");
  const AncFile anc = read_anc(folder / "anc/Gait.anc");
  const TimeSeries c3d = c3d_analog(read_c3d(folder / "c3d/others/Gait.c3d"));
  const Eigen::Index samples = std::min(anc.data.sample_count(), c3d.sample_count());
  ASSERT_GT(samples, 4000);
  // EMG from the 13th channel on; before it the C3D file is in N and N mm. Its scale has 24 bits.
  for (Eigen::Index c = 12; c < 28; ++c) {
    const double largest = c3d.values().col(c).cwiseAbs().maxCoeff();
    EXPECT_LT((anc.data.values().col(c).head(samples) - c3d.values().col(c).head(samples)).cwiseAbs().maxCoeff(),
              1e-7 * largest)
        << c;
  }
}

TEST(Anc, EveryFileOfTheCollectionIsReadOrRefusedClearly) {
  const auto folder = test::data_folder() / "anc";
  MYOID_REQUIRE_DATA(folder);
  EXPECT_EQ(read_anc(folder / "Res16bits.anc").data.channel_count(), 81);
  EXPECT_EQ(read_anc(test::data_folder() / "gait-emg/emg_walk_raw.anc").data.channel_count(), 28);
  EXPECT_THROW(static_cast<void>(read_anc(folder / "Empty.anc")), ReadError);
  const AncFile truncated = read_anc(folder / "Truncated.anc");
  EXPECT_EQ(truncated.data.sample_count(), 5);
  EXPECT_NE(truncated.repairs[0].message.find("cut off"), std::string::npos);
}

}  // namespace
}  // namespace myoid::recording
