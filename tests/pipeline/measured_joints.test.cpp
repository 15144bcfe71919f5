// What recordings of one joint can tell of a muscle, on other people's data (findings E5, E6, E7).
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"
#include "tests/support/data_folder.h"
#include "tests/support/measured_columns.h"
#include "tests/support/temporary_folder.h"

namespace {

using myoid::test::envelope;
using myoid::test::Finished;
using myoid::test::greatest;
using myoid::test::myoid;
using myoid::test::read_columns;
using myoid::test::read_rows;
using myoid::test::Row;
using myoid::test::TemporaryFolder;
using myoid::test::TibialisTorque;
using myoid::test::write_text;
namespace fs = std::filesystem;

/// One effort of a joint: EMG of its two muscles and the force at the load cell.
struct Effort {
  std::vector<double> extensor, flexor, force;
};

Finished identify(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "identify");
  return myoid(arguments);
}

/// Fits two muscles to two efforts at one angle; the verdicts of lengths and widths.
void expect_nothing_of_lengths(const std::vector<Effort>& efforts, const std::string& who) {
  constexpr double kEmg_hz = 2000.0, kNewtonPerKgf = 9.80665, kLever_m = 0.3;
  const TemporaryFolder folder;
  double most[2] = {0.0, 0.0};
  for (const Effort& e : efforts) {
    most[0] = std::max(most[0], greatest(envelope(e.extensor, kEmg_hz), kEmg_hz));
    most[1] = std::max(most[1], greatest(envelope(e.flexor, kEmg_hz), kEmg_hz));
  }
  write_text(folder / "muscles.csv",
             "muscle,max_isometric_force,optimal_fiber_length,force_length_width,"
             "concentric_curvature,eccentric_slope_ratio,eccentric_plateau,max_shortening_speed\n"
             "E,3000,0.1,0.045,0.28,1.5,1.4,1\nF,1500,0.09,0.0405,0.28,1.5,1.4,0.9\n");
  std::vector<std::string> arguments{"--muscles", folder / "muscles.csv", "--folds", "none", "--out", folder / "out"};
  std::vector<std::string> a{"--activations"}, l{"--lengths"}, r{"--moment-arms"}, t{"--torques"};
  for (std::size_t k = 0; k < efforts.size(); ++k) {
    const Effort& e = efforts[k];
    const std::vector<double> one = envelope(e.extensor, kEmg_hz), two = envelope(e.flexor, kEmg_hz);
    std::string active = "time,E,F\n", lengths = active, arms = active, torques = "time,joint\n";
    for (std::size_t i = 0; i < e.force.size() && 20 * i < one.size(); ++i) {
      const double s = 0.01 * static_cast<double>(i), sign = k == 0 ? 1.0 : -1.0;
      active += fmt::format("{},{},{}\n", s, one[20 * i] / most[0], two[20 * i] / most[1]);
      lengths += fmt::format("{},0.108,0.084\n", s);
      arms += fmt::format("{},0.04,-0.03\n", s);
      torques += fmt::format("{},{}\n", s, sign * kLever_m * kNewtonPerKgf * e.force[i]);
    }
    const std::string n = std::to_string(k);
    const std::vector<std::pair<std::vector<std::string>*, std::string*>> all{
        {&a, &active}, {&l, &lengths}, {&r, &arms}, {&t, &torques}};
    for (const auto& [option, text] : all) {
      option->push_back(folder / (option->front().substr(2) + n + ".csv"));
      write_text(option->back(), *text);
    }
  }
  for (const auto& list : {a, l, r, t}) arguments.insert(arguments.end(), list.begin(), list.end());
  const Finished done = identify(arguments);
  ASSERT_NE(done.exit_code, 3) << who << ": " << done.err;
  int judged = 0;
  for (const Row& row : read_rows(folder / "out/parameters.csv")) {
    if (row.at("parameter") != "optimal_fiber_length" && row.at("parameter") != "force_length_width") continue;
    ++judged;
    const std::string& verdict = row.at("verdict");
    EXPECT_TRUE(verdict == "prior_dominated" || verdict == "not_identifiable")
        << who << " " << row.at("muscle") << " " << row.at("parameter") << ": " << verdict << ", " << row.at("reason");
  }
  EXPECT_EQ(judged, 4);
}

