// Channels that are broken, asked for by name, or none at all, through the program.
#include <random>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// Four seconds of two muscles, of a sensor that measures nothing, and of one that lost a sample.
std::string emg_table() {
  std::mt19937_64 random(20261122);
  std::normal_distribution<double> noise;
  std::string text = "time,BIC [mV],FLAT [mV],TRI [mV],GAP [mV]\n";
  for (int i = 0; i < 4000; ++i) {
    const double effort = i < 1500 ? 0.01 : 0.5;
    text += fmt::format("{:.3f},{:.5f},0.25,{:.5f},{}\n", 1e-3 * i, effort * noise(random), effort * noise(random),
                        i == 2000 ? "" : fmt::format("{}", i % 7));
  }
  return text;
}

/// The cells of one column of a storage file.
std::string cells_of(const std::string& text, const std::string& name) {
  const auto cells = [](const std::string& line) {
    std::vector<std::string> list(1);
    for (const char c : line) {
      if (c == '\t') {
        list.emplace_back();
      } else {
        list.back() += c;
      }
    }
    return list;
  };
  std::string found;
  std::size_t at = text.find("\ntime\t") + 1;
  std::size_t wanted = 0;
  for (bool head = true; at < text.size(); head = false) {
    const std::size_t end = text.find('\n', at);
    const auto row = cells(text.substr(at, end - at));
    for (std::size_t c = 0; head && c < row.size(); ++c) wanted = row[c] == name ? c : wanted;
    if (!head) found += row[wanted] + "\n";
    at = end + 1;
  }
  return found;
}

TEST(Channels, ASensorThatNobodyNeedsIsLeftOutWithAWarning) {
  const TemporaryFolder folder;
  const std::string in = folder / "e.csv";
  const std::string out = folder / "a.sto";
  write_text(in, emg_table());
  const Finished finished = myoid({"emg", in, "--out", out});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.err, AllOf(HasSubstr("e.csv: channel 'FLAT' has the same value throughout"),
                                  HasSubstr("e.csv: channel 'GAP' is not a number at 2 s (1 sample)")));
  EXPECT_THAT(read_text(out), HasSubstr("\ntime\tBIC\tTRI\n"));
}

