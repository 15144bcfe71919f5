// The command `twin` as a user runs it.
#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_rows;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;
namespace fs = std::filesystem;

const std::string kShort = R"(
level = "L2"
[[trial]]
name = "mvc"
kind = "mvc"
direction = "both"
[[trial]]
name = "lift"
kind = "eccentric"
held_mass_kg = 1.0
)";

TEST(TwinCommand, ManyPersonsAreTheSameToTheBitWithAnyNumberOfThreads) {
  const TemporaryFolder folder;
  write_text(folder / "p.toml", kShort);
  for (const std::string threads : {"1", "3"}) {
    const Finished done = myoid({"twin", "--protocol", folder / "p.toml", "--subjects", "5", "--seed", "7", "--threads",
                                 threads, "--out", folder / threads});
    EXPECT_EQ(done.exit_code, 0) << done.err;
    EXPECT_THAT(done.out, HasSubstr("persons.csv"));
  }
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder / "1")) {
    if (!entry.is_regular_file()) continue;
    ++files;
    const fs::path other = fs::path(folder / "3") / fs::relative(entry.path(), folder / "1");
    EXPECT_EQ(read_text(entry.path()), read_text(other)) << other;
  }
  // The folder holds persons.csv and the record of its files. Each person has study, model, truth and person.csv, 8
  // files of a trial, and the torque of the MVC.
  EXPECT_EQ(files, 2 + 5 * (4 + 2 * 8 + 1));
  EXPECT_EQ(read_rows(fs::path(folder / "1") / "persons.csv").size(), 5U);

  // One of them alone is the same person.
  const Finished alone = myoid({"twin", "--protocol", folder / "p.toml", "--seed", "9", "--out", folder / "alone"});
  EXPECT_EQ(alone.exit_code, 0) << alone.err;
  for (const char* file : {"truth.csv", "lift.trc", "lift_emg.sto", "study.toml"})
    EXPECT_EQ(read_text(fs::path(folder / "alone") / file), read_text(fs::path(folder / "1") / "person_000009" / file));
}

TEST(TwinCommand, TheTableOfTruthsNeedsNoRecordings) {
  const TemporaryFolder folder;
  write_text(folder / "p.toml", kShort);
  const Finished done = myoid({"twin", "--protocol", folder / "p.toml", "--subjects", "3", "--truth-only", "--json",
                               "--out", folder / "people"});
  EXPECT_EQ(done.exit_code, 0) << done.err;
  EXPECT_THAT(done.out, HasSubstr("\"persons\": 3"));
  EXPECT_EQ(read_rows(fs::path(folder / "people") / "persons.csv").size(), 3U);
  const Finished all =
      myoid({"twin", "--protocol", folder / "p.toml", "--subjects", "3", "--out", folder / "recorded"});
  EXPECT_EQ(all.exit_code, 0) << all.err;
  EXPECT_EQ(read_text(fs::path(folder / "people") / "persons.csv"),
            read_text(fs::path(folder / "recorded") / "persons.csv"));
  EXPECT_FALSE(fs::exists(fs::path(folder / "people") / "person_000001"));
  EXPECT_EQ(myoid({"twin", "--protocol", folder / "p.toml", "--truth-only", "--out", folder / "x"}).exit_code, 3);
}

TEST(TwinCommand, AC3dRecordingOfSevenHeadsIsAnalysedAsItIs) {
  const TemporaryFolder folder;
  write_text(folder / "p.toml", kShort);
  const std::string rec = folder / "rec";
  const Finished twin =
      myoid({"twin", "--protocol", folder / "p.toml", "--model", "arm7", "--format", "c3d", "--json", "--out", rec});
  ASSERT_EQ(twin.exit_code, 0) << twin.err;
  EXPECT_THAT(twin.out, HasSubstr("\"level\": \"L2\""));
  EXPECT_TRUE(fs::exists(fs::path(rec) / "lift.c3d"));
  EXPECT_FALSE(fs::exists(fs::path(rec) / "lift.trc"));
  const Finished check = myoid({"check", fs::path(rec) / "study.toml"});
  EXPECT_EQ(check.exit_code, 0) << check.out << check.err;
}

TEST(TwinCommand, SaysWhatItCannotDo) {
  const TemporaryFolder folder;
  write_text(folder / "p.toml", kShort);
  const Finished level =
      myoid({"twin", "--protocol", folder / "p.toml", "--level", "L1", "--model", "arm7", "--out", folder / "x"});
  EXPECT_EQ(level.exit_code, 3);
  EXPECT_THAT(level.err, HasSubstr("only a person at level L2 has seven heads"));
  write_text(folder / "odd.toml", "[motion]\nrate_hz = 30\n" + kShort.substr(kShort.find("[[")));
  const Finished rates = myoid({"twin", "--protocol", folder / "odd.toml", "--format", "c3d", "--out", folder / "y"});
  EXPECT_EQ(rates.exit_code, 3);
  EXPECT_THAT(rates.err, HasSubstr("whole number"));
  EXPECT_FALSE(fs::exists(fs::path(folder / "y") / "study.toml"));
  EXPECT_EQ(myoid({"twin", "--protocol", folder / "p.toml", "--subjects", "0", "--out", "z"}).exit_code, 2);
}