TEST(MeasuredJoints, OneAngleTellsNothingOfTheForceLengthCurveForAnyOfTenPeople) {
  const fs::path data = myoid::test::data_folder() / "elderly-isometric";
  MYOID_REQUIRE_DATA(data);
  int people = 0;
  for (const auto& entry : fs::directory_iterator(data)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with("_loadcell.csv")) continue;
    const std::string person = name.substr(0, 2);
    const auto force = read_columns(entry.path(), 2);
    const auto emg = [&](const std::string& task) {
      return read_columns(data / (person + "_" + task + "_emg.csv"), 2);
    };
    const auto extension = emg("knee_extension"), flexion = emg("knee_flexion");
    expect_nothing_of_lengths({{extension[0], extension[1], force[0]}, {flexion[0], flexion[1], force[1]}},
                              person + " knee");
    const auto plantar = emg("plantarflexion"), dorsal = emg("dorsiflexion");
    expect_nothing_of_lengths({{plantar[3], plantar[2], force[3]}, {dorsal[3], dorsal[2], force[2]}},
                              person + " ankle");
    ++people;
  }
  EXPECT_EQ(people, 10);
}

TEST(MeasuredJoints, AGenericTendonLeavesRoomForTheFiberLengthThatUltrasoundSees) {
  const fs::path data = myoid::test::data_folder() / "tecchio-ankle";
  const fs::path model = myoid::test::data_folder() / "ceinms-rt-leg/gait2392.osim";
  MYOID_REQUIRE_DATA(data);
  MYOID_REQUIRE_DATA(model);
  constexpr double kEmg_hz = 2000.0;
  const TibialisTorque tibialis(data);
  const std::vector<std::string> trials{"PL_0_01", "PL_50_01", "PL_100_01", "Ref_Long_01", "Ref_Long_02"};
  const TemporaryFolder folder;
  double most = 0.0;
  std::vector<std::vector<double>> envelopes;
  for (const std::string& trial : trials) {
    envelopes.push_back(envelope(read_columns(data / (trial + "_emg.csv"), 1)[1], kEmg_hz));
    most = std::max(most, greatest(envelopes.back(), kEmg_hz));
  }
  std::vector<std::string> a{"--activations"}, l{"--lengths"}, v{"--velocities"}, r{"--moment-arms"}, t{"--torques"};
  for (std::size_t k = 0; k < trials.size(); ++k) {
    const auto d = read_columns(data / (trials[k] + "_dynamometer.csv"), 1);
    std::string angles, torques = "time,ankle_angle_r\n", active = "time,tib_ant_r\n";
    int rows = 0;
    for (std::size_t i = 0; i < d[0].size(); i += 2, ++rows) {
      const double q = d[2][i];  // crank; plantarflexion is 15 degrees more
      angles += fmt::format("{}\t{}\n", d[0][i], -(q + 15.0));
      torques += fmt::format("{},{}\n", d[0][i], tibialis(d[1][i], q));
    }
    for (std::size_t i = 0; i < envelopes[k].size(); i += 10)
      active += fmt::format("{},{}\n", static_cast<double>(i) / kEmg_hz, envelopes[k][i] / most);
    const std::string n = std::to_string(k);
    write_text(folder / ("q" + n + ".mot"), fmt::format("q\nversion=1\nnRows={}\nnColumns=2\ninDegrees=yes\nendheader\n"
                                                        "time\tankle_angle_r\n{}",
                                                        rows, angles));
    const std::string out = folder / ("p" + n);
    ASSERT_EQ(myoid({"paths", "--model", model.string(), "--motion", folder / ("q" + n + ".mot"), "--lowpass", "6",
                     "--out", out})
                  .exit_code,
              0);
    a.push_back(folder / ("a" + n + ".csv"));
    t.push_back(folder / ("t" + n + ".csv"));
    write_text(a.back(), active);
    write_text(t.back(), torques);
    l.push_back(out + "/MuscleAnalysis_Length.sto");
    v.push_back(out + "/MuscleAnalysis_MuscleTendonVelocity.sto");
    r.push_back(out + "/MuscleAnalysis_MomentArm_ankle_angle_r.sto");
  }
  const auto interval = [&](const std::string& more_names, const std::string& more) {
    write_text(folder / "muscles.csv",
               "muscle,max_isometric_force,optimal_fiber_length,tendon_slack_length,"
               "force_length_width,concentric_curvature,eccentric_slope_ratio,eccentric_plateau,"
               "max_shortening_speed" +
                   more_names + "\ntib_ant_r,905,0.098,0.223,0.0441,0.28,1.5,1.4,0.98" + more + "\n");
    std::vector<std::string> arguments{
        "--muscles", folder / "muscles.csv", "--coordinate", "ankle_angle_r", "--folds", "none",
        "--out",     folder / "out",         "--overwrite"};
    for (const auto& list : {a, l, v, r, t}) arguments.insert(arguments.end(), list.begin(), list.end());
    const Finished done = identify(arguments);
    EXPECT_NE(done.exit_code, 3) << done.err;
    for (const Row& row : read_rows(folder / "out/parameters.csv")) {
      if (row.at("parameter") == "optimal_fiber_length")
        return std::pair{std::stod(row.at("ci_low")), std::stod(row.at("ci_high"))};
    }
    return std::pair{0.0, 0.0};
  };
  // Ultrasound reads a fascicle's length to a tenth (95 %).
  constexpr double kByUltrasound_m = 0.075, kReading_m = 0.0075;
  const auto [low, high] = interval("", "");
  EXPECT_LT(low, kByUltrasound_m + kReading_m);
  EXPECT_GT(high, kByUltrasound_m - kReading_m);
  // Stated as measured, it is taken at its word.
  const auto [sure_low, sure_high] = interval(",tendon_slack_length_fixed", ",true");
  // 1 mm hardly shows beside what the recording leaves open. The posterior's approximation knows
  // the far end of so wide an interval to a fifth only; by its sampler both widths agree to 2 %.
  const auto [near_low, near_high] = interval(",tendon_slack_length_prior_sd", ",0.001");
  EXPECT_NEAR(near_high - near_low, sure_high - sure_low, 0.3 * (sure_high - sure_low));
}

