// Input that would give a wrong number is refused or named, by every command that meets it.
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>
#include <tuple>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::replace_in;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

std::string noise_csv(const std::string& unit, double scale) {
  std::string text = "time,BIC [" + unit + "]\n";
  for (int i = 0; i < 4000; ++i) {
    const double x = ((i * 7919) % 2003) / 2003.0 - 0.5;
    text += std::to_string(0.001 * i) + "," + std::to_string(scale * x) + "\n";
  }
  return text;
}

/// Two trials of a virtual person.
std::filesystem::path two_trials(const TemporaryFolder& folder) {
  std::string protocol = "name = \"two\"\nlevel = \"L1\"\n[motion]\nrate_hz = 100\n";
  for (const std::string name : {"slow", "fast"})
    protocol += "[[trial]]\nname = \"" + name +
                "\"\nkind = \"flexion\"\nfrequency_hz = " + (name == "slow" ? "0.5" : "0.8") +
                "\ncentre_deg = 72\namplitude_deg = 40\nheld_mass_kg = 1.0\nduration_s = 6\n";
  write_text(folder / "protocol.toml", protocol);
  const Finished twin = myoid({"twin", "--protocol", folder / "protocol.toml", "--seed", "1", "--out", folder / "rec"});
  EXPECT_EQ(twin.exit_code, 0) << twin.err;
  return folder / "rec";
}

TEST(PlausibleInput, EmgOfNoiseAloneIsSaid) {
  const TemporaryFolder folder;
  write_text(folder / "e.csv", noise_csv("mV", 1.0));
  const Finished emg = myoid({"emg", folder / "e.csv", "--out", folder / "a.sto"});
  EXPECT_EQ(emg.exit_code, 0) << emg.err;
  EXPECT_THAT(emg.err, AllOf(HasSubstr("'BIC' rises to only"), HasSubstr("times its lowest level")));
  EXPECT_THAT(myoid({"check", folder / "e.csv"}).out, HasSubstr("'BIC' rises to only"));
}

TEST(PlausibleInput, EmgOfHundredsOfVoltsIsSaid) {
  const TemporaryFolder folder;
  write_text(folder / "e.csv", noise_csv("V", 300.0));
  EXPECT_THAT(myoid({"emg", folder / "e.csv", "--out", folder / "a.sto"}).err,
              AllOf(HasSubstr("reaches 150 V"), HasSubstr("unit")));
  EXPECT_THAT(myoid({"check", folder / "e.csv"}).out, HasSubstr("reaches 150 V"));
}

TEST(PlausibleInput, EnvelopesAreRefusedByTheCommandEmgOnce) {
  const TemporaryFolder folder;
  std::string text = "time,BIC [mV],TRI [mV]\n";
  for (int i = 0; i < 4000; ++i) {
    const double x = 0.001 * i;
    text += std::to_string(x) + "," + std::to_string(0.5 + 0.4 * std::sin(3.0 * x)) + "," +
            std::to_string(0.5 + 0.4 * std::cos(3.0 * x)) + "\n";
  }
  write_text(folder / "e.csv", text);
  const Finished emg = myoid({"emg", folder / "e.csv", "--out", folder / "a.sto"});
  EXPECT_EQ(emg.exit_code, 3);
  EXPECT_THAT(emg.err, AllOf(HasSubstr("BIC, TRI are never negative and slow"), Not(HasSubstr("saturated"))));
  EXPECT_FALSE(std::filesystem::exists(folder / "a.sto"));
}

TEST(PlausibleInput, EmgThatDoesNotChangeOrHasOneSampleIsAnErrorInItsOwnWords) {
  const TemporaryFolder folder;
  write_text(folder / "still.csv", noise_csv("mV", 0.0));
  write_text(folder / "one.csv", "time,BIC [mV]\n0,1\n");
  const Finished still = myoid({"emg", folder / "still.csv", "--out", folder / "a.sto"});
  EXPECT_EQ(still.exit_code, 3);
  EXPECT_THAT(still.err,
              AllOf(HasSubstr("still.csv"), HasSubstr("the same value throughout"), Not(HasSubstr("quantile"))));
  const Finished one = myoid({"emg", folder / "one.csv", "--out", folder / "a.sto"});
  EXPECT_EQ(one.exit_code, 3);
  EXPECT_THAT(one.err, AllOf(HasSubstr("one.csv"), HasSubstr("only 1 sample"), Not(HasSubstr("Butterworth"))));
  EXPECT_EQ(myoid({"check", folder / "one.csv"}).exit_code, 3);
}

TEST(PlausibleInput, OneEmgInTwoTrialsIsRefusedByCheckAndRun) {
  const TemporaryFolder folder;
  const auto rec = two_trials(folder);
  EXPECT_EQ(myoid({"check", rec / "study.toml"}).exit_code, 0);
  replace_in(rec / "study.toml", "emg = \"fast_emg.sto\"", "emg = \"slow_emg.sto\"");
  const Finished check = myoid({"check", rec / "study.toml"});
  EXPECT_EQ(check.exit_code, 3);
  EXPECT_THAT(check.out, AllOf(HasSubstr("EMG of trial 'slow'"), HasSubstr("correct its emg")));
  const Finished run = myoid({"run", rec / "study.toml", "--out", folder / "out"});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_THAT(run.err, AllOf(HasSubstr("EMG of trial 'slow'"), HasSubstr("(trial 'fast')")));
  EXPECT_FALSE(std::filesystem::exists(folder / "out/parameters.csv"));
}

