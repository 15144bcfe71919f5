#include "myoid/study/muscle_table.h"

#include <string>

#include <gtest/gtest.h>

#include "myoid/study/setting_reader.h"

#include "tests/support/message_of.h"

namespace myoid::study {
namespace {

template <typename Spec>
std::string table_message(const std::string& text) {
  const toml::table root = parse_toml(text, "dir/study.toml");
  return test::message_of([&] { (void)read_spec<Spec>({root, "dir/study.toml", "[[table]]"}, "dir"); });
}

TEST(MuscleTable, AStartThatNoMuscleHasIsRefusedWithTheRange) {
  const std::string message =
      table_message<MuscleSpec>("name = \"B\"\nemg = \"b\"\nstart = { optimal_fiber_length = 173 }\n");
  EXPECT_NE(message.find("study.toml:3"), std::string::npos) << message;
  EXPECT_NE(message.find("found 173 m, expected 0.01 to 0.6 m"), std::string::npos) << message;
}

TEST(MuscleTable, AnUnknownParameterIsRefusedAtItsLine) {
  const std::string message = table_message<MuscleSpec>("name = \"B\"\nemg = \"b\"\nfixed = [\"eccentric_plato\"]\n");
  EXPECT_NE(message.find("study.toml:3"), std::string::npos) << message;
  EXPECT_NE(message.find("'eccentric_plateau'"), std::string::npos) << message;
}

TEST(MuscleTable, WithoutOsimTheModelsMuscleHasTheSameName) {
  const toml::table root = parse_toml("name = \"B\"\nemg = \"b\"\n", "study.toml");
  EXPECT_EQ(read_spec<MuscleSpec>({root, "study.toml", "[[muscle]]"}, "").osim, std::vector<std::string>{"B"});
}

TEST(ParameterRuleTable, APennationInDegreesIsRefused) {
  for (const char* key : {"value", "prior_mean"}) {
    const std::string message =
        table_message<fit::ParameterRule>(std::string("name = \"pennation_angle\"\n") + key + " = 25\n");
    for (const char* part : {"study.toml:2", "found 25, expected 0 to 1 rad", "write 0.4363"})
      EXPECT_NE(message.find(part), std::string::npos) << message;
  }
  const toml::table root = parse_toml("name = \"pennation_angle\"\nvalue = 0.44\n", "study.toml");
  EXPECT_EQ(read_spec<fit::ParameterRule>({root, "study.toml", "[[parameter]]"}, "").value, 0.44);
}

TEST(ParameterRuleTable, ARuleForAnUnknownParameterAndBoundsInTheWrongOrderAreRefused) {
  EXPECT_NE(table_message<fit::ParameterRule>("name = \"F_mx\"\n").find("study.toml:1"), std::string::npos);
  EXPECT_NE(table_message<fit::ParameterRule>("name = \"optimal_fiber_length\"\nlower = 0.3\nupper = 0.2\n")
                .find("0.3, not below"),
            std::string::npos);
  EXPECT_NE(table_message<fit::ParameterRule>("name = \"optimal_fiber_length\"\nprior_sd = 0\n").find("positive"),
            std::string::npos);
}

}  // namespace
}  // namespace myoid::study
