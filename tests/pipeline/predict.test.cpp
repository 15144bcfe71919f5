// `myoid predict`: the numbers of a run's validation, made again from its files alone.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/written_law.h"

namespace {

using myoid::test::Finished;
using myoid::test::myoid;
using myoid::test::read_rows;
using myoid::test::read_text;
using myoid::test::Row;
using myoid::test::TemporaryFolder;
using myoid::test::write_text;
using testing::HasSubstr;
namespace fs = std::filesystem;

/// A virtual recording with two trials to fit and one that is held back.
fs::path recording_in(const TemporaryFolder& folder, const std::string& name, int seed) {
  const auto trial = [](const std::string& of, double hz, double kg) {
    return "[[trial]]\nname = \"" + of +
           "\"\nkind = \"flexion\"\ncentre_deg = 72\namplitude_deg = 40\nduration_s = 5\n"
           "frequency_hz = " +
           std::to_string(hz) + "\nheld_mass_kg = " + std::to_string(kg) + "\n";
  };
  write_text(folder / "protocol.toml", "name = \"short\"\nlevel = \"L1\"\n[motion]\nrate_hz = 100\n" +
                                           trial("slow", 0.4, 1.0) + trial("heavy", 0.5, 3.0) +
                                           trial("fast", 0.9, 1.5) + "use = \"validation\"\n");
  const Finished twin =
      myoid({"twin", "--protocol", folder / "protocol.toml", "--seed", std::to_string(seed), "--out", folder / name});
  EXPECT_EQ(twin.exit_code, 0) << twin.err;
  return folder / name;
}

/// The validation trial's entry of method torque in parameters.json.
nlohmann::json validated(const fs::path& results) {
  const auto parameters = nlohmann::json::parse(read_text(results / "parameters.json"));
  for (const auto& method : parameters.at("methods")) {
    if (method.at("method") != "torque") continue;
    for (const auto& trial : method.at("trials")) {
      if (!trial.at("calibration").get<bool>()) return trial;
    }
  }
  return {};
}

TEST(Predict, MakesTheNumbersOfTheRunsValidationFromItsFiles) {
  const TemporaryFolder folder;
  const fs::path recording = recording_in(folder, "rec", 3);
  const Finished run = myoid({"run", recording / "study.toml", "--out", folder / "results"});
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.err;
  const Finished predict = myoid({"predict", folder / "results", "--out", folder / "predicted"});
  ASSERT_EQ(predict.exit_code, 0) << predict.err;
  const nlohmann::json of_run = validated(folder / "results");
  const std::vector<Row> rows = read_rows(folder / "predicted/predictions.csv");
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].at("trial"), "fast");
  EXPECT_EQ(rows[0].at("fitted"), "false");
  // The values of the model are read back as they were written: to the last digits.
  for (const char* number : {"rmse_nm", "r2", "band_r2", "covered"})
    EXPECT_NEAR(std::stod(rows[0].at(number)), of_run.at(number).get<double>(), 1e-9) << number;
  // Ten seconds of two movements, and no maximal contraction.
  EXPECT_GT(std::stod(rows[0].at("r2")), 0.5);
  EXPECT_GT(std::stod(rows[0].at("covered")), 0.6);

  // R2 is that of the columns in the file.
  const auto torque = myoid::test::read_table(folder / "predicted/fast/predicted_torque_elbow_flexion.sto");
  const auto& measured = torque.of("elbow_flexion_measured");
  const auto& predicted = torque.of("elbow_flexion_predicted");
  double mean = 0.0, sse = 0.0, sst = 0.0;
  for (const double x : measured) mean += x / static_cast<double>(measured.size());
  for (std::size_t i = 0; i < measured.size(); ++i) {
    sse += std::pow(measured[i] - predicted[i], 2);
    sst += std::pow(measured[i] - mean, 2);
    EXPECT_LT(torque.of("elbow_flexion_low")[i], predicted[i]);
    EXPECT_GT(torque.of("elbow_flexion_high")[i], predicted[i]);
  }
  EXPECT_NEAR(1.0 - sse / sst, std::stod(rows[0].at("r2")), 1e-6);
  EXPECT_TRUE(fs::exists(folder / "predicted/fast/predicted_forces.sto"));
}

TEST(PredictCommand, TakesTheTrialsOfAnotherStudyOfThePersonAndRefusesWhatIsNotThere) {
  const TemporaryFolder folder;
  const fs::path first = recording_in(folder, "first", 3), second = recording_in(folder, "second", 3);
  const Finished run = myoid({"run", first / "study.toml", "--out", folder / "results"});
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.err;
  const std::string results = folder / "results";
  const Finished other =
      myoid({"predict", results, "--study", second / "study.toml", "--trials", "heavy", "--out", folder / "other"});
  ASSERT_EQ(other.exit_code, 0) << other.err;
  EXPECT_EQ(read_rows(folder / "other/predictions.csv").at(0).at("fitted"), "false");
  const fs::path somebody = recording_in(folder, "somebody", 4);
  const Finished foreign =
      myoid({"predict", results, "--study", somebody / "study.toml", "--trials", "heavy", "--out", folder / "foreign"});
  EXPECT_GT(std::ranges::count(foreign.err, '\n'), std::ranges::count(other.err, '\n'));  // another subject
  const Finished unknown = myoid({"predict", results, "--trials", "quick", "--out", folder / "unknown"});
  EXPECT_EQ(unknown.exit_code, 3);
  EXPECT_THAT(unknown.err, HasSubstr("there are slow, heavy, fast"));
  EXPECT_FALSE(fs::exists(folder / "unknown/predictions.csv"));
  const Finished none = myoid({"predict", folder / "first", "--out", folder / "none"});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_THAT(none.err, HasSubstr("run.json"));
  // A recording that is another than that of the run.
  for (const auto& file : fs::directory_iterator(first)) {
    if (file.path().extension() == ".trc" || file.path().extension() == ".c3d") {
      write_text(file.path(), read_text(file.path()) + "\n");
    }
  }
  const Finished changed = myoid({"predict", results, "--out", folder / "changed"});
  EXPECT_EQ(changed.exit_code, 3) << changed.err;
}

}  // namespace
