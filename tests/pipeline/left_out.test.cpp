// A left-out R2 is that of a fit that did not see the trial: of a run or fit that holds the trial back.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"
#include "tests/support/data_folder.h"
#include "tests/support/measured_columns.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_law.h"

namespace {

using myoid::test::between;
using myoid::test::envelope;
using myoid::test::Finished;
using myoid::test::greatest;
using myoid::test::moving_mean;
using myoid::test::myoid;
using myoid::test::Numbers;
using myoid::test::read_columns;
using myoid::test::read_rows;
using myoid::test::read_text;
using myoid::test::Row;
using myoid::test::TemporaryFolder;
using myoid::test::tension;
using myoid::test::TibialisTorque;
using myoid::test::write_text;
namespace fs = std::filesystem;

/// A fold predicts by the mode of its fit, a fit by the mean of its marginals.
constexpr double kAlike = 0.04;

nlohmann::json json_of(const fs::path& file) { return nlohmann::json::parse(read_text(file)); }

/// One trial's files as `identify` takes them.
struct TrialFiles {
  fs::path activations, lengths, velocities, arms, torques;
  std::string torque_column;
};

/// Runs `identify` on some of the trials; what it prints.
Finished identify(const fs::path& muscles_csv,
                  const std::vector<TrialFiles>& trials,
                  const std::string& out,
                  const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{
      "identify", "--muscles", muscles_csv.string(), "--coordinate", trials[0].torque_column, "--out", out};
  const auto add = [&](const char* option, fs::path TrialFiles::*file) {
    arguments.emplace_back(option);
    for (const TrialFiles& t : trials) arguments.push_back((t.*file).string());
  };
  add("--activations", &TrialFiles::activations);
  add("--lengths", &TrialFiles::lengths);
  add("--velocities", &TrialFiles::velocities);
  add("--moment-arms", &TrialFiles::arms);
  add("--torques", &TrialFiles::torques);
  arguments.insert(arguments.end(), more.begin(), more.end());
  return myoid(arguments);
}

/// Every left-out R2 of `identify` against that of a fit to which the trial was not given but for its prediction.
void expect_reproducible(const fs::path& muscles_csv,
                         const std::vector<TrialFiles>& trials,
                         const TemporaryFolder& folder) {
  const Finished all = identify(muscles_csv, trials, folder / "all");
  ASSERT_NE(all.exit_code, 3) << all.err;
  const nlohmann::json folds = json_of(folder / "all/parameters.json").at("leave_one_trial_out");
  ASSERT_EQ(folds.size(), trials.size());
  for (std::size_t left = 0; left < trials.size(); ++left) {
    const std::string out = folder / fmt::format("without_{}", left);
    const std::string number = std::to_string(left + 1);
    ASSERT_NE(identify(muscles_csv, trials, out, {"--folds", "none", "--validate", number}).exit_code, 3);
    const std::vector<Row> predictions = read_rows(fs::path(out) / "predictions.csv");
    ASSERT_EQ(predictions.size(), 1U);
    EXPECT_EQ(predictions[0].at("fitted"), "false");
    const double without = std::stod(predictions[0].at("r2"));
    EXPECT_NEAR(folds[left].at("identified").at("r2").get<double>(), without, kAlike) << "without trial " << number;
    // The trial spoils no fit that does not see it.
    std::vector<TrialFiles> others = trials;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
    if (left > 0) continue;
    ASSERT_NE(identify(muscles_csv, others, folder / "others", {"--folds", "none"}).exit_code, 3);
    EXPECT_EQ(read_text(folder / "others/parameters.csv"), read_text(fs::path(out) / "parameters.csv"));
  }
}

std::string storage(const std::string& names, const std::vector<std::string>& rows) {
  std::string text = fmt::format(
      "made elsewhere\nversion=1\nnRows={}\nnColumns={}\n"
      "inDegrees=no\nendheader\n{}\n",
      rows.size(), std::count(names.begin(), names.end(), '\t') + 1, names);
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

/// Two muscles against each other whose torque this law makes, and something that is none of theirs.
TrialFiles write_trial(const TemporaryFolder& folder, int number) {
  const std::string n = std::to_string(number);
  const std::vector<Numbers> muscles{{{{"max_isometric_force", 900.0},
                                       {"optimal_fiber_length", 0.11},
                                       {"force_length_width", 0.05},
                                       {"concentric_curvature", 0.3},
                                       {"eccentric_curvature_product", 0.1},
                                       {"eccentric_plateau", 1.4},
                                       {"max_shortening_speed", 1.1},
                                       {"tendon_slack_length", 0.2}}},
                                     {{{"max_isometric_force", 1500.0},
                                       {"optimal_fiber_length", 0.1},
                                       {"force_length_width", 0.05},
                                       {"concentric_curvature", 0.25},
                                       {"eccentric_curvature_product", 0.1},
                                       {"eccentric_plateau", 1.3},
                                       {"max_shortening_speed", 1.0},
                                       {"tendon_slack_length", 0.15}}}};
  std::vector<std::string> a, l, v, r, t;
  const double w = 1.2 + 0.7 * number;
  const auto u = [&](int k, double s) {
    return 0.35 + 0.2 * std::sin((2.1 - k) * s + k + number) + 0.1 * std::sin(5.3 * s + 2 * k);
  };
  for (int i = 0; i <= 1200; ++i) {
    const double s = 0.01 * i, swing = 0.02 * std::sin(w * s), rate = 0.02 * w * std::cos(w * s);
    const double l1 = 0.31 + swing, l2 = 0.25 - 0.8 * swing;
    const double arm = 0.03 + 0.008 * std::sin(w * s);
    const double torque = arm * tension(u(0, s - 0.06), l1, rate, muscles[0]) -
                          0.024 * tension(u(1, s - 0.06), l2, -0.8 * rate, muscles[1]) +
                          0.8 * std::sin(0.9 * s + number) + 0.5 * std::sin(2.3 * s * number);
    a.push_back(fmt::format("{}\t{}\t{}", s, u(0, s), u(1, s)));
    l.push_back(fmt::format("{}\t{}\t{}", s, l1, l2));
    v.push_back(fmt::format("{}\t{}\t{}", s, rate, -0.8 * rate));
    r.push_back(fmt::format("{}\t{}\t-0.024", s, arm));
    t.push_back(fmt::format("{}\t{}", s, torque));
  }
  const TrialFiles files{folder / ("a" + n + ".sto"), folder / ("l" + n + ".sto"), folder / ("v" + n + ".sto"),
                         folder / ("r" + n + ".sto"), folder / ("t" + n + ".sto"), "elbow"};
  const std::string names = "time\tA\tB";
  write_text(files.activations, storage(names, a));
  write_text(files.lengths, storage(names, l));
  write_text(files.velocities, storage(names, v));
  write_text(files.arms, storage(names, r));
  write_text(files.torques, storage("time\telbow", t));
  return files;
}

TEST(LeftOut, R2OfIdentifyIsThatOfAFitWithoutTheTrial) {
  const TemporaryFolder folder;
  write_text(folder / "muscles.csv",
             "muscle,max_isometric_force,optimal_fiber_length,force_length_width,"
             "concentric_curvature,eccentric_slope_ratio,eccentric_plateau,max_shortening_speed,"
             "tendon_slack_length\n"
             "A,700,0.12,0.054,0.28,1.5,1.4,1.2,0.2\nB,1800,0.095,0.043,0.28,1.5,1.4,0.95,0.15\n");
  std::vector<TrialFiles> trials;
  for (int i = 1; i <= 3; ++i) trials.push_back(write_trial(folder, i));
  expect_reproducible(folder / "muscles.csv", trials, folder);
}

/// Writes the files of stretches and fixed efforts at an ankle's dynamometer: fiber lengths by
/// ultrasound and their rates, the authors' moment arms, envelopes relative to the greatest of all.
std::vector<TrialFiles> write_ankle_trials(const fs::path& data, const TemporaryFolder& folder) {
  constexpr double kEmg_hz = 2000.0, kStep_s = 0.01, kOffset_deg = 15.0;
  constexpr std::size_t kEmgPerStep = 20;
  const std::vector<std::string> names{"PL_0_01", "PL_50_01", "PL_50_03", "PL_100_01", "Ref_Long_01", "Ref_Long_02"};
  const TibialisTorque tibialis(data);
  const auto arm_cm = read_columns(data / "ta_moment_arm.csv", 1);
  std::vector<std::vector<double>> envelopes;
  double most = 0.0;
  for (const std::string& name : names) {
    envelopes.push_back(envelope(read_columns(data / (name + "_emg.csv"), 1)[1], kEmg_hz));
    most = std::max(most, greatest(envelopes.back(), kEmg_hz));
  }
  std::vector<TrialFiles> trials;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto d = read_columns(data / (names[k] + "_dynamometer.csv"), 1);
    const auto f = read_columns(data / (names[k] + "_fascicle.csv"), 1);
    const auto count = static_cast<std::size_t>((f[0].back() - f[0].front()) / kStep_s);
    std::vector<double> length;
    for (std::size_t i = 0; i < count; ++i)
      length.push_back(1e-3 * between(f[0], f[1], f[0][0] + kStep_s * static_cast<double>(i)));
    length = moving_mean(moving_mean(length, 10), 10);  // frames of 30 ms
    std::vector<std::string> a, l, v, r, t;
    for (std::size_t i = 0; kEmgPerStep * i < envelopes[k].size(); ++i)
      a.push_back(fmt::format("{}\t{}", kStep_s * static_cast<double>(i), envelopes[k][kEmgPerStep * i] / most));
    for (std::size_t i = 0; i < count; ++i) {
      const double s = f[0][0] + kStep_s * static_cast<double>(i), crank = between(d[0], d[2], s);
      const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(count - 1, i + 1);
      const double rate = (length[after] - length[before]) / (kStep_s * static_cast<double>(after - before));
      l.push_back(fmt::format("{}\t{}", s, length[i]));
      v.push_back(fmt::format("{}\t{}", s, rate));
      r.push_back(fmt::format("{}\t{}", s, 1e-2 * between(arm_cm[0], arm_cm[2], crank + kOffset_deg)));
      t.push_back(fmt::format("{}\t{}", s, tibialis(between(d[0], d[1], s), crank)));
    }
    const auto write = [&](const char* kind, const char* column, const auto& rows) {
      const fs::path file = folder / (names[k] + kind + ".sto");
      write_text(file, storage(std::string("time\t") + column, rows));
      return file;
    };
    trials.push_back({write("_a", "TA", a), write("_l", "TA", l), write("_v", "TA", v), write("_r", "TA", r),
                      write("_t", "ankle", t), "ankle"});
  }
  return trials;
}

TEST(LeftOut, R2OfStretchesAtAnAnkleIsThatOfAFitWithoutTheTrial) {
  const fs::path data = myoid::test::data_folder() / "tecchio-ankle";
  MYOID_REQUIRE_DATA(data);
  const TemporaryFolder folder;
  write_text(folder / "muscles.csv",
             "muscle,max_isometric_force,optimal_fiber_length,force_length_width,"
             "concentric_curvature,eccentric_slope_ratio,eccentric_plateau,max_shortening_speed\n"
             "TA,905,0.068,0.0306,0.28,1.5,1.4,0.68\n");
  expect_reproducible(folder / "muscles.csv", write_ankle_trials(data, folder), folder);
}

/// A virtual person with a few seconds of several movements.
const std::string kProtocol = "name = \"short\"\n" + std::string(myoid::test::kTwoSpeeds) + R"([[trial]]
name = "lower"
kind = "eccentric"
held_mass_kg = 3.0
)";

