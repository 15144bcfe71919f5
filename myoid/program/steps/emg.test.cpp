#include "myoid/program/steps/emg.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/program/steps/emg_input.h"

#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(EmgFunction, SeveralInputsHaveAFileEachInAFolder) {
  const test::TemporaryFolder folder;
  const auto files = [&](std::vector<std::string> in, const std::string& out) {
    EmgOptions o;
    o.in = std::move(in);
    o.out = out.empty() ? "" : (folder / out).string();
    return emg_files(o).activations;
  };
  EXPECT_THAT(files({"a.c3d"}, ""), ElementsAre());
  EXPECT_THAT(files({"a.c3d"}, "x.csv"), ElementsAre((folder / "x.csv").string()));
  EXPECT_THAT(files({"p/a.c3d", "b.c3d"}, "x"),
              ElementsAre((folder / "x/a.sto").string(), (folder / "x/b.sto").string()));
  EXPECT_THROW((void)files({"p/a.c3d", "q/a.c3d"}, "x"), InvalidInput);
  EXPECT_THROW((void)files({"a.c3d", "b.c3d"}, "x.csv"), InvalidInput);
}

/// Four seconds of two channels at 1000 Hz: bursts of an 80 Hz tone, and a silent wire.
std::string two_channels() {
  std::string text = "time,BIC [V],TRI [V]\n";
  for (int i = 0; i < 4000; ++i) {
    const double t = 0.001 * i;
    const double burst = t > 1.0 && t < 3.0 ? 1e-3 : 1e-5;
    text += std::to_string(t) + "," + std::to_string(burst * std::sin(500.0 * t)) + ",0\n";
  }
  return text;
}

TEST(EmgFunction, AWarningIsToldAlthoughALaterFileIsRefused) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.csv", two_channels());
  EmgOptions o;
  o.in = {folder / "a.csv"};
  o.chain.whitening = false;
  std::vector<std::string> heard;
  o.call.listener = [&](const Remark& remark) { heard.push_back(remark.says); };
  const EmgResult result = emg(o);
  ASSERT_EQ(result.activations.size(), 1U);
  EXPECT_TRUE(result.envelopes.empty());
  ASSERT_EQ(result.activations[0].channel_count(), 1);
  // The mean of half a second of the largest effort is 1.
  EXPECT_NEAR(result.activations[0].values().col(0).segment(1500, 1000).mean(), 1.0, 0.05);
  ASSERT_FALSE(heard.empty());
  EXPECT_EQ(heard.size(), result.remarks.size());
  heard.clear();
  o.mvc = {folder / "missing.csv"};
  EXPECT_THROW((void)emg(o), ReadError);
  EXPECT_THAT(heard, testing::Contains(HasSubstr("'TRI' has the same value throughout")));
}

/// The two channels with three seconds without samples behind the first two.
std::string with_a_pause() {
  std::mt19937_64 engine(5);
  std::normal_distribution<double> normal;
  std::string text = "time,BIC [V]\n";
  for (int i = 0; i < 4000; ++i) {
    const double burst = i % 2000 > 500 && i % 2000 < 1500 ? 1e-3 : 1e-5;
    text += fmt::format("{},{}\n", 0.001 * i + (i < 2000 ? 0.0 : 3.0), burst * normal(engine));
  }
  return text;
}

TEST(EmgFunction, APartBeforeOrBehindAPauseIsTaken) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.csv", with_a_pause());
  EmgOptions o;
  o.in = {folder / "a.csv"};
  o.chain.whitening = false;
  EXPECT_THROW((void)emg(o), ReadError);
  o.call.end_s = 1.5;
  const EmgResult before = emg(o);
  EXPECT_NEAR(before.activations[0].time_s().tail(1)[0], 1.5, 1e-9);
  o.call.end_s = 3.5;  // within the pause
  EXPECT_EQ(emg(o).activations[0].sample_count(), 2000);
  o.call.end_s.reset();
  o.call.start_s = 5.5;
  EXPECT_NEAR(emg(o).activations[0].time_s()[0], 5.5, 1e-9);
  o.call.start_s = 1.0;
  EXPECT_THROW((void)emg(o), ReadError);
}

TEST(EmgFunction, UnevenSamplesAreRefusedWithTheNameOfTheFile) {
  const test::TemporaryFolder folder;
  std::string text = "time,BIC [V]\n";
  for (int i = 0; i < 4000; ++i) text += fmt::format("{:.4f},{}\n", 0.001 * i + 0.0003 * (i % 2), i % 7 - 3);
  write_file(folder / "a.csv", text);
  EmgOptions o;
  o.in = {folder / "a.csv"};
  try {
    (void)emg(o);
    FAIL() << "not refused";
  } catch (const ReadError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("a.csv: the samples are not evenly"), HasSubstr("--rate")));
  }
}

