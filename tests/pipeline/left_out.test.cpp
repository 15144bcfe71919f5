// A left-out R2 is that of a fit that did not see the trial (inference.md, findings E2): it is
// computed anew here from the parameters.csv of a run without the trial, by a law written anew.
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
using myoid::test::follow;
using myoid::test::greatest;
using myoid::test::moving_mean;
using myoid::test::myoid;
using myoid::test::Numbers;
using myoid::test::read_columns;
using myoid::test::read_rows;
using myoid::test::read_table;
using myoid::test::read_text;
using myoid::test::Row;
using myoid::test::Table;
using myoid::test::TemporaryFolder;
using myoid::test::tension;
using myoid::test::TibialisTorque;
using myoid::test::write_text;
namespace fs = std::filesystem;

/// Both are of the same numbers: what is left are linear interpolation and the steps of its lags.
constexpr double kSame = 1e-3;

nlohmann::json json_of(const fs::path& file) { return nlohmann::json::parse(read_text(file)); }

/// Estimates of method torque in a parameters.csv, by muscle, channel, joint or "subject".
std::map<std::string, Numbers> estimates(const fs::path& file) {
  std::map<std::string, Numbers> found;
  for (const Row& row : read_rows(file)) {
    if (row.at("method") == "torque" && !row.at("estimate").empty())
      found[row.at("muscle")].value[row.at("parameter")] = std::stod(row.at("estimate"));
  }
  return found;
}

bool shares_lags(const fs::path& parameters_json) {
  const nlohmann::json parameters = json_of(parameters_json);
  for (const auto& method : parameters.at("methods")) {
    if (method.at("method") == "torque") return method.at("emg_lag") == "shared";
  }
  return false;
}

/// One trial's files as `identify` takes them.
struct TrialFiles {
  fs::path activations, lengths, velocities, arms, torques;
  std::string torque_column;
};

/// Torque of the muscles of a trial, with muscles.csv for what was held.
std::vector<double> predicted(const TrialFiles& trial,
                              const fs::path& muscles_csv,
                              const fs::path& parameters_csv,
                              bool shared) {
  const std::map<std::string, Numbers> fitted = estimates(parameters_csv);
  const Table a = read_table(trial.activations), l = read_table(trial.lengths), v = read_table(trial.velocities),
              r = read_table(trial.arms);
  const std::vector<double>& time = l.of("time");
  std::vector<double> torque(time.size(), 0.0);
  for (const Row& row : read_rows(muscles_csv)) {
    const std::string& name = row.at("muscle");
    Numbers m;
    for (const auto& [key, cell] : row) {
      if (key != "muscle" && key != "emg" && !cell.empty() && cell != "true") m.value[key] = std::stod(cell);
    }
    for (const auto& [key, value] : fitted.at(name).value) m.value[key] = value;
    const double delay_s = fitted.at("subject").value.at("emg_delay");
    const std::vector<double> active = follow(a.of("time"), a.of(name), time, delay_s, shared);
    for (std::size_t i = 0; i < time.size(); ++i)
      torque[i] += between(r.of("time"), r.of(name), time[i]) *
                   tension(active[i], l.of(name)[i], between(v.of("time"), v.of(name), time[i]), m);
  }
  return torque;
}

