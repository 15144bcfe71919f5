#include "myoid/pipeline/recording_contents.h"

#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/recording/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::pipeline {
namespace {

TEST(RecordingContents, OfASeriesItTellsTimesUnitsExtremesAndGaps) {
  const test::TemporaryFolder folder;
  recording::write_file(folder / "e.csv", "time,BIC [mV],TRI [mV]\n0,1,2\n0.01,-3,\n0.02,2,4\n");
  const auto contents = recording_contents(folder / "e.csv");
  ASSERT_TRUE(contents);
  EXPECT_EQ(contents->at("samples"), 3);
  EXPECT_NEAR(contents->at("rate_hz").get<double>(), 100.0, 1e-9);
  EXPECT_EQ(contents->at("channels").at(0).at("unit"), "V");
  EXPECT_NEAR(contents->at("channels").at(0).at("lowest").get<double>(), -0.003, 1e-12);
  EXPECT_EQ(contents->at("channels").at(1).at("gaps"), 1);
}

TEST(RecordingContents, ATableWithoutAClockIsToldByItsColumnsAndWhyItIsNoRecording) {
  const test::TemporaryFolder folder;
  recording::write_file(folder / "m.csv", "muscle,l0\nBIC,0.12\n");
  const auto contents = recording_contents(folder / "m.csv");
  ASSERT_TRUE(contents);
  EXPECT_EQ(contents->at("rows"), 1);
  EXPECT_EQ(contents->at("columns").at(1), "l0");
  EXPECT_TRUE(contents->contains("no_recording"));
}

TEST(RecordingContents, OfOtherNamesThereIsNothingAndAMissingFileIsAnError) {
  EXPECT_FALSE(recording_contents("arm.osim"));
  EXPECT_THROW((void)recording_contents("/nowhere/e.sto"), ReadError);
}

}  // namespace
}  // namespace myoid::pipeline
