#include "myoid/study/intake/trial_emg.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"
#include "tests/support/written_trial.h"

namespace myoid::study {
namespace {

using namespace test_trials;

TEST(ReadTrialEmg, AMissingEmgChannelIsNamedWithThoseThereAre) {
  const test::TemporaryFolder folder;
  write_file(folder / "e.sto", "EMG\nendheader\ntime\tBICC\tBRA\tBRD\tTRI\n0\t0\t0\t0\t0\n1\t0\t0\t0\t0\n");
  TrialSpec trial;
  trial.name = "t";
  trial.emg = folder / "e.sto";
  trial.use = Use::mvc;
  const std::string message = message_of([&] { (void)read_trial_input(arm_study(), trial, arm()); });
  EXPECT_NE(message.find("no EMG channel 'BIC'"), std::string::npos) << message;
  EXPECT_NE(message.find("'BICC'"), std::string::npos) << message;
}

TEST(ReadTrialEmg, ChannelsOfSeveralClocksArePutOnTheFastest) {
  const test::TemporaryFolder folder;
  // Sines of 30 Hz at 2000, 1000 and 1250 samples a second, ends apart; an acceleration besides.
  const auto sine = [](double t, double amplitude) {
    return amplitude * std::sin(2.0 * 3.14159265358979323846 * 30.0 * t);
  };
  std::string text = "X[s],\"BIC\",X[s],\"BRA\",X[s],\"BRD\",X[s],\"TRI\",X[s],\"Avanti sensor 1: ACC.X 1\"\n";
  for (int i = 0; i < 4000; ++i) {
    const double fast = i / 2000.0, slow = i / 1000.0, third = i / 1250.0;
    const auto cells = [&](double t, double end, double amplitude) {
      return t < end ? fmt::format("{:.9f},{:.9f},", t, sine(t, amplitude)) : std::string(",,");
    };
    text += cells(fast, 2.0, 1e-4) + cells(slow, 1.9, 2e-4) + cells(third, 1.8, 3e-4) + cells(fast, 2.0, 4e-4) +
            (slow < 1.9 ? fmt::format("{:.9f},1\n", slow) : ",\n");
  }
  write_file(folder / "e.csv", text);
  Study study = arm_study();
  study.emg.kind = EmgKind::raw;
  study.emg.unit = "V";
  TrialSpec trial;
  trial.emg = folder / "e.csv";
  TrialInput input;
  const TimeSeries emg = read_trial_emg(
      study, trial, [](const auto&) {}, input);
  EXPECT_NEAR(emg.mean_rate_hz(), 2000.0, 1e-6);
  EXPECT_NEAR(emg.time_s()[emg.sample_count() - 1], 1.799, 1.1e-3);
  const std::vector<std::string> names{"BIC", "BRA", "BRD", "TRI"};
  for (std::size_t k = 0; k < names.size(); ++k) {
    const Eigen::VectorXd x = emg.column(names[k]);
    const double amplitude = 1e-4 * static_cast<double>(k + 1);
    // Inside: a spline's error of a sine below a tenth of the rate is 0.1 % (recording/signals/resample.h).
    for (Eigen::Index i = 100; i < x.size() - 100; ++i)
      ASSERT_NEAR(x[i], sine(emg.time_s()[i], amplitude), 2e-3 * amplitude) << names[k] << " " << i;
  }
  int moved = 0;
  for (const std::string& note : sentences(input.remarks)) moved += note.find("put on the clock") != std::string::npos;
  EXPECT_EQ(moved, 2);
}

TEST(ReadTrialEmg, EmgThatCoversLessThanHalfOfTheMotionIsRefusedAndALittleLessIsWarnedOf) {
  const Study study = arm_study();
  const std::string message = message_of([&] { (void)WrittenTrial(0.1, 20.0).read(study); });
  EXPECT_NE(message.find("(0 to 49.9 s)"), std::string::npos) << message;
  const TrialInput shorter = WrittenTrial(0.01, 4.0).read(study);
  const std::vector<std::string> warnings = sentences(shorter.remarks, Severity::warning);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("0.99 s"), std::string::npos) << warnings[0];
}

/// What reading the trial's EMG says, when all four channels hold these two values in turn, each
/// for so many samples of 10 ms.
std::string emg_of(const Study& study, double low, double high, int samples = 1, const char* title = "EMG") {
  const test::TemporaryFolder folder;
  std::string text = fmt::format("{}\nendheader\ntime\tBIC\tBRA\tBRD\tTRI\n", title);
  for (int i = 0; i < 300; ++i) {
    const double v = i / samples % 2 == 0 ? low : high;
    text += fmt::format("{0}\t{1}\t{1}\t{1}\t{1}\n", 0.01 * i, v);
  }
  write_file(folder / "e.sto", text);
  TrialSpec trial;
  trial.emg = folder / "e.sto";
  TrialInput input;
  return message_of([&] {
    (void)read_trial_emg(
        study, trial, [](const auto&) {}, input);
  });
}

TEST(ReadTrialEmg, AnEnvelopeMayRingBelowZeroButNotSwingAboutIt) {
  EXPECT_EQ(emg_of(arm_study(), -0.1, 1.0), "(no error)");
  EXPECT_NE(emg_of(arm_study(), -0.9, 1.0).find("raw EMG"), std::string::npos);
}

TEST(ReadTrialEmg, AnEnvelopeThatIsCalledRawIsRefused) {
  Study study = arm_study();
  study.emg.kind = EmgKind::raw;
  study.emg.unit = "V";
  EXPECT_EQ(emg_of(study, -1e-4, 1e-4), "(no error)");
  EXPECT_EQ(emg_of(study, 2.0, 2.1), "(no error)");  // a converter without negative numbers
  const std::string message = emg_of(study, 0.0, 1e-4, 20);
  EXPECT_NE(message.find("set [emg] kind = \"envelope\""), std::string::npos) << message;
}

TEST(ReadTrialEmg, RawEmgBeyondAmplifiersIsRefusedUntilTheStudySaysItsUnit) {
  Study study = arm_study();
  study.emg.kind = EmgKind::raw;
  study.emg.unit = "V";
  EXPECT_NE(emg_of(study, -1e27, 1e27).find("1e+27 V"), std::string::npos);
  for (const double counts : {32768.0, 300.0, 11.0}) {
    study.emg.unit = "V";
    EXPECT_NE(emg_of(study, -counts, counts), "(no error)") << counts;
    study.emg.unit = "uV";
    EXPECT_EQ(emg_of(study, -counts, counts), "(no error)") << counts;
    EXPECT_EQ(emg_of(study, -counts, counts, 1, "EMG in V"), "(no error)") << counts;
  }
}

TEST(ReadTrialEmg, AnActivationInPercentIsRefused) {
  Study study = arm_study();
  study.emg.kind = EmgKind::activation;
  EXPECT_EQ(emg_of(study, 0.0, 1.0), "(no error)");
  EXPECT_NE(emg_of(study, 0.0, 60.0).find("percent?"), std::string::npos);
}

}  // namespace
}  // namespace myoid::study