TEST(EmgFunction, AClockInMillisecondsIsRefusedBeforeAnyFilter) {
  const test::TemporaryFolder folder;
  std::string text = "time [s],BIC [V]\n";
  for (int i = 0; i < 4000; ++i) text += fmt::format("{},{}\n", i, i * i % 7 - 3);
  write_file(folder / "a.csv", text);
  EmgOptions o;
  o.in = {folder / "a.csv"};
  EXPECT_THROW((void)emg(o), ReadError);
}

/// Four seconds at 2000 Hz: noise of 200 uV in bursts on BIC, with a spike if there is one, and 2 uV throughout on TRI.
std::string burst_and_noise(double spike_v) {
  std::mt19937_64 engine(3);
  std::normal_distribution<double> normal;
  std::string text = "time,BIC [V],TRI [V]\n";
  for (int i = 0; i < 8000; ++i) {
    const double bic = (i > 2000 && i < 6000 ? 2e-4 : 5e-6) * normal(engine);
    text += fmt::format("{},{},{}\n", 0.0005 * i, i == 4001 && spike_v > 0.0 ? spike_v : bic, 2e-6 * normal(engine));
  }
  return text;
}

TEST(EmgFunction, ASpikeChangesNothingAndNoiseIsLeftOut) {
  const test::TemporaryFolder folder;
  EmgOptions o;
  o.chain.whitening = false;
  std::vector<EmgResult> results;
  for (const double spike_v : {0.0, 0.05}) {
    write_file(folder / "a.csv", burst_and_noise(spike_v));
    o.in = {folder / "a.csv"};
    results.push_back(emg(o));
    ASSERT_EQ(results.back().normalisation.size(), 1U);
    EXPECT_EQ(results.back().activations[0].channels()[0].name, "BIC");
  }
  // The line takes the place of one sample of 2000.
  EXPECT_NEAR(results[1].normalisation[0].reference_v / results[0].normalisation[0].reference_v, 1.0, 2e-3);
  const auto says = [](const EmgResult& result, const char* what) {
    return std::any_of(result.remarks.begin(), result.remarks.end(),
                       [&](const Remark& r) { return r.says.find(what) != std::string::npos; });
  };
  EXPECT_TRUE(says(results[0], "'TRI' never rises"));
  EXPECT_FALSE(says(results[0], "spike"));
  EXPECT_TRUE(says(results[1], "'BIC' has a spike of 50 mV at 2.0005 s"));
  EXPECT_NE(results[1].chain.steps[0].find("1 in BIC"), std::string::npos) << results[1].chain.steps[0];
  o.channels = {"TRI"};
  EXPECT_THROW((void)emg(o), InvalidInput);
}

TEST(EmgFunction, MeasuresHaveOnsetRmsAndMedianFrequency) {
  // A tone of 79.6 Hz and 1 mV from 1 to 3 s.
  const test::TemporaryFolder folder;
  write_file(folder / "a.csv", two_channels());
  EmgOptions o;
  o.in = {folder / "a.csv"};
  o.chain.whitening = false;
  o.measure_window_s = 0.5;
  const EmgResult result = emg(o);
  ASSERT_EQ(result.measures.size(), 1U);
  EXPECT_EQ(result.measures[0].channel, "BIC");
  ASSERT_EQ(result.measures[0].bursts.size(), 1U);
  const recording::EmgWindow& burst = result.measures[0].bursts[0];
  EXPECT_NEAR(burst.begin_s, 1.0, 0.03);
  EXPECT_NEAR(burst.end_s, 3.0, 0.03);
  EXPECT_NEAR(burst.rms, 1e-3 / std::sqrt(2.0), 0.03e-3);
  EXPECT_NEAR(burst.median_frequency_hz, 79.6, 4.0);
  EXPECT_EQ(result.measures[0].windows.size(), 8U);
  o.measures = folder / "m.csv";
  write_emg(result, emg_files(o));
  EXPECT_TRUE(std::filesystem::exists(folder / "m.csv"));
}

TEST(GroupedWarnings, WhatIsAlikeIsSaidOnceWithTheOtherPlaces) {
  Remarks remarks{Call{}};
  {
    GroupedWarnings warnings(remarks);
    warnings.add(RemarkCode::emg_hum, "a 'BIC'", "channels", "a: channel 'BIC' hums");
    warnings.add(RemarkCode::emg_hum, "a 'TRI'", "channels", "a: channel 'TRI' hums");
    EXPECT_TRUE(remarks.list().empty());
  }
  ASSERT_EQ(remarks.list().size(), 1U);
  EXPECT_EQ(remarks.list()[0].says, "a: channel 'BIC' hums");
  EXPECT_EQ(remarks.list()[0].likewise, std::vector<std::string>{"a 'TRI'"});
}

}  // namespace
}  // namespace myoid::program
