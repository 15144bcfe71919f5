#include "myoid/pipeline/check_study.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/model/arm4.h"
#include "myoid/recording/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::pipeline {
namespace {

/// A study of one trial with markers and EMG of four channels that rise and fall.
struct WrittenStudy {
  test::TemporaryFolder folder;
  std::string text =
      "[emg]\nkind = \"envelope\"\n[[trial]]\nname = \"t\"\nmarkers = \"t.trc\"\nemg = "
      "\"t.sto\"\n";

  explicit WrittenStudy(const std::string& marker = "r_styloid_radial", bool flat = false) {
    for (const std::string muscle : {"BIC", "BRA", "BRD", "TRI"})
      text += fmt::format("[[muscle]]\nname = \"{0}\"\nemg = \"{0}\"\n", muscle);
    std::string trc = fmt::format(
        "PathFileType\t4\t(X/Y/Z)\tt.trc\n"
        "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\t"
        "OrigNumFrames\n100\t100\t200\t1\tm\t100\t1\t200\nFrame#\tTime\t{}\t\t\n\t\tX1\tY1\t"
        "Z1\n\n",
        marker);
    std::string emg = "EMG\nendheader\ntime\tBIC\tBRA\tBRD\tTRI\n";
    for (int i = 0; i < 200; ++i) {
      const double s = std::sin(0.05 * i);
      trc += fmt::format("{}\t{:.2f}\t0.3\t{:.4f}\t0\n", i + 1, 0.01 * i, 0.1 * s);
      emg += fmt::format("{:.2f}\t{:.4f}\t{:.4f}\t{:.4f}\t{:.4f}\n", 0.01 * i, s * s, s * s, s * s,
                         flat ? 0.2 : s * s);
    }
    recording::write_file(folder / "t.trc", trc);
    recording::write_file(folder / "t.sto", emg);
  }
  [[nodiscard]] std::vector<Finding> findings() const {
    return check_study(parse_study(text, folder / "study.toml"));
  }
  /// Text of the first finding if it is an error.
  [[nodiscard]] std::string error() const {
    const std::vector<Finding> all = findings();
    return all.empty() || all.front().level != Finding::Level::error
               ? "(no error)"
               : all.front().where + ": " + all.front().message;
  }
};

TEST(CheckStudy, FindsNoErrorWhereThereIsNone) { EXPECT_EQ(WrittenStudy().error(), "(no error)"); }

TEST(CheckStudy, NamesAMissingFileWithoutThrowing) {
  WrittenStudy study;
  study.text += "[[trial]]\nname = \"u\"\nmarkers = \"t.trc\"\nemg = \"nowhere.sto\"\n";
  EXPECT_NE(study.error().find("nowhere.sto"), std::string::npos) << study.error();
}

TEST(CheckStudy, MarkersOfWhichTheModelHasNoneAreAnError) {
  const WrittenStudy study("RWRA");
  EXPECT_NE(study.error().find("t: no marker of the recording (RWRA) is in the model"),
            std::string::npos)
      << study.error();
}

TEST(CheckStudy, AnEmgChannelThatNeverRisesIsAnError) {
  const WrittenStudy study("r_styloid_radial", true);
  EXPECT_NE(study.error().find("'TRI' never rises"), std::string::npos) << study.error();
}

TEST(CheckStudy, AWeightOfAMarkerThatTheModelLacksIsAnError) {
  WrittenStudy study;
  study.text += "[markers.weight]\nacromion = 10\n";
  EXPECT_NE(study.error().find("[markers.weight] acromion: the model has no such marker"),
            std::string::npos)
      << study.error();
}

TEST(CheckStudy, AWindowOfNormalisationLongerThanTheRecordingIsAnError) {
  WrittenStudy study;
  study.text.insert(study.text.find("[[trial]]"), "normalise_window_s = 30\n");
  EXPECT_NE(study.error().find("longer than every recording"), std::string::npos) << study.error();
}

TEST(CheckStudy, AStartThatTheModelPutsOutsideTheBoundsIsWarnedOf) {
  WrittenStudy study;
  std::string osim = model::arm4_osim();
  const std::string tag = "<optimal_fiber_length>";
  osim.replace(osim.find(tag), tag.size(), tag + "9");  // 9 m and some digits
  recording::write_file(study.folder / "arm.osim", osim);
  study.text += "[model]\nfile = \"arm.osim\"\n";
  const std::vector<Finding> findings = study.findings();
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Finding& f) {
    return f.level == Finding::Level::warning &&
           f.message.find("optimal_fiber_length") != std::string::npos &&
           f.message.find("lies outside 0.01 to 0.6") != std::string::npos;
  }));
}

}  // namespace
}  // namespace myoid::pipeline
