#include "myoid/lab/virtual_person/protocol.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"

namespace myoid::lab {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kTrial = "[[trial]]\nname = \"a\"\nkind = \"flexion\"\n";

/// The message of the error that reading the text gives; empty if it gives none.
std::string complaint(const std::string& text) {
  try {
    static_cast<void>(parse_protocol(text, "p.toml"));
  } catch (const ReadError& error) {
    return error.what();
  }
  return "";
}

TEST(Protocol, ReadsAnglesInDegreesAndKeepsDefaults) {
  const Protocol protocol =
      parse_protocol("name = \"n\"\nlevel = \"L0\"\n[truth]\nemg_delay_s = [0.04, 0.05]\n" + kTrial +
                         "centre_deg = 90\namplitude_deg = 30\nplane = \"horizontal\"\nheld_mass_kg = 2\n",
                     "p.toml");
  EXPECT_EQ(protocol.name, "n");
  EXPECT_EQ(protocol.level, Level::noise_free);
  EXPECT_EQ(protocol.truth.emg_delay_s.upper, 0.05);
  EXPECT_EQ(protocol.motion.rate_hz, 100.0);
  ASSERT_EQ(protocol.trials.size(), 1U);
  EXPECT_DOUBLE_EQ(protocol.trials[0].cycles.centre_rad, 0.5 * kPi);
  EXPECT_EQ(protocol.trials[0].plane, Plane::horizontal);
  EXPECT_EQ(protocol.trials[0].held_mass_kg, 2.0);
  EXPECT_EQ(protocol.trials[0].use, "calibration");
}

TEST(Protocol, SeveralAnglesAreSeveralTrials) {
  const Protocol protocol =
      parse_protocol("[[trial]]\nname = \"iso\"\nkind = \"isometric_ramp\"\nangles_deg = [20, 70.5]\n", "p.toml");
  ASSERT_EQ(protocol.trials.size(), 2U);
  EXPECT_EQ(protocol.trials[0].name, "iso_20");
  EXPECT_EQ(protocol.trials[1].name, "iso_70.5");
  EXPECT_EQ(protocol.trials[1].use, "isometric");
  EXPECT_DOUBLE_EQ(protocol.trials[1].angle_rad, 70.5 * kDegree);
}

TEST(Protocol, TakesValuesForSingleMuscles) {
  const Protocol protocol = parse_protocol("[truth.BRA]\noptimal_fiber_length = 0.09\n" + kTrial, "p.toml");
  EXPECT_EQ(protocol.truth.values.at("BRA").at("optimal_fiber_length"), 0.09);
}

TEST(Protocol, NamesTheLineAndTheNearestKey) {
  EXPECT_THAT(complaint(kTrial + "frequenzy_hz = 1\n"),
              AllOf(HasSubstr("p.toml:4"), HasSubstr("did you mean 'frequency_hz'")));
  EXPECT_THAT(complaint("[emg]\nrate = 1\n" + kTrial), HasSubstr("rate_hz"));
}

TEST(Protocol, AKeyOfAnotherKindOfTrialIsUnknown) {
  EXPECT_THAT(complaint(kTrial + "hold_s = 1\n"), HasSubstr("hold_s"));
}

TEST(Protocol, SaysWhatWasFoundAndWhatIsExpected) {
  EXPECT_THAT(complaint(kTrial + "held_mass_kg = -1\n"),
              AllOf(HasSubstr("p.toml:4"), HasSubstr("found -1"), HasSubstr("from 0 to 50")));
  EXPECT_THAT(complaint(kTrial + "centre_deg = 20\namplitude_deg = 60\n"), HasSubstr("expected within 0 to 150"));
  EXPECT_THAT(complaint("[truth]\nvary = [\"optimal_fibre_length\"]\n" + kTrial),
              HasSubstr("did you mean 'optimal_fiber_length'"));
}

TEST(Protocol, RefusesWhatCannotBe) {
  EXPECT_THAT(complaint("level = \"L3\"\n" + kTrial), HasSubstr("L2"));
  EXPECT_THAT(complaint("level = \"L2\"\n[truth.BIC]\nmax_isometric_force = 900\n" + kTrial),
              HasSubstr("levels L0 and L1"));
  EXPECT_THAT(complaint("[[trial]]\nname = \"k\"\nkind = \"isokinetic\"\nfrom_deg = 90\nto_deg = 80\n"),
              HasSubstr("more than from_deg"));
  EXPECT_THAT(complaint("name = \"x\"\n"), HasSubstr("no trial"));
  EXPECT_THAT(complaint(kTrial + kTrial), HasSubstr("a second time"));
  EXPECT_THAT(complaint("[[trial]]\nkind = \"mvc\"\n"), HasSubstr("'name' is missing"));
  EXPECT_THAT(complaint("[[trial]]\nname = \"a\\u0007\"\nkind = \"mvc\"\n"), HasSubstr("U+0007"));
  EXPECT_THAT(complaint("[[trial]]\nname = \"x\"\nkind = \"jump\"\n"), HasSubstr("flexion"));
  EXPECT_THAT(complaint("[[trial]\n"), HasSubstr("p.toml:1"));
}

TEST(Protocol, TrialsAreThoseOfASession) {
  const std::string lift = "[[trial]]\nname = \"k\"\nkind = \"eccentric\"\n";
  EXPECT_THAT(complaint(lift + "lower_s = 1e300\n"), HasSubstr("found 1e+300, expected a number from 0.3 to 600"));
  EXPECT_THAT(complaint("[[trial]]\nname = \"k\"\nkind = \"mvc\"\nrest_s = 1e9\n"), HasSubstr("from 0.2 to 600"));
  EXPECT_THAT(complaint("[[trial]]\nname = \"k\"\nkind = \"isokinetic\"\nrise_s = inf\n"), HasSubstr("rise_s"));
  EXPECT_THAT(complaint(lift + "lower_s = 500\nrepetitions = 100\n"), HasSubstr("at most 3600 s"));
  EXPECT_NO_THROW((void)parse_protocol(lift + "lower_s = 30\nrepetitions = 100\n", "p.toml"));
}

TEST(Protocol, TheLevelSaysWhatAbsentKeysStandFor) {
  const Protocol noisy = parse_protocol("[emg]\nhum = 0.02\n" + kTrial, "p.toml");
  EXPECT_EQ(noisy.level, Level::noisy);
  EXPECT_EQ(noisy.motion.misplacement_m, 0.0);
  EXPECT_FALSE(noisy.fatigue.on);
  // The caller's level takes the place of the file's; what the file sets stays.
  const Protocol different = parse_protocol("level = \"L1\"\n[emg]\nhum = 0.02\ncrosstalk = [0.0, 0.0]\n" + kTrial,
                                            "p.toml", Level::different);
  EXPECT_EQ(different.level, Level::different);
  EXPECT_EQ(different.emg.hum, 0.02);
  EXPECT_EQ(different.emg.crosstalk.upper, 0.0);
  EXPECT_EQ(different.emg.exponent.upper, 1.5);
  EXPECT_EQ(different.motion.misplacement_m, 0.005);
  EXPECT_EQ(different.sync.offset_sd_s, 0.008);
  EXPECT_TRUE(different.fatigue.on);
}

TEST(Protocol, ReadsAnIsokineticTrial) {
  const Protocol protocol = parse_protocol(
      "[[trial]]\nname = \"k\"\nkind = \"isokinetic\"\nspeed_deg_per_s = 90\nmode = \"eccentric\"\n"
      "direction = \"flexion\"\nfrom_deg = 20\nto_deg = 110\n",
      "p.toml");
  EXPECT_DOUBLE_EQ(protocol.trials[0].speed_radps, 0.5 * kPi);
  EXPECT_FALSE(protocol.trials[0].concentric);
  EXPECT_TRUE(protocol.trials[0].eccentric);
  EXPECT_EQ(protocol.trials[0].direction, Direction::flexion);
}

TEST(Protocol, AFileThatIsNotThereIsSaidSo) {
  EXPECT_THROW(static_cast<void>(read_protocol("no-such-file.toml")), ReadError);
}

}  // namespace
}  // namespace myoid::lab
