#include "myoid/study/checks/check_study.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/study/checks/check_file.h"
#include "myoid/study/read_study.h"

#include "tests/support/data_folder.h"
#include "tests/support/temporary_folder.h"

namespace myoid::study {
namespace {

/// A study of one trial with markers and EMG of four channels that rise and fall.
struct WrittenStudy {
  test::TemporaryFolder folder;
  std::string text =
      "[emg]\nkind = \"envelope\"\n[ik]\nlock = [\"shoulder_flexion\", \"shoulder_adduction\", \"shoulder_rotation\"]\n"
      "[[trial]]\nname = \"t\"\nmarkers = \"t.trc\"\nemg = \"t.sto\"\n";

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
      emg += fmt::format("{:.2f}\t{:.4f}\t{:.4f}\t{:.4f}\t{:.4f}\n", 0.01 * i, s * s, s * s, s * s, flat ? 0.2 : s * s);
    }
    write_file(folder / "t.trc", trc);
    write_file(folder / "t.sto", emg);
  }
  [[nodiscard]] std::vector<Remark> findings() const { return check_study(parse_study(text, folder / "study.toml")); }
  /// Text of the first finding if it is an error.
  [[nodiscard]] std::string error() const {
    const std::vector<Remark> all = findings();
    return all.empty() || all.front().severity != Severity::error ? "(no error)"
                                                                  : all.front().where + ": " + sentence(all.front());
  }
};

TEST(CheckStudy, FindsNoErrorWhereThereIsNone) { EXPECT_EQ(WrittenStudy().error(), "(no error)"); }

TEST(CheckStudy, ASettingOfAnEarlierVersionIsSaidToHaveNoEffect) {
  const auto said = [](const std::string& more) {
    WrittenStudy study;
    study.text += more;
    const std::vector<Remark> all = study.findings();
    return std::any_of(all.begin(), all.end(), [](const Remark& r) {
      return r.severity == Severity::warning && r.says.find("has no effect") != std::string::npos;
    });
  };
  for (const char* setting : {"estimator = \"least_squares\"", "priors = false", "force_loop = true",
                              "loss = \"huber\"", "bootstrap = 0", "profile = false", "max_rate_hz = 50"})
    EXPECT_TRUE(said(std::string("[identify]\n") + setting + "\n")) << setting;
  EXPECT_FALSE(said(""));
}

TEST(CheckStudy, NamesAMissingFileWithoutThrowing) {
  WrittenStudy study;
  study.text += "[[trial]]\nname = \"u\"\nmarkers = \"t.trc\"\nemg = \"nowhere.sto\"\n";
  EXPECT_NE(study.error().find("nowhere.sto"), std::string::npos) << study.error();
}

TEST(CheckStudy, AMisspeltChannelOfEveryTrialIsToldOnceWithTheTrialsNamed) {
  WrittenStudy study;
  for (const char* name : {"u", "v"})
    study.text += fmt::format("[[trial]]\nname = \"{}\"\nmarkers = \"t.trc\"\nemg = \"t.sto\"\n", name);
  study.text.replace(study.text.find("emg = \"TRI\""), 11, "emg = \"TRJ\"");
  const std::vector<Remark> findings = study.findings();
  EXPECT_EQ(
      std::count_if(findings.begin(), findings.end(), [](const Remark& f) { return f.severity == Severity::error; }),
      1);
  EXPECT_EQ(findings.front().likewise, (std::vector<std::string>{"u", "v"}));
}

TEST(CheckStudy, MarkersOfWhichTheModelHasNoneAreAnError) {
  const WrittenStudy study("RWRA");
  EXPECT_NE(study.error().find("(RWRA)"), std::string::npos) << study.error();
}

TEST(CheckStudy, OneRecordingInTwoTrialsIsAnErrorThatNamesBoth) {
  WrittenStudy study;
  study.text += "[[trial]]\nname = \"u\"\nmarkers = \"t.trc\"\nemg = \"t.sto\"\n";
  const Remark first = study.findings().front();
  EXPECT_EQ(first.code, RemarkCode::same_recording);
  EXPECT_EQ(first.severity, Severity::error);
  EXPECT_EQ(first.where, "u");
  EXPECT_NE(first.says.find("'t'"), std::string::npos) << first.says;
}