TEST(PlausibleInput, AHeldMassWithoutItsDecimalPointIsSaidByCheckAndRun) {
  const TemporaryFolder folder;
  const auto rec = two_trials(folder);
  replace_in(rec / "study.toml", "held_mass_kg = 1", "held_mass_kg = 50");
  EXPECT_THAT(myoid({"check", rec / "study.toml"}).out, HasSubstr("decimal point"));
  EXPECT_THAT(myoid({"run", rec / "study.toml", "--out", folder / "out"}).err, HasSubstr("decimal point"));
}

/// A motion of the built-in arm with all coordinates: the elbow swings by 50 degrees at 0.5 Hz for 5 s.
std::string arm_motion(double time_factor, double angle_factor) {
  std::string text =
      "Coordinates\nversion=1\nnRows=501\nnColumns=5\ninDegrees=yes\nendheader\n"
      "time\tshoulder_flexion\tshoulder_adduction\tshoulder_rotation\telbow_flexion\n";
  for (int i = 0; i <= 500; ++i) {
    const double time_s = 0.01 * i;
    char line[200];
    std::snprintf(line, sizeof line, "%.9g\t0\t0\t0\t%.9g\n", time_factor * time_s,
                  angle_factor * (60.0 + 50.0 * std::sin(3.14159265358979 * time_s)));
    text += line;
  }
  return text;
}

TEST(PlausibleInput, AMotionThatCannotBeIsSaidAlikeByEveryCommandThatMeetsIt) {
  const TemporaryFolder folder;
  write_text(folder / "usual.mot", arm_motion(1.0, 1.0));
  write_text(folder / "clock.mot", arm_motion(1e-3, 1.0));
  write_text(folder / "unit.mot", arm_motion(1.0, 3.14159265358979 / 180.0));
  for (const std::string command : {"id", "so", "paths"}) {
    const auto said = [&](const std::string& motion) {
      const std::string out = folder / (command + motion + (command == "id" ? ".sto" : ""));
      return myoid({command, "--model", "arm4", "--motion", folder / motion, "--out", out}).err;
    };
    EXPECT_THAT(said("usual.mot"), AllOf(Not(HasSubstr("nobody does")), Not(HasSubstr("another unit"))));
    EXPECT_THAT(said("clock.mot"), AllOf(HasSubstr("'elbow_flexion' moves faster than"), HasSubstr("nobody does")));
    EXPECT_THAT(said("unit.mot"), HasSubstr("if these are radians"));
  }
  EXPECT_THAT(myoid({"id", "--model", "arm4", "--motion", folder / "clock.mot", "--out", folder / "c.sto"}).err,
              HasSubstr("N m at elbow_flexion, beyond what the strongest person's muscles and weight do"));
  const Finished usual = myoid({"check", folder / "usual.mot", "--model", "arm4"});
  EXPECT_EQ(usual.exit_code, 0) << usual.out;
  EXPECT_THAT(usual.out, HasSubstr("0 errors, 0 remarks"));
  for (const char* model : {"", "arm4"}) {
    std::vector<std::string> check{"check", folder / "clock.mot"};
    if (*model != '\0') check.insert(check.end(), {"--model", model});
    const Finished clock = myoid(check);
    EXPECT_EQ(clock.exit_code, 3);
    EXPECT_THAT(clock.out, AllOf(HasSubstr("'elbow_flexion' moves faster than"), HasSubstr("nobody does")));
  }
  EXPECT_THAT(myoid({"check", folder / "unit.mot"}).out, HasSubstr("if these are radians"));
}

TEST(PlausibleInput, AModelThatCannotBeIsSaidAlike) {
  const TemporaryFolder folder;
  write_text(folder / "usual.mot", arm_motion(1.0, 1.0));
  const auto rec = two_trials(folder);
  ASSERT_TRUE(std::filesystem::exists(rec / "model.osim"));
  for (const auto& [from, to, says] :
       {std::tuple{"<gravity>0 -9.80665 0", "<gravity>0 -6e13 0", "the gravity of the model is 6e+13 m/s2"},
        std::tuple{"<mass>36.5", "<mass>36500", ", more than any person: are its masses in grams?"}}) {
    std::filesystem::copy_file(rec / "model.osim", folder / "m.osim",
                               std::filesystem::copy_options::overwrite_existing);
    replace_in(folder / "m.osim", from, to);
    EXPECT_THAT(myoid({"id", "--model", folder / "m.osim", "--motion", folder / "usual.mot", "--out", folder / "c.sto",
                       "--overwrite"})
                    .err,
                HasSubstr(says));
    EXPECT_THAT(myoid({"paths", "--model", folder / "m.osim", "--motion", folder / "usual.mot", "--out", folder / "p",
                       "--overwrite"})
                    .err,
                HasSubstr(says));
    const Finished check = myoid({"check", folder / "m.osim"});
    EXPECT_EQ(check.exit_code, 3);
    EXPECT_THAT(check.out, HasSubstr(says));
  }
}

TEST(PlausibleInput, LoadsThatNobodyStatedAreSaidByCheckAndByTheGateOfRun) {
  const TemporaryFolder folder;
  const auto rec = two_trials(folder);
  EXPECT_THAT(myoid({"check", rec / "study.toml"}).out, Not(HasSubstr("what was held")));
  replace_in(rec / "study.toml", "held_mass_kg = 1", "# held_mass_kg = 1");
  EXPECT_THAT(myoid({"check", rec / "study.toml"}).out, HasSubstr("does not say what was held, carried or pushed in"));
}

}  // namespace