TEST(LeftOut, R2OfRunIsThatOfAStudyThatHoldsTheTrialBack) {
  const TemporaryFolder folder;
  write_text(folder / "p.toml", kProtocol);
  ASSERT_EQ(myoid({"twin", "--protocol", folder / "p.toml", "--seed", "3", "--out", folder / "rec"}).exit_code, 0);
  const fs::path study = fs::path(folder / "rec") / "study.toml";
  const Finished whole = myoid({"run", study.string(), "--out", folder / "all"});
  ASSERT_NE(whole.exit_code, 3) << whole.err;
  const nlohmann::json folds = json_of(folder / "all/parameters.json").at("leave_one_trial_out");
  ASSERT_EQ(folds.size(), 3U);
  const std::string text = read_text(study);
  for (const auto& fold : folds) {
    const std::string trial = fold.at("trial");
    write_text(study, text);
    const std::size_t use = text.find("use = ", text.find("name = \"" + trial + "\""));
    std::string held = text;
    held.replace(use, text.find('\n', use) - use, "use = \"validation\"");
    write_text(study, held);
    const fs::path run = folder / ("without_" + trial);
    const Finished done = myoid({"run", study.string(), "--out", run.string()});
    ASSERT_NE(done.exit_code, 3) << done.err;
    const double printed = fold.at("identified").at("r2").get<double>();
    const nlohmann::json held_back = json_of(run / "parameters.json");
    for (const auto& method : held_back.at("methods")) {
      if (method.at("method") != "torque") continue;
      for (const auto& of_trial : method.at("trials")) {
        if (of_trial.at("trial") != trial) continue;
        EXPECT_NEAR(of_trial.at("r2").get<double>(), printed, kAlike) << trial;
      }
    }
  }
}