TEST(CheckStudy, TrialsThatAreWindowsOfOneRecordingAreTwo) {
  WrittenStudy study;
  study.text.replace(study.text.find("name = \"t\""), 10, "name = \"t\"\nend_s = 1.0");
  study.text += "[[trial]]\nname = \"u\"\nmarkers = \"t.trc\"\nemg = \"t.sto\"\nstart_s = 1.0\n";
  EXPECT_EQ(study.error(), "(no error)");
}

TEST(CheckStudy, ATrialOfLessThanHalfASecondIsNamedAsSuch) {
  WrittenStudy study;
  study.text.replace(study.text.find("name = \"t\""), 10, "name = \"t\"\nstart_s = 1.0\nend_s = 1.3");
  EXPECT_NE(study.error().find("0.3 s (1 to 1.3 s)"), std::string::npos) << study.error();
}

TEST(CheckStudy, AnEmgChannelThatNeverRisesIsAnError) {
  const WrittenStudy study("r_styloid_radial", true);
  EXPECT_NE(study.error().find("'TRI' never rises"), std::string::npos) << study.error();
}

TEST(CheckStudy, RawEmgCalledAnEnvelopeIsAnError) {
  WrittenStudy study;
  std::string emg = read_text_file(study.folder / "t.sto");
  for (std::size_t at = emg.find("\t0."); at != std::string::npos; at = emg.find("\t0.", at + 1))
    if ((at / 7) % 2 == 0) emg.insert(at + 1, "-");
  write_file(study.folder / "t.sto", emg);
  EXPECT_NE(study.error().find("raw EMG"), std::string::npos) << study.error();
}

TEST(CheckStudy, AnActivationInPercentIsAnError) {
  WrittenStudy study;
  study.text.replace(study.text.find("\"envelope\""), 10, "\"activation\"");
  EXPECT_EQ(study.error(), "(no error)");
  std::string emg = "EMG\nendheader\ntime\tBIC\tBRA\tBRD\tTRI\n";
  for (int i = 0; i < 200; ++i) emg += fmt::format("{:.2f}\t{}\t5\t5\t5\n", 0.01 * i, i % 90);
  write_file(study.folder / "t.sto", emg);
  EXPECT_NE(study.error().find("'BIC' reaches 89"), std::string::npos) << study.error();
}

TEST(CheckStudy, WhatInitLeftToBeAnsweredIsAWarningWithItsLine) {
  WrittenStudy study;
  const auto asked = [&] {
    write_file(study.folder / "study.toml", study.text);
    for (const Remark& f : study.findings()) {
      if (f.code == RemarkCode::unanswered) return f.says;
    }
    return std::string();
  };
  EXPECT_EQ(asked(), "");
  study.text = "# Lines with TODO want an answer\n# TODO: the person's mass\n" + study.text;
  EXPECT_NE(asked().find("line 2: "), std::string::npos) << asked();
}

TEST(CheckStudy, EnvelopesWithoutAMaximalContractionAreSaidToBeSo) {
  const std::vector<Remark> found = WrittenStudy().findings();
  EXPECT_EQ(std::ranges::count(found, RemarkCode::no_maximal_contraction, &Remark::code), 1);
}

TEST(CheckStudy, AWeightOfAMarkerThatTheModelLacksIsAnError) {
  WrittenStudy study;
  study.text += "[markers.weight]\nacromion = 10\n";
  EXPECT_NE(study.error().find("[markers.weight] acromion"), std::string::npos) << study.error();
}

TEST(CheckStudy, AWindowOfNormalisationLongerThanTheRecordingIsAnError) {
  WrittenStudy study;
  study.text.insert(study.text.find("[ik]"), "normalise_window_s = 30\n");
  EXPECT_NE(study.error().find("longer than every recording"), std::string::npos) << study.error();
}

