// Recordings there and back again through the program.
#include <filesystem>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/recording/c3d/c3d_writer.h"

#include "program.h"
#include "tests/support/plate_recording.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;

const std::string kTrc =
    "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\t"
    "OrigDataRate\tOrigDataStartFrame\tOrigNumFrames\n100\t100\t4\t2\tmm\t100\t1\t4\n"
    "Frame#\tTime\tA\t\t\tB\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n\n"
    "1\t0\t1.5\t2.5\t3.5\t10\t20\t30\n2\t0.01\t1.25\t2.25\t3.25\t\t\t\n"
    "3\t0.02\t1\t2\t3\t11\t21\t31\n4\t0.03\t-1\t-2\t-3\t12\t22\t32\n";

TEST(Convert, MarkersAndEmgGoIntoAC3dAndComeBack) {
  const TemporaryFolder folder;
  write_text(folder / "a.trc", kTrc);
  write_text(folder / "e.csv",
             "time,Biceps [mV]\n0,1\n0.005,2\n0.01,3\n0.015,4\n0.02,5\n0.025,6\n"
             "0.03,7\n0.035,8\n");
  const std::string c3d = (folder / "a.c3d").string();
  const Finished there = myoid({"convert", (folder / "a.trc").string(), c3d, "--analog", (folder / "e.csv").string()});
  ASSERT_EQ(there.exit_code, 0) << there.err;
  const Finished back = myoid({"convert", c3d, (folder / "b.trc").string()});
  ASSERT_EQ(back.exit_code, 0) << back.err;
  // These numbers are exact in 32 bits; only the name in the first line differs.
  std::string expected = kTrc;
  expected.replace(expected.find("a.trc"), 5, "b.trc");
  const auto rows = [](const std::string& text) { return text.substr(text.find("\n1\t0\t")); };
  EXPECT_EQ(rows(read_text(folder / "b.trc")), rows(expected));
  const Finished emg = myoid({"convert", c3d, (folder / "b.csv").string()});
  ASSERT_EQ(emg.exit_code, 0) << emg.err;
  EXPECT_THAT(read_text(folder / "b.csv"), HasSubstr("time_s,Biceps [V]\n0,0.001"));
  const Finished again = myoid({"convert", c3d, (folder / "b.csv").string()});
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_THAT(again.err, HasSubstr("--overwrite"));
}

/// A set of OpenSim 2.3.2: its present form has <appliesForce> in place of <isDisabled>.
const std::string kOldSet =
    "<OpenSimDocument Version=\"20302\"><ForceSet><objects><CoordinateActuator name=\"r\"><isDisabled>false"
    "</isDisabled><coordinate>q</coordinate></CoordinateActuator></objects></ForceSet></OpenSimDocument>";

TEST(Convert, AnOpenSimFileIsToldByItsEndingOrItsContent) {
  const TemporaryFolder folder;
  for (const auto& [from, to] : {std::pair{"old.osim", "a.osim"}, {"old.xml", "b.xml"}, {"old.bak", "c"}}) {
    write_text(folder / from, kOldSet);
    const Finished done = myoid({"convert", folder / from, folder / to, "--json"});
    EXPECT_EQ(done.exit_code, 0) << from << done.err;
    EXPECT_THAT(done.out, HasSubstr("\"old_version\": 20302")) << from;
    EXPECT_THAT(read_text(folder / to), HasSubstr("<appliesForce>true</appliesForce>")) << from;
    EXPECT_THAT(read_text(folder / to), HasSubstr("<OpenSimDocument Version=\"40500\">")) << from;
    EXPECT_EQ(myoid({"convert", folder / from, folder / to}).exit_code, 3) << "it is there already";
    EXPECT_EQ(myoid({"convert", folder / from, folder / from, "--overwrite"}).exit_code, 3) << "it is the input";
    EXPECT_EQ(read_text(folder / from), kOldSet);
  }
  write_text(folder / "a.trc", kTrc);
  EXPECT_EQ(myoid({"convert", folder / "old.osim", folder / "a.mot"}).exit_code, 3) << "the name of a recording";
  EXPECT_EQ(myoid({"convert", folder / "a.trc", folder / "new.osim"}).exit_code, 3) << "markers make no model";
  EXPECT_EQ(myoid({"convert", folder.path(), folder / "new.osim"}).exit_code, 3) << "a folder makes no model";
  EXPECT_FALSE(std::filesystem::exists(folder / "new.osim") || std::filesystem::exists(folder / "a.mot"));
  const Finished idle = myoid({"convert", folder / "old.osim", folder / "d.osim", "--what", "emg", "--end", "1"});
  EXPECT_EQ(idle.exit_code, 0);
  EXPECT_THAT(idle.err, testing::MatchesRegex("warning: --what [^\n]*\nwarning: --end [^\n]*\n"));
}

