#include "myoid/recording/recording.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/c3d/c3d_writer.h"
#include "myoid/recording/c3d/make_c3d.h"
#include "myoid/recording/emg_reader.h"

#include "tests/support/data_folder.h"
#include "tests/support/message_of.h"
#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

TEST(Recording, ARealC3dGivesMarkersAndEmgOnOneClock) {
  const auto path = test::data_folder() / "box-lift/markers_analogs.c3d";
  MYOID_REQUIRE_DATA(path);
  const Recording recording = read_recording(path);
  EXPECT_EQ(recording.markers.marker_count(), 51);
  EXPECT_EQ(recording.markers.frame_count(), 580);
  EXPECT_EQ(recording.analog.sample_count(), 11600);
  EXPECT_EQ(recording.analog.time_s()[0], recording.markers.time_s[0]);
  EXPECT_EQ(recording.analog.channels()[16], (Channel{"Biceps.EMG4", Unit::volt}));
  EXPECT_TRUE(recording.plates.empty());
  EXPECT_EQ(read_markers(path).markers.names, recording.markers.names);
  const EmgFile emg = read_emg(path, "", false);
  EXPECT_EQ(emg.data.channel_count(), 38);
}

TEST(Recording, EmgOfAC3dAreItsVoltages) {
  const auto path = test::data_folder() / "c3d/others/Gait.c3d";
  MYOID_REQUIRE_DATA(path);
  const EmgFile emg = read_emg(path, "", false);
  EXPECT_EQ(emg.data.channel_count(), 16);
  EXPECT_EQ(emg.data.channels()[0].name, "LREC");
  const Recording all = read_recording(path);
  EXPECT_EQ(all.plates.size(), 2U);
  EXPECT_EQ(all.analog.channel_count(), 28);
}

TEST(Recording, WhatIsNotThereOrNotKnownIsAReadError) {
  const test::TemporaryFolder folder;
  MarkerSeries none;
  const TimeSeries analog(Eigen::VectorXd::LinSpaced(10, 0.0, 0.9), {{"F", Unit::newton}},
                          Eigen::MatrixXd::Ones(10, 1));
  write_c3d(folder / "analog.c3d", make_c3d(none, analog));
  EXPECT_THROW(static_cast<void>(read_markers(folder / "analog.c3d")), ReadError);
  EXPECT_THROW(static_cast<void>(read_emg(folder / "analog.c3d", "", false)), ReadError);
  EXPECT_EQ(read_recording(folder / "analog.c3d").analog.channel_count(), 1);
  std::ofstream(folder / "a.xyz") << "?";
  EXPECT_THROW(static_cast<void>(read_recording(folder / "a.xyz")), ReadError);
  EXPECT_THROW(static_cast<void>(read_markers(folder / "a.xyz")), ReadError);
}

TEST(RefuseFolder, TheNextCommandFollowsFromWhatTheFolderHolds) {
  const test::TemporaryFolder folder;
  const auto message = [&] { return test::message_of([&] { refuse_folder(folder.path()); }); };
  EXPECT_EQ(message().find("myoid "), std::string::npos) << message();
  std::filesystem::create_directory(folder / "day");
  for (const char* name : {"day/b.trc", "day/a.trc"}) std::ofstream(folder / name) << "x";
  const std::string check = "myoid check " + folder.path().string();
  EXPECT_THAT(message(), testing::AllOf(testing::HasSubstr(check + "/day/a.trc"), testing::HasSubstr("of 2"),
                                        testing::HasSubstr("myoid init STUDY --from " + folder.path().string())));
  std::ofstream(folder / "study.toml") << "x";
  EXPECT_THAT(message(),
              testing::AllOf(testing::HasSubstr(check + "/study.toml"), testing::Not(testing::HasSubstr("init"))));
}

}  // namespace
}  // namespace myoid::recording