TEST(CheckStudy, TellsEveryFaultOfAChannelWithItsNameAndTime) {
  const WrittenStudy study;
  std::string trc = read_text_file(study.folder / "t.trc");
  const std::string frame = "101\t1.00\t0.3\t";
  ASSERT_NE(trc.find(frame), std::string::npos);
  trc.replace(trc.find(frame), frame.size(), "101\t1.00\t0.4\t");
  write_file(study.folder / "t.trc", trc);
  bool jump = false;
  for (const Remark& f : study.findings()) {
    if (f.code != RemarkCode::marker_jump) continue;
    jump = true;
    EXPECT_EQ(f.severity, Severity::warning);
    EXPECT_EQ(f.about, "r_styloid_radial");
    EXPECT_NEAR(f.when->begin_s, 1.0, 0.021);
  }
  EXPECT_TRUE(jump);
}

TEST(CheckRecording, LooksAtASingleFile) {
  const test::TemporaryFolder folder;
  std::string text = "time,a [V],b [V]\n";
  for (int i = 0; i < 4000; ++i) {
    const double effort = i < 2000 ? 0.02 : 1.0;
    const double noise = ((i * 7919) % 2003) / 2003.0 - 0.5;
    const double hum = std::sin(2.0 * 3.14159265358979 * 50.0 * 0.001 * i);
    text += fmt::format("{:.3f},{:.9f},{:.9f}\n", 0.001 * i, 1e-4 * effort * noise,
                        1e-4 * effort * ((i * 104729) % 4001) / 4001.0 + 1e-4 * hum);
  }
  write_file(folder / "emg.csv", text);
  const std::vector<Remark> findings = check_recording(folder / "emg.csv");
  const auto hum = std::ranges::find(findings, RemarkCode::emg_hum, &Remark::code);
  ASSERT_NE(hum, findings.end());
  EXPECT_EQ(hum->about, "b");
  EXPECT_EQ(hum->severity, Severity::note);  // notches take it out
  EXPECT_TRUE(std::ranges::none_of(findings, [](const Remark& f) { return f.severity == Severity::warning; }));
}

std::vector<Remark> warnings_of(const std::filesystem::path& file) {
  std::vector<Remark> findings = check_recording(file);
  std::erase_if(findings, [](const Remark& f) { return f.severity != Severity::warning; });
  return findings;
}

TEST(CheckRecording, AFileWithFewerRowsThanItStatesIsAWarningInEveryFormat) {
  const test::TemporaryFolder folder;
  for (const int said : {20, 25}) {
    std::string rows, frames;
    for (int i = 0; i < 20; ++i) {
      rows += fmt::format("{:.2f}\t{:.3f}\n", 0.01 * i, 0.1 * i);
      frames += fmt::format("{}\t{:.2f}\t1.{}\t2\t3\n", i + 1, 0.01 * i, i);
    }
    write_file(folder / "f.sto",
               fmt::format("f\nnRows={}\nnColumns=2\ninDegrees=yes\nendheader\ntime\tq\n", said) + rows);
    write_file(folder / "f.trc",
               fmt::format("PathFileType\t4\t(X/Y/Z)\tf.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n"
                           "100\t100\t{}\t1\tm\nFrame#\tTime\ta\n\t\tX1\tY1\tZ1\n\n",
                           said) +
                   frames);
    for (const char* name : {"f.sto", "f.trc"})
      EXPECT_EQ(std::ranges::count(warnings_of(folder / name), RemarkCode::reading, &Remark::code), said > 20 ? 1 : 0)
          << name << " of " << said;
  }
}

/// Returns the errors of `check` for a file of 200 rows at 100 Hz whose columns all are `value`, a function of the
/// time.
template <typename Value>
std::size_t errors_of_motion(const std::string& head, const std::string& names, const Value& value) {
  const test::TemporaryFolder folder;
  std::string text = head + "endheader\ntime\t" + names + "\n";
  const auto columns = std::ranges::count(names, '\t') + 1;
  for (int i = 0; i < 200; ++i) {
    text += fmt::format("{:.2f}", 0.01 * i);
    for (auto c = columns; c > 0; --c) text += fmt::format("\t{:.6g}", value(0.01 * i));
    text += "\n";
  }
  write_file(folder / "a.sto", text);
  const std::vector<Remark> found = check_motion_file(folder / "a.sto", nullptr);
  return static_cast<std::size_t>(
      std::ranges::count(found, Severity::error, [](const Remark& remark) { return remark.severity; }));
}

