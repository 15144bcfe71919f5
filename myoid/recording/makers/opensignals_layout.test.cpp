#include "myoid/recording/makers/opensignals_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/recording/makers/emg_table.h"

#include "tests/support/message_of.h"
#include "tests/support/repair_lines.h"

namespace myoid::recording {
namespace {

using ::testing::HasSubstr;

const std::string kHead =
    "# OpenSignals Text File Format. Version 1\n"
    "# {\"00:07:80:AA:BB:CC\": {\"sensor\": [\"EMG\", \"ECG\"], \"device name\": \"00:07\", \"column\": [\"nSeq\", "
    "\"DI\", \"CH1\", \"CH2\"], \"sampling rate\": 500, \"label\": [\"BIC\", \"CH2\"], \"channels\": [1, 2], "
    "\"resolution\": [16, 16], \"convertedValues\": 0}}\n"
    "# EndOfHeader\n";

TEST(OpenSignals, ChannelsHaveTheirLabelsAndTheRateOfTheHeader) {
  const CsvSeries s =
      parse_emg_table(kHead + "14\t0\t32948\t15163\t\n15\t0\t33060\t15198\t\n0\t1\t32996\t15216\t\n", "a.txt");
  ASSERT_EQ(s.data.channel_count(), 3);
  EXPECT_EQ(s.data.channels()[0].name, "DI");
  EXPECT_EQ(s.data.channels()[1].name, "BIC");
  EXPECT_EQ(s.data.channels()[2].name, "ECG CH2");
  EXPECT_DOUBLE_EQ(s.data.time_s()[2], 0.004);
  EXPECT_EQ(s.data.values()(2, 1), 32996.0);
  EXPECT_EQ(s.has_unit, (std::vector<bool>(3, false)));
  EXPECT_THAT(test::repair_lines(s.repairs), HasSubstr("left out: nSeq"));
}

TEST(OpenSignals, AHeaderThatDoesNotGoWithTheRowsIsRefused) {
  const auto refusal = [](const std::string& text) -> std::string {
    return test::message_of<ReadError>([&] { (void)parse_emg_table(text, "a.txt"); });
  };
  EXPECT_THAT(refusal(kHead + "0\t0\t1\n1\t0\t2\n"), HasSubstr("a.txt:4: 3 cells"));
  EXPECT_THAT(refusal(kHead.substr(0, 100) + "\n# EndOfHeader\n0\t1\n"), HasSubstr("a.txt:2: "));
  EXPECT_THAT(refusal("# OpenSignals Text File Format\n0\t1\n"), HasSubstr("EndOfHeader"));
}

}  // namespace
}  // namespace myoid::recording