/// Runs `identify` on some of the trials; what it prints.
Finished identify(const fs::path& muscles_csv,
                  const std::vector<TrialFiles>& trials,
                  const std::string& out,
                  const std::vector<std::string>& more = {}) {
  std::vector<std::string> arguments{
      "identify", "--muscles", muscles_csv.string(), "--coordinate", trials[0].torque_column,
      "--out",    out,         "--estimator",        "least_squares"};
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

/// Every left-out R2 of `identify` against the law with the parameters of a run without the trial.
void expect_reproducible(const fs::path& muscles_csv,
                         const std::vector<TrialFiles>& trials,
                         const TemporaryFolder& folder) {
  const Finished all = identify(muscles_csv, trials, folder / "all");
  ASSERT_NE(all.exit_code, 3) << all.err;
  const nlohmann::json folds = json_of(folder / "all/parameters.json").at("leave_one_trial_out");
  ASSERT_EQ(folds.size(), trials.size());
  for (std::size_t left = 0; left < trials.size(); ++left) {
    std::vector<TrialFiles> others = trials;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left));
    const std::string out = folder / fmt::format("without_{}", left);
    ASSERT_NE(identify(muscles_csv, others, out, {"--folds", "none"}).exit_code, 3);
    const std::vector<double> torque = predicted(trials[left], muscles_csv, fs::path(out) / "parameters.csv",
                                                 shares_lags(fs::path(out) / "parameters.json"));
    const Table measured = read_table(trials[left].torques);
    std::vector<double> on_clock;
    const Table lengths = read_table(trials[left].lengths);
    for (const double t : lengths.of("time"))
      on_clock.push_back(between(measured.of("time"), measured.of(trials[left].torque_column), t));
    EXPECT_NEAR(folds[left].at("identified").at("r2").get<double>(), myoid::test::r2_of(on_clock, torque), kSame)
        << "without trial " << left + 1;
    // fold_parameters.csv has the same numbers.
    const std::string name = folds[left].at("trial");
    const std::map<std::string, Numbers> alone = estimates(fs::path(out) / "parameters.csv");
    int compared = 0;
    for (const Row& row : read_rows(folder / "all/fold_parameters.csv")) {
      if (row.at("left_out") != name) continue;
      const double value = alone.at(row.at("muscle")).value.at(row.at("parameter"));
      EXPECT_NEAR(std::stod(row.at("estimate")), value, 1e-6 * std::abs(value) + 1e-9);
      ++compared;
    }
    EXPECT_GT(compared, 5);
    if (left > 0) continue;
    // --validate is the same fit, and predicts the trial by the law.
    const std::string held = folder / "held";
    ASSERT_NE(identify(muscles_csv, trials, held, {"--folds", "none", "--validate", "1"}).exit_code, 3);
    const std::map<std::string, Numbers> fitted = estimates(fs::path(held) / "parameters.csv");
    ASSERT_EQ(fitted.size(), alone.size());
    for (const auto& [owner, numbers] : alone) {
      for (const auto& [parameter, value] : numbers.value)
        EXPECT_NEAR(fitted.at(owner).value.at(parameter), value, 1e-6 * std::abs(value) + 1e-9);
    }
    const std::vector<Row> predictions = read_rows(fs::path(held) / "predictions.csv");
    ASSERT_EQ(predictions.size(), 1U);
    EXPECT_EQ(predictions[0].at("fitted"), "false");
    EXPECT_NEAR(std::stod(predictions[0].at("r2")), myoid::test::r2_of(on_clock, torque), kSame);
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

TEST(LeftOut, R2OfAWalkingLegIsThatOfAFitWithoutTheTrial) {
  const fs::path data = myoid::test::data_folder() / "ceinms-rt-leg";
  MYOID_REQUIRE_DATA(data);
  const TemporaryFolder folder;
  std::vector<TrialFiles> trials;
  for (const std::string walk : {"walk36", "walk45"}) {
    const fs::path out = folder / walk;
    const Finished paths =
        myoid({"paths", "--model", (data / "gait2392.osim").string(), "--motion", (data / walk / "ik.sto").string(),
               "--lowpass", "6", "--start", "5", "--end", "13", "--out", out.string()});
    ASSERT_EQ(paths.exit_code, 0) << paths.err;
    trials.push_back({data / walk / "emgFilt.sto", out / "MuscleAnalysis_Length.sto",
                      out / "MuscleAnalysis_MuscleTendonVelocity.sto",
                      out / "MuscleAnalysis_MomentArm_ankle_angle_r.sto", data / walk / "id.sto",
                      "ankle_angle_r_moment"});
  }
  expect_reproducible(data / "muscles.csv", trials, folder);
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
const char* const kProtocol = R"(
name = "short"
level = "L1"
[[trial]]
name = "mvc"
kind = "mvc"
direction = "both"
[[trial]]
name = "slow"
kind = "flexion"
frequency_hz = 0.4
centre_deg = 72
amplitude_deg = 45
held_mass_kg = 2.0
duration_s = 8
[[trial]]
name = "fast"
kind = "flexion"
frequency_hz = 0.8
centre_deg = 72
amplitude_deg = 50
held_mass_kg = 1.0
duration_s = 8
[[trial]]
name = "lower"
kind = "eccentric"
held_mass_kg = 3.0
)";

/// A property of a muscle in a model's file.
double property(const std::string& osim, const std::string& muscle, const std::string& name) {
  const std::size_t at = osim.find("<" + name + ">", osim.find("name=\"" + muscle + "\""));
  return std::stod(osim.substr(at + name.size() + 2));
}

/// R2 of a trial of a finished run by the law with that run's parameters.
double r2_by_law(const fs::path& run, const fs::path& model, const std::string& trial) {
  const std::string joint = "elbow_flexion", osim = read_text(model);
  const std::map<std::string, Numbers> fitted = estimates(run / "parameters.csv");
  const bool shared = shares_lags(run / "parameters.json");
  const fs::path place = run / trial;
  const Table a = read_table(place / "activation.sto");
  const Table l = read_table(place / "MuscleAnalysis_Length.sto");
  const Table v = read_table(place / "MuscleAnalysis_MuscleTendonVelocity.sto");
  const Table r = read_table(place / ("MuscleAnalysis_MomentArm_" + joint + ".sto"));
  const Table q = read_table(place / "ik.mot"), id = read_table(place / "id.sto");
  const std::vector<double>& time = l.of("time");
  std::vector<double> torque(time.size(), 0.0), measured;
  for (const double t : time) measured.push_back(between(id.of("time"), id.of(joint + "_moment"), t));
  for (const auto& [name, numbers] : fitted) {
    if (!numbers.value.contains("max_isometric_force")) continue;
    const bool own = std::find(a.names.begin(), a.names.end(), name) != a.names.end();
    const std::string electrode = own ? name : "BIC";
    Numbers m = numbers;
    m.value["tendon_slack_length"] = property(osim, name, "tendon_slack_length");
    if (!m.value.contains("max_shortening_speed"))
      m.value["max_shortening_speed"] =
          property(osim, name, "max_contraction_velocity") * property(osim, name, "optimal_fiber_length");
    const std::vector<double> u =
        follow(a.of("time"), a.of(electrode), time, fitted.at("subject").value.at("emg_delay"), shared);
    const Numbers& channel = fitted.at(electrode);
    for (std::size_t i = 0; i < time.size(); ++i) {
      const double active = channel.get("emg_gain", 1.0) * std::pow(u[i], channel.get("emg_exponent", 1.0));
      torque[i] += between(r.of("time"), r.of(name), time[i]) * tension(active, l.of(name)[i], v.of(name)[i], m);
    }
  }
  if (const auto of_joint = fitted.find(joint); of_joint != fitted.end()) {
    constexpr double kDegree = 3.14159265358979323846 / 180.0, kStep_s = 0.01;
    const auto angle = [&](double t) { return kDegree * between(q.of("time"), q.of(joint), t); };
    for (std::size_t i = 0; i < time.size(); ++i)
      torque[i] += of_joint->second.get("joint_torque_offset", 0.0) -
                   of_joint->second.get("joint_stiffness", 0.0) * angle(time[i]) -
                   of_joint->second.get("joint_viscosity", 0.0) *
                       (angle(time[i] + kStep_s) - angle(time[i] - kStep_s)) / (2.0 * kStep_s);
  }
  return myoid::test::r2_of(measured, torque);
}

TEST(LeftOut, R2OfRunIsThatOfAStudyThatHoldsTheTrialBack) {
  const TemporaryFolder folder;
  write_text(folder / "p.toml", kProtocol);
  ASSERT_EQ(myoid({"twin", "--protocol", folder / "p.toml", "--seed", "3", "--out", folder / "rec"}).exit_code, 0);
  const fs::path study = fs::path(folder / "rec") / "study.toml";
  // The posterior of a fold predicts by its mode, that of a run by the mean of its marginals: they differ a little.
  const Finished whole = myoid({"run", study.string(), "--estimator", "least_squares", "--out", folder / "all"});
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
    const Finished done = myoid({"run", study.string(), "--estimator", "least_squares", "--out", run.string()});
    ASSERT_NE(done.exit_code, 3) << done.err;
    const double printed = fold.at("identified").at("r2").get<double>();
    EXPECT_NEAR(printed, r2_by_law(run, fs::path(folder / "rec") / "model.osim", trial), kSame) << trial;
    // The run that holds the trial back says the same of it.
    const nlohmann::json held_back = json_of(run / "parameters.json");
    for (const auto& method : held_back.at("methods")) {
      if (method.at("method") != "torque") continue;
      for (const auto& of_trial : method.at("trials")) {
        if (of_trial.at("trial") != trial) continue;
        EXPECT_NEAR(of_trial.at("r2").get<double>(), printed, 1e-9);
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
  const Finished few = identify(folder / "muscles.csv", trials, folder / "few", {"--folds", "block", "--end", "2.5"});
  EXPECT_NE(few.exit_code, 3) << few.err;
  EXPECT_NE(few.out.find("no trial has the 3.3 s from which blocks are left out"), std::string::npos) << few.out;
  const Finished enough =
      identify(folder / "muscles.csv", trials, folder / "enough", {"--folds", "block", "--end", "5"});
  EXPECT_NE(enough.out.find("block 5 of 5"), std::string::npos) << enough.out << enough.err;
}

}  // namespace