// An impact changes a joint's speed by 4000 deg/s within 0.01 s, and a force by 400 N.
TEST(CheckMotion, SpeedsAndForcesOfAFileInDegreesAreNoAngles) {
  const auto fast = [](double t) { return 4000.0 * std::sin(40.0 * t); };
  const std::string head = "version=1\ninDegrees=yes\n";
  EXPECT_EQ(errors_of_motion("Coordinates\n" + head, "knee_angle_r\thip_flexion_r", fast), 1U);
  EXPECT_EQ(errors_of_motion("slow speed\n" + head, "knee_angle_r\thip_flexion_r", fast), 1U);
  EXPECT_EQ(errors_of_motion("Speeds\n" + head, "knee_angle_r\thip_flexion_r", fast), 0U);
  EXPECT_EQ(errors_of_motion("Accelerations\n" + head, "calcn_r_X\tcalcn_r_Ox", fast), 0U);
  EXPECT_EQ(errors_of_motion("walk\n" + head, "rfx\trfy\trfz\trcx\trcy\trcz", fast), 0U);
  EXPECT_EQ(errors_of_motion("states\n" + head, "/jointset/knee_r/knee_angle_r/speed", fast), 0U);
}

// OpenSim writes `inDegrees=no` into every file, and its plots into one with angles in degrees.
TEST(CheckMotion, DegreesUnderTheNameOfAnAngleAreNoRadians) {
  const auto bends = [](double t) { return 60.0 + 50.0 * std::sin(0.5 * t); };
  const std::string head = "UNKNOWN\nversion=1\ninDegrees=no\n";
  EXPECT_EQ(errors_of_motion(head, "knee_angle_r\tvas_int_r", bends), 1U);
  EXPECT_EQ(errors_of_motion(head, "vas_int_r\tflex_dig_r", bends), 0U);
  EXPECT_EQ(errors_of_motion(head, "knee_angle_r_moment\thip_flexion_r_moment", bends), 0U);
  EXPECT_EQ(errors_of_motion(head, "/jointset/knee_r/knee_angle_r/speed", bends), 0U);
}

// Inverse dynamics of some programs names a torque as its coordinate; the weight stands under the pelvis' height.
TEST(CheckMotion, TorquesNamedAsCoordinatesAreNoAngles) {
  const auto torque = [](double t) { return 120.0 + 50.0 * std::sin(0.5 * t); };
  const std::string head = "UNKNOWN\nversion=1\ninDegrees=no\n";
  EXPECT_EQ(errors_of_motion(head, "pelvis_tilt", torque), 1U);
  EXPECT_EQ(errors_of_motion(head, "pelvis_tilt\tpelvis_ty", torque), 0U);
}

TEST(CheckRecording, NoiseAloneIsNoEmg) {
  const test::TemporaryFolder folder;
  std::string text = "time,a [mV]\n";
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 0.3);
  for (int i = 0; i < 4000; ++i) text += fmt::format("{:.3f},{:.9f}\n", 0.001 * i, normal(random));
  write_file(folder / "emg.csv", text);
  const std::vector<Remark> found = warnings_of(folder / "emg.csv");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, RemarkCode::emg_low_signal);
  EXPECT_LT(*found[0].value, 2.0);
}

/// EMG at 1 kHz with rest and efforts; `time_of` gives the time of a sample.
template <typename TimeOf>
std::string emg_text(int samples, const TimeOf& time_of) {
  std::string text = "time,EMG [mV]\n";
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int i = 0; i < samples; ++i)
    text += fmt::format("{:.4f},{:.9f}\n", time_of(i), (i / 1000 % 2 == 0 ? 0.003 : 0.3) * normal(random));
  return text;
}

TEST(CheckRecording, OfOneThatPausesTheLongestPartIsChecked) {
  const test::TemporaryFolder folder;
  write_file(folder / "emg.csv", emg_text(7000, [](int i) { return 0.001 * i + (i < 3000 ? 0.0 : 2.0); }));
  const std::vector<Remark> found = warnings_of(folder / "emg.csv");
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].code, RemarkCode::clock_pause);
  EXPECT_EQ(found[0].where, "emg.csv");
  EXPECT_NE(found[0].says.find("5 to 8.999 s"), std::string::npos) << found[0].says;
}

