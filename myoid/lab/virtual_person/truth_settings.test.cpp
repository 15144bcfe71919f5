#include "myoid/lab/virtual_person/truth_settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/lab/twin/synthetic_recording.h"
#include "myoid/lab/twin/write_recording.h"

#include "tests/support/printed_page.h"

namespace myoid::lab {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string kEffort = "[[trial]]\nname = \"a\"\nkind = \"mvc\"\n";

std::string complaint(Level level, const std::string& setting) {
  Protocol protocol = default_protocol(level);
  try {
    set_truth(protocol, {setting});
  } catch (const ReadError& error) {
    return error.what();
  }
  return "";
}

TEST(TruthSettings, AreTheOnesThatTheGuidePrints) {
  test::expect_printed("docs/guide/twin.md", "[truth]", study::markdown(truth_reference().rows));
}

TEST(TruthSettings, OptionsTakeThePlaceOfTheFilesKeys) {
  Protocol protocol = parse_protocol("[truth]\nspread = 0.5\nmoment_arm_sd = 0.1\n" + kEffort, "p.toml");
  set_truth(protocol, {"moment_arm_sd=0.2", "curves=millard", "tendon_strain = [0.04, 0.08]", "emg_noise=true",
                       "BIC.optimal_fiber_length=0.1"});
  EXPECT_EQ(protocol.truth.spread, 0.5);
  EXPECT_EQ(protocol.truth.moment_arm_sd, 0.2);
  EXPECT_EQ(protocol.truth.curves, "millard");
  EXPECT_EQ(protocol.truth.tendon_strain.upper, 0.08);
  EXPECT_TRUE(protocol.truth.sensors.emg_noise);
  EXPECT_EQ(protocol.truth.values.at("BIC").at("optimal_fiber_length"), 0.1);
}

TEST(TruthSettings, SettingsThatMeanNothingAreRefused) {
  EXPECT_THAT(complaint(Level::noisy, "moment_arm_sd=3"), HasSubstr("0 to 0.3"));
  EXPECT_THAT(complaint(Level::noisy, "moment_arms=0.1"), HasSubstr("moment_arm_sd"));
  EXPECT_THAT(complaint(Level::noisy, "tendon_strain=[0.08, 0.04]"), HasSubstr("[low, high]"));
  EXPECT_THAT(complaint(Level::noisy, "curves=milard"), HasSubstr("millard"));
  EXPECT_THAT(complaint(Level::noisy, "crosstalk"), Not(IsEmpty()));
  EXPECT_THAT(complaint(Level::different, "curves=paper"), HasSubstr("L0 and L1"));
  EXPECT_THAT(complaint(Level::noise_free, "crosstalk=0.1"), HasSubstr("level L1"));
  EXPECT_THAT(complaint(Level::noise_free, "tendon_strain=[0.05, 0.05]"), IsEmpty());
}

TEST(TruthSettings, TheFilesOfTheTruthStateTheWorld) {
  Protocol protocol = parse_protocol(kEffort, "p.toml");
  EXPECT_THAT(stated_world(protocol), IsEmpty());
  EXPECT_THAT(person_csv(make_virtual_person(protocol, 2)), Not(HasSubstr("world,")));
  set_truth(protocol, {"torque_scale=1.05", "tendon_strain=[0.08, 0.08]", "curves=millard"});
  const VirtualRecording person = make_virtual_person(protocol, 2);
  const std::string csv = person_csv(person);
  EXPECT_THAT(csv, HasSubstr("world,curves,1,millard\n"));
  EXPECT_THAT(csv, HasSubstr("world,tendon_strain,1,0.08 to 0.08\n"));
  EXPECT_THAT(csv, HasSubstr("world,torque_scale,1,1.05\n"));
  EXPECT_THAT(truth_csv(person), HasSubstr("BIC,tendon_strain,1,0.08\n"));
  EXPECT_THAT(truth_csv(person), HasSubstr("BIC,max_isometric_force,N,"));
  EXPECT_THAT(truth_csv(person), Not(HasSubstr("BIC,force_length_width")));
  // The study believes the literature: nothing of the world is in it, but that tendons do not stretch.
  const VirtualRecording plain = make_virtual_person(parse_protocol(kEffort, "p.toml"), 2);
  std::string of_plain = study_toml(plain);
  const std::size_t rigid = of_plain.find("tendon = \"rigid\"");
  ASSERT_NE(rigid, std::string::npos);
  of_plain.erase(rigid, of_plain.find('\n', rigid) + 1 - rigid);
  EXPECT_EQ(study_toml(person), of_plain);
}

}  // namespace
}  // namespace myoid::lab