TEST(TwinCommand, APersonOfTwinStudyIsPredictedAsRunPredictsTheRecording) {
  const TemporaryFolder folder;
  write_text(folder / "p.toml", std::string(myoid::test::kTwoSpeeds) + "use = \"validation\"\n");
  const std::vector<std::string> person{"--protocol", folder / "p.toml", "--seed", "3", "--out"};
  const auto with = [&](std::vector<std::string> command, const std::string& out) {
    command.insert(command.end(), person.begin(), person.end());
    command.push_back(out);
    return myoid(command);
  };
  ASSERT_EQ(with({"twin-study", "--subjects", "1"}, folder / "study").exit_code, 0);
  ASSERT_EQ(with({"twin"}, folder / "recording").exit_code, 0);
  const Finished done = myoid({"run", folder / "recording/study.toml", "--out", folder / "results"});
  ASSERT_NE(done.exit_code, 3) << done.err;
  const auto rows = read_rows(fs::path(folder / "study") / "predictions.csv");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("trial"), "fast");
  const nlohmann::json parameters = nlohmann::json::parse(read_text(fs::path(folder / "results") / "parameters.json"));
  int compared = 0;
  for (const auto& method : parameters.at("methods")) {
    if (method.at("method") != "torque") continue;
    for (const auto& trial : method.at("trials")) {
      if (trial.at("trial") != "fast") continue;
      ++compared;
      // The files of the recording hold six digits.
      EXPECT_NEAR(std::stod(rows[0].at("r2")), trial.at("r2").get<double>(), 1e-4);
      EXPECT_NEAR(std::stod(rows[0].at("rmse_nm")), trial.at("rmse_nm").get<double>(), 1e-4);
      EXPECT_NEAR(std::stod(rows[0].at("band_r2")), trial.at("band_r2").get<double>(), 1e-4);
    }
  }
  EXPECT_EQ(compared, 1);
}

TEST(TwinCommand, AWorldIsSetByOptionsAndStated) {
  const TemporaryFolder folder;
  write_text(folder / "p.toml", kShort);
  const Finished done = myoid({"twin", "--protocol", folder / "p.toml", "--level", "L1", "--truth", "curves=millard",
                               "tendon_strain=[0.08,0.08]", "torque_scale=1.05", "--out", folder / "wrong"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  const std::string person = read_text(fs::path(folder / "wrong") / "truth" / "person.csv");
  for (const char* row : {"world,curves,1,millard", "world,tendon_strain,1,0.08 to 0.08", "world,torque_scale,1,1.05"})
    EXPECT_THAT(person, HasSubstr(row));
  EXPECT_THAT(myoid({"twin", "--help"}).out, HasSubstr("moment_arm_slope_sd"));
  const Finished refused =
      myoid({"twin", "--protocol", folder / "p.toml", "--truth", "moment_arms=0.1", "--out", folder / "refused"});
  EXPECT_NE(refused.exit_code, 0);
  EXPECT_THAT(refused.err, HasSubstr("did you mean 'moment_arm_sd'"));
  // The report reads a truth in which the curves' parameters are absent.
  const Finished run = myoid({"run", fs::path(folder / "wrong") / "study.toml", "--out", folder / "results"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST(TwinCommand, AStudyOfAWorldStatesItAndTellsErrorAndWidthOfEachParameter) {
  const TemporaryFolder folder;
  write_text(folder / "p.toml", kShort);
  const Finished done = myoid({"twin-study", "--protocol", folder / "p.toml", "--level", "L1", "--subjects", "2",
                               "--truth", "moment_arm_sd=0.15", "--out", folder / "study"});
  ASSERT_EQ(done.exit_code, 0) << done.err;
  for (const char* column : {"error", "half w.", "identif.", "of these"}) EXPECT_THAT(done.out, HasSubstr(column));
  const auto run = nlohmann::json::parse(read_text(fs::path(folder / "study") / "run.json"));
  EXPECT_EQ(run["world"]["moment_arm_sd"], "0.15");
  EXPECT_THAT(read_text(fs::path(folder / "study") / "summary.csv"), HasSubstr("median_error"));
}

/// Returns `text` without the lines that begin with one of `words`.
std::string without_lines(const std::string& text, const std::vector<std::string>& words) {
  std::istringstream lines(text);
  std::string kept;
  for (std::string line; std::getline(lines, line);) {
    if (std::ranges::none_of(words, [&](const std::string& word) { return line.starts_with(word); }))
      kept += line + "\n";
  }
  return kept;
}

TEST(TwinCommand, TheGreatestTorqueOfThePersonFitsTheContractionWhereTendonsAreUnknown) {
  const TemporaryFolder folder;
  const std::string protocol = ::myoid::test::source_dir() / "examples/protocols/three_trials.toml";
  ASSERT_EQ(myoid({"twin", "--protocol", protocol, "--seed", "7", "--out", folder / "rec"}).exit_code, 0);
  // As a stranger's study: the built-in arm, and nothing known of the muscles.
  const fs::path study = fs::path(folder / "rec") / "study.toml";
  std::string text = without_lines(read_text(study), {"held_mass =", "fixed =", "file = \"model.osim"});
  text.replace(text.find("[model]"), 7, "[model]\nbuiltin = \"arm4\"");
  write_text(study, text);
  const Finished run = myoid({"run", study, "--out", folder / "results"});
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.err;
  const auto number = [](const fs::path& file, const std::string& parameter, const std::string& column) {
    for (const auto& row : read_rows(file)) {
      if (row.at("muscle") == "elbow_flexion" && row.at("parameter") == parameter) return std::stod(row.at(column));
    }
    return 0.0;
  };
  for (const std::string parameter : {"voluntary_torque_positive", "voluntary_torque_negative"}) {
    const double truth_nm = number(fs::path(folder / "rec") / "truth.csv", parameter, "value");
    // The fitted contraction is measured within 3 %. Away from the mode the flexors' torque errs by 7 %.
    EXPECT_NEAR(number(fs::path(folder / "results") / "parameters.csv", parameter, "estimate"), truth_nm,
                0.04 * truth_nm)
        << parameter;
  }
}

}  // namespace