TEST(CheckRecording, AClockThatMayCountMillisecondsIsAWarning) {
  const test::TemporaryFolder folder;
  std::string text = "time,BIC [mV]\n";
  for (int i = 0; i < 400; ++i) text += fmt::format("{},{}\n", i, (i * 37) % 11 - 5);
  write_file(folder / "a.csv", text);
  const auto findings = check_recording(folder / "a.csv");
  EXPECT_EQ(std::ranges::count_if(findings,
                                  [](const Remark& remark) {
                                    return remark.code == RemarkCode::clock_drift &&
                                           remark.severity == Severity::warning;
                                  }),
            1);
  EXPECT_EQ(std::ranges::count(findings, Severity::error, &Remark::severity), 1);
}

TEST(CheckRecording, ARateThatTheTimesContradictIsAWarningInEveryFormat) {
  const test::TemporaryFolder folder;
  for (const int said_hz : {100, 80}) {
    std::string rows, frames, counts;
    for (int i = 0; i < 400; ++i) {
      rows += fmt::format("{:.2f},{}\n", 0.01 * i, (i * 37) % 11 - 5);
      counts += fmt::format("{:.2f}\t{}\n", 0.01 * i, (i * 37) % 11 - 5);
      frames += fmt::format("{}\t{:.2f}\t1.{}\t2\t3\n", i + 1, 0.01 * i, i);
    }
    write_file(folder / "f.csv", fmt::format("# rate = {} Hz\ntime,BIC [mV]\n", said_hz) + rows);
    write_file(folder / "f.trc",
               fmt::format("PathFileType\t4\t(X/Y/Z)\tf.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n"
                           "{0}\t{0}\t400\t1\tm\nFrame#\tTime\ta\n\t\tX1\tY1\tZ1\n\n",
                           said_hz) +
                   frames);
    write_file(folder / "f.anc",
               fmt::format("File_Type:\tAnalog R/C ASCII\tGeneration#:\t1\nBoard_Type:\tNational\tPolarity:\tBipolar\n"
                           "Trial_Name:\tf\tTrial#:\t1\tDuration(Sec.):\t4.0\t#Channels:\t1\n"
                           "BitDepth:\t16\tPreciseRate:\t{}\n\n\n\n\nName\tBIC\nRate\t100\nRange\t5000\n",
                           said_hz) +
                   counts);
    for (const char* name : {"f.csv", "f.trc", "f.anc"})
      EXPECT_EQ(std::ranges::count(warnings_of(folder / name), RemarkCode::clock_drift, &Remark::code),
                said_hz == 80 ? 1 : 0)
          << name << " of " << said_hz;
  }
}

TEST(CheckRecording, UnevenSamplesAreAnErrorOfTheFile) {
  const test::TemporaryFolder folder;
  write_file(folder / "emg.csv", emg_text(4000, [](int i) { return 0.001 * i + 0.0003 * (i % 2); }));
  const std::vector<Remark> found = check_recording(folder / "emg.csv");
  const auto fault = std::ranges::find(found, Severity::error, &Remark::severity);
  ASSERT_NE(fault, found.end());
  EXPECT_EQ(fault->code, RemarkCode::clock_uneven);
  EXPECT_EQ(fault->where, "emg.csv");
}

TEST(CheckRecording, DegreesUnderAHeaderThatSaysRadiansAreAnError) {
  const test::TemporaryFolder folder;
  for (const double largest : {3.0, 36.0}) {
    std::string text = "time [s],elbow_flexion [rad],knee_angle [deg]\n";
    for (int i = 0; i <= 100; ++i) text += fmt::format("{:.2f},{:.4f},{:.4f}\n", 0.01 * i, 0.01 * largest * i, 0.9 * i);
    write_file(folder / "q.csv", text);
    const std::vector<Remark> found = check_recording(folder / "q.csv");
    const bool doubted = std::ranges::any_of(found, [](const Remark& remark) {
      return remark.code == RemarkCode::unit_doubtful && remark.severity == Severity::error;
    });
    EXPECT_EQ(doubted, largest > 4.0 * kPi);
  }
}