// The draws of two lifts lie along a curved ridge of strength and gain. Their mean beside it explains nothing; each
// lift is predicted from the other.
TEST(MeasuredElbow, AFitThatPredictsExplainsItsOwnTorque) {
  const fs::path data = myoid::test::data_folder() / "elbow-emg";
  MYOID_REQUIRE_DATA(data);
  const TemporaryFolder folder;
  std::string study =
      "[subject]\nmass_kg = 70.0\n[model]\nbuiltin = \"arm4\"\ncoordinate = \"elbow_flexion\"\n"
      "[emg]\nkind = \"raw\"\n[identify]\nmethod = [\"torque\"]\n";
  for (const auto& [muscle, emg] : {std::pair("BIC", "\"biceps_brachii\""),
                                    {"BRD", "\"brachioradialis\""},
                                    {"TRI", "\"triceps_lateral\""},
                                    {"BRA", "{ same_as = \"BIC\" }"}})
    study += fmt::format("[[muscle]]\nname = \"{0}\"\nosim = [\"{0}\"]\nemg = {1}\n", muscle, emg);
  for (const std::string trial : {"load5p5_T1", "load5p5_T2"})
    study += fmt::format(
        "[[trial]]\nname = \"{0}\"\nmotion = \"{1}/{0}_elbow.mot\"\nemg = \"{1}/{0}_emg_raw_uV.sto\"\n"
        "use = \"calibration\"\nheld_mass_kg = 2.5\n",
        trial, data.string());
  write_text(folder / "study.toml", study);
  const Finished done = myoid({"run", folder / "study.toml", "--out", folder / "out"});
  ASSERT_NE(done.exit_code, 3) << done.err;
  std::ifstream stream(folder / "out/parameters.json");
  const nlohmann::json parameters = nlohmann::json::parse(stream);
  for (const auto& fold : parameters.at("leave_one_trial_out")) EXPECT_GT(fold.at("identified").at("r2"), 0.8);
  EXPECT_GT(parameters.at("methods").at(0).at("r2"), 0.8);
  for (const auto& trial : parameters.at("methods").at(0).at("trials")) EXPECT_GT(trial.at("r2"), 0.8);
}

