#include "myoid/recording/edf_reader.h"

#include <cmath>
#include <random>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {
namespace {

struct TestSignal {
  std::string label, unit;
  double physical_min, physical_max;
  int digital_min, digital_max, per_record;
};

/// Writes a file by the specification's table of fields. `digital(signal, sample)` gives the
/// numbers, `notes` the annotation bytes of each record, which are the last signal.
std::string make_edf(bool bdf,
                     const std::string& reserved,
                     const std::vector<TestSignal>& signals,
                     int records,
                     int said_records,
                     const std::function<int(std::size_t, int)>& digital,
                     const std::vector<std::string>& notes = {}) {
  const auto pad = [](std::string text, std::size_t n) { return text.append(n - text.size(), ' '); };
  std::string out = bdf ? "\xFF"
                          "BIOSEMI"
                        : pad("0", 8);
  out += pad("X", 80) + pad("Startdate X", 80) + "01.01.2520.00.00";
  out += pad(std::to_string(256 * (signals.size() + 1)), 8) + pad(reserved, 44);
  out += pad(std::to_string(said_records), 8) + pad("0.5", 8) + pad(std::to_string(signals.size()), 4);
  for (const auto& s : signals) out += pad(s.label, 16);
  for (const auto& s : signals) out += pad("electrode of " + s.label, 80);
  for (const auto& s : signals) out += pad(s.unit, 8);
  for (const auto& s : signals) out += pad(fmt::format("{}", s.physical_min), 8);
  for (const auto& s : signals) out += pad(fmt::format("{}", s.physical_max), 8);
  for (const auto& s : signals) out += pad(std::to_string(s.digital_min), 8);
  for (const auto& s : signals) out += pad(std::to_string(s.digital_max), 8);
  for (std::size_t s = 0; s < signals.size(); ++s) out += pad("HP:20Hz", 80);
  for (const auto& s : signals) out += pad(std::to_string(s.per_record), 8);
  for (std::size_t s = 0; s < signals.size(); ++s) out += pad("", 32);
  for (int r = 0; r < records; ++r) {
    for (std::size_t s = 0; s < signals.size(); ++s) {
      if (!notes.empty() && s + 1 == signals.size()) {
        std::string text = notes[static_cast<std::size_t>(r)];
        text.resize(static_cast<std::size_t>(signals[s].per_record) * (bdf ? 3 : 2), '\0');
        out += text;
        continue;
      }
      for (int i = 0; i < signals[s].per_record; ++i) {
        const auto value = static_cast<unsigned>(digital(s, r * signals[s].per_record + i));
        out += static_cast<char>(value & 255U);
        out += static_cast<char>((value >> 8U) & 255U);
        if (bdf) out += static_cast<char>((value >> 16U) & 255U);
      }
    }
  }
  return out;
}

EdfFile parse(const std::string& text) {
  return parse_edf(std::as_bytes(std::span(text.data(), text.size())), "test.edf");
}

const std::vector<TestSignal> kTwo{{"EMG Biceps", "uV", -1000, 1000, -2000, 2000, 4},
                                   {"EMG Triceps", "mV", 0, 5, 0, 100, 4},
                                   {"Acc", "g", -2, 2, -100, 100, 1}};

int ramp(std::size_t signal, int i) { return signal == 0 ? 10 * i - 30 : signal == 1 ? i : 50; }

TEST(Edf, SamplesBecomeVoltsAtTheirTimes) {
  const EdfFile file = parse(make_edf(false, "", kTwo, 3, 3, ramp));
  ASSERT_EQ(file.data.sample_count(), 12);
  ASSERT_EQ(file.data.channel_count(), 2);  // the accelerometer has another rate
  EXPECT_EQ(file.data.channels()[0], (Channel{"EMG Biceps", Unit::volt}));
  EXPECT_DOUBLE_EQ(file.data.time_s()[5], 0.625);
  for (int i = 0; i < 12; ++i) {
    EXPECT_NEAR(file.data.series().values()(i, 0), 0.5e-6 * (10 * i - 30), 1e-18);
    EXPECT_NEAR(file.data.series().values()(i, 1), 0.05e-3 * i, 1e-18);
  }
  EXPECT_EQ(file.repairs.size(), 1U);
}

TEST(Edf, BdfHolds24Bits) {
  std::vector<TestSignal> one{{"A1", "uV", -262144, 262143, -8388608, 8388607, 2}};
  const EdfFile file =
      parse(make_edf(true, "24BIT", one, 2, 2, [](std::size_t, int i) { return i % 2 == 0 ? -8388608 : 8388607; }));
  EXPECT_NEAR(file.data.series().values()(0, 0), -0.262144, 1e-12);
  EXPECT_NEAR(file.data.series().values()(1, 0), 0.262143, 1e-12);
}

TEST(Edf, AnnotationsAreEventsAndRecordsWithGapsSayTheirTime) {
  auto signals = kTwo;
  signals.pop_back();
  signals.push_back({"EDF Annotations", "", -1, 1, -32768, 32767, 20});
  using namespace std::string_literals;
  const std::vector<std::string> notes{
      "+0\x14\x14\0+0.25\x15"
      "0.1\x14Lift\x14\0"s,
      "+2\x14\x14\0"s};
  const EdfFile file = parse(make_edf(false, "EDF+D", signals, 2, 2, ramp, notes));
  ASSERT_EQ(file.events.size(), 1U);
  EXPECT_EQ(file.events[0].label, "Lift");
  EXPECT_EQ(file.events[0].time_s, 0.25);
  EXPECT_EQ(file.data.time_s()[3], 0.375);
  EXPECT_EQ(file.data.time_s()[4], 2.0);
  ASSERT_EQ(file.repairs.size(), 1U);
  EXPECT_NE(file.repairs[0].message.find("pauses"), std::string::npos);
}

TEST(Edf, EventsAreOnTheClockOfTheSamplesWhereTheFirstRecordBeginsLater) {
  auto signals = kTwo;
  signals.pop_back();
  signals.push_back({"EDF Annotations", "", -1, 1, -32768, 32767, 20});
  using namespace std::string_literals;
  // "Lift" is marked at the begin of the second record: sample 4 of a record of 4, at 0.5 s.
  for (const char* kind : {"EDF+C", "EDF+D"}) {
    const std::vector<std::string> notes{"+0.390625\x14\x14\0"s, "+0.890625\x14\x14\0+0.890625\x14Lift\x14\0"s};
    const EdfFile file = parse(make_edf(false, kind, signals, 2, 2, ramp, notes));
    ASSERT_EQ(file.events.size(), 1U) << kind;
    EXPECT_EQ(file.events[0].time_s, file.data.time_s()[4]) << kind;
    EXPECT_EQ(file.data.time_s()[0], 0.0) << kind;
    ASSERT_EQ(file.repairs.size(), 1U) << kind;
    EXPECT_NE(file.repairs[0].message.find("0.390625 s after"), std::string::npos) << kind;
  }
  // Only the second record has a stamp: the first one begins a record earlier.
  const std::vector<std::string> late{""s, "+0.890625\x14\x14\0+0.890625\x14Lift\x14\0"s};
  const EdfFile file = parse(make_edf(false, "EDF+C", signals, 2, 2, ramp, late));
  ASSERT_EQ(file.events.size(), 1U);
  EXPECT_EQ(file.events[0].time_s, 0.5);
}

TEST(Edf, CountsThatDisagreeAndAFileCutOffAreMended) {
  for (const int said : {-1, 99, 2}) {
    const EdfFile file = parse(make_edf(false, "", kTwo, 3, said, ramp));
    EXPECT_EQ(file.data.sample_count(), said == 2 ? 8 : 12);
    EXPECT_EQ(file.repairs.size(), 2U);
    EXPECT_EQ(std::ranges::count_if(file.repairs, &Repair::lost), said == 99 ? 1 : 0);
  }
  std::string cut = make_edf(false, "", kTwo, 3, 3, ramp);
  cut.resize(cut.size() - 5);
  EXPECT_EQ(parse(cut).data.sample_count(), 8);
  cut.resize(700);
  EXPECT_THROW(static_cast<void>(parse(cut)), ReadError);
}

TEST(Edf, EachRateIsAClockAndTheClockOfTheEmgIsTheFirst) {
  // The EMG is slower than the force: the clock with EMG is the first, as in tables.
  const std::vector<TestSignal> signals{{"Force", "N", -1000, 1000, -1000, 1000, 8},
                                        {"EMG BIC", "uV", -1000, 1000, -1000, 1000, 4},
                                        {"EMG TRI", "uV", -1000, 1000, -1000, 1000, 2},
                                        {"EMG BRA", "uV", -1000, 1000, -1000, 1000, 4}};
  const EdfFile file =
      parse(make_edf(false, "", signals, 2, 2, [](std::size_t s, int i) { return static_cast<int>(100 * s) + i; }));
  ASSERT_EQ(file.data.channel_count(), 2);
  EXPECT_EQ(file.data.channels()[1].name, "EMG BRA");
  EXPECT_NEAR(file.data.series().values()(5, 1), 305e-6, 1e-18);
  ASSERT_EQ(file.other_clocks.size(), 2U);
  EXPECT_EQ(file.other_clocks[0].data.channels()[0], (Channel{"Force", Unit::newton}));
  EXPECT_EQ(file.other_clocks[0].data.sample_count(), 16);
  EXPECT_DOUBLE_EQ(file.other_clocks[0].data.time_s()[9], 9 / 16.0);
  EXPECT_EQ(file.other_clocks[1].data.channels()[0].name, "EMG TRI");
  EXPECT_NEAR(file.other_clocks[1].data.series().values()(3, 0), 203e-6, 1e-18);
  EXPECT_EQ(file.other_clocks[1].has_unit, std::vector<bool>{true});
}

TEST(Edf, ASignThatCannotBeReadBeforeTheVoltIsMicro) {
  for (const char* unit : {".V", "?V", "\xB5V", "\xC2\xB5V", "\xE6V", "uV"}) {
    const EdfFile file = parse(make_edf(false, "", {{"A", unit, -1000, 1000, -1000, 1000, 4}}, 2, 2, ramp));
    EXPECT_EQ(file.data.channels()[0].unit, Unit::volt) << unit;
    EXPECT_NEAR(file.data.series().values()(0, 0), -30e-6, 1e-18) << unit;
  }
  const EdfFile file = parse(make_edf(false, "", {{"A", "a.u.", -1000, 1000, -1000, 1000, 4}}, 2, 2, ramp));
  EXPECT_FALSE(file.has_unit[0]);
  ASSERT_EQ(file.repairs.size(), 1U);
  EXPECT_NE(file.repairs[0].message.find("'a.u.'"), std::string::npos);
}

/// Puts a carriage return before every line feed, as a transfer as text does.
std::string with_returns(const std::string& bytes) {
  std::string text;
  for (const char c : bytes) text += c == '\n' ? "\r\n" : std::string(1, c);
  return text;
}

TEST(Edf, ATransferAsTextIsRefusedWhateverTheNumberOfItsLineFeeds) {
  // Counts of 10 are line feeds: two, and some hundred.
  for (const int records : {1, 100}) {
    for (const int said : {records, -1}) {
      const std::string good =
          make_edf(false, "", kTwo, records, said, [](std::size_t s, int i) { return s == 1 && i % 4 < 2 ? 10 : 50; });
      EXPECT_NO_THROW((void)parse(good));
      if (records == 1 && said < 0) continue;  // two line feeds alone prove nothing where no size is stated
      EXPECT_THROW((void)parse(with_returns(good)), ReadError) << records << " " << said;
    }
  }
  std::string longer = make_edf(false, "", kTwo, 3, 3, ramp) + "abc";
  const EdfFile file = parse(longer);
  EXPECT_EQ(file.data.sample_count(), 12);
  EXPECT_NE(file.repairs[0].message.find("3 bytes"), std::string::npos);
}

TEST(Edf, LostBytesAreFoundByTheStampsOfTheRecords) {
  using namespace std::string_literals;
  auto signals = kTwo;
  signals.push_back({"EDF Annotations", "", -1, 1, -32768, 32767, 20});
  const std::vector<std::string> notes{"+0\x14\x14\0"s, "+0.5\x14\x14\0"s, "+1\x14\x14\0"s};
  std::string bytes = make_edf(false, "EDF+C", signals, 3, 3, ramp, notes);
  EXPECT_EQ(parse(bytes).data.sample_count(), 12);
  EXPECT_EQ(parse(bytes.substr(0, bytes.size() - 7)).data.sample_count(), 8);  // cut off, not shifted
  bytes.erase(256 * 5 + 3, 1);
  EXPECT_THROW((void)parse(bytes), ReadError);
}

TEST(Edf, NoBytesWhateverMakeAnythingButAReadError) {
  const std::string good = make_edf(false, "EDF+C", kTwo, 3, 3, ramp);
  std::mt19937_64 random(11);
  int read = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text = good;
    for (int i = 0; i < 3; ++i) text[random() % text.size()] = "0123456789.-, \0\x14\xFF"[random() % 17];
    try {
      static_cast<void>(parse(text));
      ++read;
    } catch (const ReadError&) {
    }
  }
  EXPECT_GT(read, 500);
}

}  // namespace
}  // namespace myoid::recording