TEST(LeftOut, BlocksOfTrialsThatAreTooShortAreRefusedWithTheReason) {
  const TemporaryFolder folder;
  write_text(folder / "muscles.csv",
             "muscle,max_isometric_force,optimal_fiber_length,force_length_width,"
             "concentric_curvature,eccentric_slope_ratio,eccentric_plateau,max_shortening_speed,"
             "tendon_slack_length\n"
             "A,700,0.12,0.054,0.28,1.5,1.4,1.2,0.2\nB,1800,0.095,0.043,0.28,1.5,1.4,0.95,0.15\n");
  const std::vector<TrialFiles> trials{write_trial(folder, 1), write_trial(folder, 2)};
  const Finished few =
      identify(folder / "muscles.csv", trials, folder / "few", {"--folds", "block", "--end", "2.5", "--verbose"});
  EXPECT_NE(few.exit_code, 3) << few.err;
  EXPECT_NE(few.out.find("no trial has the 3.3 s from which blocks are left out"), std::string::npos) << few.out;
  const Finished enough =
      identify(folder / "muscles.csv", trials, folder / "enough", {"--folds", "block", "--end", "5", "--verbose"});
  EXPECT_NE(enough.out.find("block 5 of 5"), std::string::npos) << enough.out << enough.err;
}

}  // namespace