TEST(CheckRecording, OneSampleIsNoRecording) {
  const test::TemporaryFolder folder;
  write_file(folder / "emg.csv", "time,a [mV]\n0,1\n");
  try {
    (void)check_recording(folder / "emg.csv");
    FAIL() << "not refused";
  } catch (const ReadError& error) {
    EXPECT_NE(std::string(error.what()).find("only 1 sample"), std::string::npos) << error.what();
  }
}

/// Recordings of three laboratories with known faults: markers hidden for a long time, electrodes that were not worn.
TEST(CheckRecording, OfRealRecordingsOnlyWhatIsTrueIsSaid) {
  const std::filesystem::path data = test::data_folder();
  MYOID_REQUIRE_DATA(data / "elbow-emg" / "load5p5_T1_emg_raw_uV.sto");
  for (const std::string trial :
       {"load2p75_T1", "load2p75_T2", "load2p75_T3", "load5p5_T1", "load5p5_T2", "load5p5_T3"}) {
    EXPECT_TRUE(warnings_of(data / "elbow-emg" / (trial + "_emg_raw_uV.sto")).empty()) << trial;
    EXPECT_TRUE(warnings_of(data / "elbow-emg" / (trial + "_imu_landmarks.trc")).empty()) << trial;
  }
  for (const std::string trial : {"abd", "abd_cocon", "flex", "flex_cocon", "mvt_random"}) {
    const std::string file = "subject_1_" + trial + ".trc";
    EXPECT_TRUE(warnings_of(data / "upper-limb-optical" / file).empty()) << trial;
  }
  for (const Remark& f : warnings_of(data / "box-lift" / "markers_analogs.c3d")) {
    ASSERT_TRUE(f.when) << f.says;
    const bool hidden = f.code == RemarkCode::marker_gap && *f.value > 0.2;
    const bool not_worn = f.code == RemarkCode::emg_flat && *f.value == 0.0;
    EXPECT_TRUE(hidden || not_worn) << f.says;
  }
}

/// The trunk of this model lies at the default pose, and the person stands: T1 is 13 cm above T10 along z.
TEST(CheckStudy, TheVerticalThatInitWritesIsNoneThatCheckContradicts) {
  const std::filesystem::path data = test::data_folder() / "box-lift";
  MYOID_REQUIRE_DATA(data / "markers_analogs.c3d");
  const test::TemporaryFolder folder;
  const std::string c3d = (data / "markers_analogs.c3d").generic_string();
  const std::vector<Remark> findings = check_study(parse_study(
      fmt::format("[model]\nfile = \"{}\"\ncoordinate = \"GH_x\"\n[markers]\nup = \"z\"\n[emg]\nkind = \"raw\"\n"
                  "[[muscle]]\nname = \"tric_long\"\nosim = [\"tric_long_1\"]\nemg = \"Triceps.EMG5\"\n"
                  "[[trial]]\nname = \"lift\"\nmarkers = \"{}\"\nemg = \"{}\"\n",
                  (data / "das.osim").generic_string(), c3d, c3d),
      folder / "study.toml"));
  EXPECT_EQ(std::ranges::count(findings, Severity::error, &Remark::severity), 0);
  EXPECT_EQ(std::ranges::count(findings, RemarkCode::body_unsupported, &Remark::code), 1);  // the motion was looked at
  EXPECT_EQ(std::ranges::count(findings, RemarkCode::vertical_across_trunk, &Remark::code), 0);
}

TEST(CheckStudy, AStartThatTheModelPutsOutsideTheBoundsIsWarnedOf) {
  WrittenStudy study;
  std::string osim = body::arm4_osim();
  const std::string tag = "<optimal_fiber_length>";
  osim.replace(osim.find(tag), tag.size(), tag + "9");  // 9 m and some digits
  write_file(study.folder / "arm.osim", osim);
  study.text += "[model]\nfile = \"arm.osim\"\n";
  const std::vector<Remark> findings = study.findings();
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const Remark& f) {
    return f.severity == Severity::warning && f.says.find("optimal_fiber_length") != std::string::npos &&
           f.says.find("lies outside 0.01 to 0.6") != std::string::npos;
  }));
}

}  // namespace
}  // namespace myoid::study