/// Leaves out each speed of a walking leg, of the whole minute or of a part of it.
struct Walks {
  std::vector<double> r2;  ///< By the left-out speed.
  std::string warnings;
};

Walks leave_out_walks(const fs::path& data, const TemporaryFolder& folder, const std::vector<std::string>& part) {
  std::vector<std::string> arguments{
      "identify",     "--muscles",  (data / "muscles.csv").string(), "--coordinate", "ankle_angle_r_moment", "--out",
      folder / "out", "--overwrite"};
  arguments.insert(arguments.end(), part.begin(), part.end());
  std::vector<std::string> a{"--activations"}, l{"--lengths"}, v{"--velocities"}, r{"--moment-arms"}, t{"--torques"};
  for (const std::string walk : {"walk36", "walk45"}) {
    a.push_back((data / walk / "emgFilt.sto").string());
    t.push_back((data / walk / "id.sto").string());
    l.push_back(folder / (walk + "/MuscleAnalysis_Length.sto"));
    v.push_back(folder / (walk + "/MuscleAnalysis_MuscleTendonVelocity.sto"));
    r.push_back(folder / (walk + "/MuscleAnalysis_MomentArm_ankle_angle_r.sto"));
  }
  for (const auto& list : {a, l, v, r, t}) arguments.insert(arguments.end(), list.begin(), list.end());
  const Finished done = myoid(arguments);
  EXPECT_NE(done.exit_code, 3) << done.err;
  Walks found;
  found.warnings = done.err;
  std::ifstream stream(folder / "out/parameters.json");
  const nlohmann::json parameters = nlohmann::json::parse(stream);
  for (const auto& fold : parameters.at("leave_one_trial_out")) found.r2.push_back(fold.at("identified").at("r2"));
  return found;
}

/// Lengths and moment arms of both walks.
void add_paths_of_walks(const fs::path& data, const TemporaryFolder& folder) {
  for (const std::string walk : {"walk36", "walk45"}) {
    ASSERT_EQ(myoid({"paths", "--model", (data / "gait2392.osim").string(), "--motion",
                     (data / walk / "ik.sto").string(), "--lowpass", "6", "--out", folder / walk})
                  .exit_code,
              0);
  }
}

/// R2 of CEINMS-RT's own subject on the slow and the fast walk (README of the data).
constexpr double kCeinms[] = {0.65, 0.48};

TEST(MeasuredWalk, ThePosteriorOfOneSpeedPredictsTheOtherAsCeinmsSubjectDoes) {
  const fs::path data = myoid::test::data_folder() / "ceinms-rt-leg";
  MYOID_REQUIRE_DATA(data);
  const TemporaryFolder folder;
  add_paths_of_walks(data, folder);
  const Walks walks = leave_out_walks(data, folder, {"--start", "19", "--end", "24"});
  ASSERT_EQ(walks.r2.size(), 2U);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_GT(walks.r2[k], kCeinms[k]) << k;
}

}  // namespace