TEST(Channels, ThoseAskedForComeInTheirOrderAsIfThereWereNoOthers) {
  const TemporaryFolder folder;
  const std::string in = folder / "e.csv";
  const std::string two = folder / "two.sto";
  const std::string all = folder / "all.sto";
  write_text(in, emg_table());
  const Finished finished = myoid({"emg", in, "--out", two, "--no-whitening", "--channel", "TRI", "--channel", "bic"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.err, Not(HasSubstr("FLAT")));
  EXPECT_THAT(read_text(two), HasSubstr("\ntime\tTRI\tBIC\n"));
  ASSERT_EQ(myoid({"emg", in, "--out", all, "--no-whitening"}).exit_code, 0);
  for (const char* name : {"BIC", "TRI"})
    EXPECT_EQ(cells_of(read_text(two), name), cells_of(read_text(all), name)) << name;
}

TEST(Channels, OneThatIsNotThereOrBrokenAndAskedForIsAnError) {
  const TemporaryFolder folder;
  const std::string in = folder / "e.csv";
  write_text(in, emg_table());
  const auto refusal = [&](const char* command, const std::string& channel) {
    const Finished finished = std::string(command) == "emg"
                                  ? myoid({"emg", in, "--out", folder / "a.sto", "--channel", channel})
                                  : myoid({"convert", in, folder / "a.sto", "--channel", channel});
    EXPECT_EQ(finished.exit_code, 3) << command << " " << channel;
    return finished.err;
  };
  for (const char* command : {"emg", "convert"})
    EXPECT_THAT(refusal(command, "TRY"),
                AllOf(HasSubstr("e.csv: no channel 'TRY' (did you mean 'TRI'?)"), HasSubstr("BIC, FLAT, TRI, GAP")));
  EXPECT_THAT(refusal("emg", "FLAT"), HasSubstr("the same value throughout"));
  EXPECT_THAT(refusal("convert", "GAP"), HasSubstr("a .csv file holds them"));
}

TEST(Channels, AGapInOneOfThemStopsNothingElseOfAC3d) {
  const TemporaryFolder folder;
  write_text(folder / "a.trc",
             "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n"
             "100\t100\t2\t1\tmm\nFrame#\tTime\tA\n\t\tX1\tY1\tZ1\n1\t0\t1\t2\t3\n2\t0.01\t1\t2\t4\n");
  write_text(folder / "e.csv", "time,BIC [V],GAP [V]\n0,0.25,\n0.005,0.5,1.5\n0.01,1,1.5\n0.015,2,1.5\n");
  const std::string c3d = folder / "a.c3d";
  ASSERT_EQ(myoid({"convert", folder / "a.trc", c3d, "--analog", folder / "e.csv"}).exit_code, 0);
  const Finished finished = myoid({"convert", c3d, folder / "all"});
  ASSERT_EQ(finished.exit_code, 0) << finished.err;
  EXPECT_THAT(finished.err, HasSubstr("a.c3d: channel 'GAP' is not a number at 0 s (1 sample)"));
  EXPECT_THAT(read_text(folder / "all/a.trc"), HasSubstr("\n2\t0.01\t1\t2\t4\n"));
  EXPECT_THAT(read_text(folder / "all/a_analog.sto"), HasSubstr("\ntime\tBIC\n0\t0.25\n"));
  // A table holds the gap.
  ASSERT_EQ(myoid({"convert", c3d, folder / "b.csv"}).exit_code, 0);
  EXPECT_THAT(read_text(folder / "b.csv"), HasSubstr("\n0,0.25,\n0.005,0.5,1.5\n"));
}

TEST(Channels, ATableOfMarkersHasNoneAndInfoTellsItsMarkers) {
  const TemporaryFolder folder;
  const std::string in = folder / "q.tsv";
  write_text(in,
             "NO_OF_FRAMES\t2\nNO_OF_CAMERAS\t8\nNO_OF_MARKERS\t1\nFREQUENCY\t100\n"
             "NO_OF_ANALOG\t0\nANALOG_FREQUENCY\t0\nDESCRIPTION\t--\nDATA_INCLUDED\t3D\n"
             "MARKER_NAMES\tWRIST\n1\t2\t3\n4\t5\t6\n");
  const Finished text = myoid({"info", in});
  EXPECT_EQ(text.exit_code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("markers (1):\n  WRIST\n"));
  const Finished json = myoid({"info", "--json", in});
  EXPECT_EQ(json.exit_code, 0) << json.err;
  EXPECT_THAT(json.out, HasSubstr("\"name\": \"WRIST\""));
  const Finished emg = myoid({"emg", in, "--out", folder / "a.sto"});
  EXPECT_EQ(emg.exit_code, 3);
  EXPECT_THAT(emg.err, HasSubstr("q.tsv: this is a table of markers and holds no EMG"));
}

// Four channels that are flat alike in two files: one warning for each, not four.
TEST(Channels, FaultsThatAreAlikeAreSaidOnce) {
  const TemporaryFolder folder;
  std::mt19937_64 random(20261122);
  std::normal_distribution<double> noise;
  std::string text = "time,BIC [mV],A [mV],B [mV],C [mV],D [mV],ACC [g]\n";
  for (int i = 0; i < 4000; ++i) text += fmt::format("{:.3f},{:.5f},0,0,0,0,1\n", 1e-3 * i, noise(random));
  for (const char* name : {"one.csv", "two.csv"}) write_text(folder / name, text);
  const Finished done = myoid({"emg", folder / "one.csv", folder / "two.csv", "--out", folder / "out"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const auto count = [&](const std::string& words) {
    std::size_t found = 0;
    for (auto at = done.err.find(words); at != std::string::npos; at = done.err.find(words, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count("has the same value throughout"), 1U) << done.err;
  EXPECT_THAT(done.err, HasSubstr("(likewise in one.csv 'B', one.csv 'C', one.csv 'D', two.csv 'A' "
                                  "and 3 more)"));
}

TEST(Channels, OfSeveralClocksThoseThatAreNotTakenAreNamed) {
  const TemporaryFolder folder;
  std::string text = "X[s],EMG 1 [mV],X[s],EMG 2 [mV]\n";
  for (int i = 0; i < 400; ++i)
    text += fmt::format("{:.4f},{},{}\n", 5e-4 * i, i % 7, i < 200 ? fmt::format("{:.4f},{}", 1e-3 * i, i % 5) : ",");
  write_text(folder / "e.csv", text);
  const std::vector<std::string> emg{"emg", folder / "e.csv", "--out", folder / "a.sto", "--window", "0.05"};
  const Finished first = myoid(emg);
  const Finished converted = myoid({"convert", folder / "e.csv", folder / "e.sto"});
  for (const Finished& finished : {first, converted})
    EXPECT_THAT(finished.err, HasSubstr("only the channels of the first clock are taken, without EMG")) << finished.out;
}

}  // namespace