TEST(Convert, TurnsTheLaboratory) {
  const TemporaryFolder folder;
  write_text(folder / "a.trc", kTrc);
  const std::string out = (folder / "b.trc").string();
  ASSERT_EQ(myoid({"convert", (folder / "a.trc").string(), out, "--up", "z"}).exit_code, 0);
  EXPECT_THAT(read_text(out), HasSubstr("\n1\t0\t1.5\t3.5\t-2.5\t10\t30\t-20\n"));
  ASSERT_EQ(
      myoid({"convert", (folder / "a.trc").string(), out, "--overwrite", "--up", "z", "--rotate", "y:90"}).exit_code,
      0);
  EXPECT_THAT(read_text(out), HasSubstr("\n1\t0\t-2.5\t3.5\t-1.5\t"));
  const Finished wrong = myoid({"convert", (folder / "a.trc").string(), out, "--overwrite", "--rotate", "q:90"});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_THAT(wrong.err, HasSubstr("AXIS:DEGREES"));
}

TEST(Convert, AUnitThatTheFileContradictsIsNotUsedAndThatIsSaid) {
  const TemporaryFolder folder;
  write_text(folder / "a.trc", kTrc);
  std::string emg = "EMG uV\nendheader\ntime\tBIC\n";
  for (int i = 0; i < 8; ++i) emg += std::to_string(0.005 * i) + "\t" + std::to_string(i) + "\n";
  write_text(folder / "e.sto", emg);
  const Finished done =
      myoid({"convert", folder / "a.trc", folder / "a.c3d", "--analog", folder / "e.sto", "--unit", "mV"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.err, HasSubstr("the unit given (mV) is not used"));
}

TEST(Convert, TheFolderOfARunBecomesAFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directories(folder / "results");
  const Finished done = myoid({"convert", folder / "results", folder / "out.c3d"});
  EXPECT_EQ(done.exit_code, 3);
  EXPECT_THAT(done.err, HasSubstr("a folder too"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out.c3d"));
}

TEST(Convert, EveryPlateNeedsABodyOrNone) {
  const TemporaryFolder folder;
  const std::string file = folder / "f.c3d";
  ::myoid::recording::write_c3d(file, ::myoid::test::plate_recording(2));
  for (const char* body : {"calcn_r", ""}) {
    const Finished one = myoid({"convert", file, folder / (std::string("one") + body), "--body", body});
    EXPECT_EQ(one.exit_code, 0) << one.err;
  }
  const Finished two = myoid({"convert", file, folder / "two", "--body", "calcn_r", "--body", "calcn_l"});
  EXPECT_EQ(two.exit_code, 3);
  EXPECT_THAT(two.err, HasSubstr("--body: 2 bodies for 1 force plate of"));
  EXPECT_FALSE(std::filesystem::exists(folder / "two"));
  const Finished none = myoid({"convert", file, folder / "f.mot", "--what", "plates"});
  EXPECT_EQ(none.exit_code, 0) << none.err;
}

TEST(Convert, WhatCannotBeWrittenIsSaid) {
  const TemporaryFolder folder;
  write_text(folder / "a.trc", kTrc);
  const std::string in = (folder / "a.trc").string();
  for (const char* out : {"b.xyz", "b.sto"}) {
    const Finished result = myoid({"convert", in, (folder / out).string()});
    EXPECT_EQ(result.exit_code, 3) << out;
    EXPECT_FALSE(std::filesystem::exists(folder / out));
  }
}

}  // namespace
