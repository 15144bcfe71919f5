// `myoid emg` as a user runs it: efforts at the ends of a recording, several files, headers.
#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/math/butterworth.h"
#include "myoid/ground/math/zero_phase.h"

#include "program.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_text;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;
using testing::Not;

constexpr double kRate_hz = 2000.0;

/// Two channels of noise of 150 uV, 20 to 450 Hz, times `strength` from `begin` to `end` and a
/// tenth of that elsewhere, 10 s, as a table.
std::string raw_emg(unsigned seed, int begin, int end, double strength) {
  namespace math = myoid::math;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  constexpr int kSamples = 20000, kMargin = 2000;
  std::vector<Eigen::VectorXd> channels;
  for (int c = 0; c < 2; ++c) {
    Eigen::VectorXd x(kSamples + 2 * kMargin);
    for (double& v : x) v = normal(engine);
    for (const auto& [band, hz] :
         {std::pair{math::FilterBand::high_pass, 20.0}, std::pair{math::FilterBand::low_pass, 450.0}})
      x = math::zero_phase(math::design_butterworth(band, 2, hz, kRate_hz), x);
    Eigen::VectorXd emg = x.segment(kMargin, kSamples);
    emg *= 150.0 * strength / std::sqrt(emg.squaredNorm() / kSamples);
    emg.head(begin) *= 0.1;
    emg.tail(kSamples - end) *= 0.1;
    channels.push_back(emg);
  }
  std::string text = "time [s],left TA [uV],right TA [uV]\n";
  for (int i = 0; i < kSamples; ++i)
    text += fmt::format("{:.4f},{:.3f},{:.3f}\n", i / kRate_hz, channels[0][i], channels[1][i]);
  return text;
}

/// The columns of a storage file after the time.
std::vector<std::vector<double>> columns_of(const std::filesystem::path& file) {
  std::istringstream stream(read_text(file));
  std::string line;
  while (std::getline(stream, line) && line != "endheader") {
  }
  std::getline(stream, line);
  std::vector<std::vector<double>> columns(2);
  double time = 0.0, left = 0.0, right = 0.0;
  while (stream >> time >> left >> right) {
    columns[0].push_back(left);
    columns[1].push_back(right);
  }
  return columns;
}

double mean_of(const std::vector<double>& x, int begin, int end) {
  double sum = 0.0;
  for (int i = begin; i < end; ++i) sum += x.at(static_cast<std::size_t>(i)) / (end - begin);
  return sum;
}

TEST(EmgCommand, AnEffortAtTheEndsOfAFileReadsOne) {
  const TemporaryFolder folder;
  for (const auto& [begin, end] : {std::pair{0, 14000}, {6000, 20000}, {0, 20000}}) {
    write_text(folder / "mvc.csv", raw_emg(static_cast<unsigned>(begin + end), begin, end, 1.0));
    const Finished emg = myoid({"emg", folder / "mvc.csv", "--out", folder / "a.sto", "--overwrite"});
    ASSERT_EQ(emg.exit_code, 0) << emg.err;
    for (const auto& a : columns_of(folder / "a.sto")) {
      EXPECT_LT(*std::max_element(a.begin(), a.end()), 1.3);
      EXPECT_NEAR(mean_of(a, begin, end), 1.0, 0.05);
    }
  }
}

TEST(EmgCommand, SeveralFilesHaveOneReferenceAndTheHeaderSaysHow) {
  const TemporaryFolder folder;
  write_text(folder / "half.csv", raw_emg(1, 4000, 16000, 0.5));
  write_text(folder / "fifth.csv", raw_emg(2, 4000, 16000, 0.2));
  write_text(folder / "mvc_1.csv", raw_emg(3, 4000, 16000, 0.9));
  write_text(folder / "mvc_2.csv", raw_emg(4, 0, 14000, 1.0));
  const Finished emg = myoid({"emg", folder / "half.csv", folder / "fifth.csv", "--mvc", folder / "mvc_1.csv", "--mvc",
                              folder / "mvc_2.csv", "--out", folder / "out", "--envelope", folder / "envelopes"});
  ASSERT_EQ(emg.exit_code, 0) << emg.err;
  EXPECT_THAT(emg.out, HasSubstr("whitened, all channels"));
  EXPECT_THAT(emg.out, HasSubstr("For a methods section: Raw EMG was high-pass filtered"));
  // The efforts are 0.5 and 0.2 of the larger maximal contraction, known to 2 %.
  for (const auto& [name, expected] : {std::pair{"half", 0.5}, {"fifth", 0.2}}) {
    const std::filesystem::path file = folder / "out" / (std::string(name) + ".sto");
    for (const auto& a : columns_of(file)) EXPECT_NEAR(mean_of(a, 5000, 15000), expected, 0.05 * expected) << name;
    const std::string text = read_text(file);
    for (const char* said : {"high-pass filter 20 Hz", "low-pass filter 6 Hz", "rectification",
                             "whitening of all channels", "channel left TA: reference", "mvc_2.csv"})
      EXPECT_THAT(text, HasSubstr(said));
  }
  const std::string envelope = read_text(folder / "envelopes" / "half.sto");
  EXPECT_THAT(envelope, HasSubstr("low-pass filter 6 Hz"));
  EXPECT_THAT(envelope, Not(HasSubstr("channel left TA: reference")));
}

TEST(EmgCommand, WhatCannotBeWrittenIsRefusedBeforehand) {
  const TemporaryFolder folder;
  write_text(folder / "a.csv", raw_emg(1, 4000, 16000, 1.0));
  std::filesystem::create_directory(folder / "b");
  write_text(folder / "b" / "a.csv", raw_emg(2, 4000, 16000, 1.0));
  write_text(folder / "c.csv", raw_emg(2, 4000, 16000, 1.0));
  const Finished same = myoid({"emg", folder / "a.csv", folder / "b" / "a.csv", "--out", folder / "out"});
  EXPECT_EQ(same.exit_code, 3);
  EXPECT_THAT(same.err, HasSubstr("two inputs would be written to"));
  const Finished file = myoid({"emg", folder / "a.csv", folder / "c.csv", "--out", folder / "x.sto"});
  EXPECT_EQ(file.exit_code, 3);
  EXPECT_THAT(file.err, HasSubstr("this is a folder"));
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

}  // namespace
