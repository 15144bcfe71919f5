#include "myoid/results/prediction_files.h"

#include <cstddef>
#include <filesystem>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/storage_reader.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

using testing::HasSubstr;

fit::TrialFit prediction() {
  fit::TrialFit fit;
  fit.trial = "fast, heavy";
  fit.joint = "elbow_flexion";
  fit.calibration = false;
  fit.time_s = Eigen::VectorXd::LinSpaced(3, 0.0, 0.2);
  fit.torque_nm = Eigen::Vector3d(1.0, 2.0, 9.0);
  fit.torque_fit_nm = Eigen::Vector3d(1.5, 2.0, 3.0);
  fit.torque_sd_nm = Eigen::Vector3d::Constant(0.5);
  fit.force_fit_n = Eigen::Vector3d(0.5, 20.0, 30.0);
  fit.force_sd_n = Eigen::Vector3d(1.0, 2.0, 3.0);
  fit.score = fit::score(fit.torque_nm, fit.torque_fit_nm);
  return fit;
}

TEST(PredictionFiles, HoldTheBandsAndNoForceBelowZero) {
  const test::TemporaryFolder folder;
  write_prediction(prediction(), {"BIC"}, {}, folder.path(), {});
  const TimeSeries torque = recording::read_storage(folder.path() / "predicted_torque_elbow_flexion.sto").data;
  EXPECT_NEAR(torque.column("elbow_flexion_high")[1], 2.0 + 1.959964 * 0.5, 1e-6);
  EXPECT_NEAR(torque.column("elbow_flexion_low")[2], 3.0 - 1.959964 * 0.5, 1e-6);
  EXPECT_EQ(torque.column("elbow_flexion_measured")[2], 9.0);
  const TimeSeries forces = recording::read_storage(folder.path() / "predicted_forces.sto").data;
  EXPECT_EQ(forces.column("BIC_low")[0], 0.0);
  EXPECT_NEAR(forces.column("BIC_high")[2], 30.0 + 1.959964 * 3.0, 1e-5);
}

TEST(PredictionFiles, SayTheReadingOfTheBandsAndHoldTheDrive) {
  const test::TemporaryFolder folder;
  std::vector<fit::TrialFit> predictions{prediction()};
  const auto head = [&] { return read_text_file(folder / "fast_heavy/predicted_forces.sto").substr(0, 600); };
  write_predictions(predictions, {"BIC"}, {}, folder.path());
  EXPECT_THAT(head(), HasSubstr("without noise: there are no bands"));
  EXPECT_FALSE(std::filesystem::exists(folder / "fast_heavy/drive.sto"));
  predictions[0].drive = TimeSeries(predictions[0].time_s, {{"BIC"}}, Eigen::Vector3d(0.1, 0.2, 0.3));
  write_predictions(predictions, {"BIC"}, {}, folder.path());
  EXPECT_THAT(head(), HasSubstr("of the person"));
  EXPECT_EQ(recording::read_storage(folder / "fast_heavy/drive.sto").data.column("BIC")[2], 0.3);
}

TEST(PredictionFiles, AnyNamesOfTrialsAndJointsHaveFilesOfTheirOwn) {
  const test::TemporaryFolder folder;
  std::vector<fit::TrialFit> predictions;
  for (const char* trial : {"a/b", "a b", "..", "predictions.csv"}) {
    for (const char* joint : {"knee r", "knee_r", "Knee_r"}) {
      predictions.push_back(prediction());
      predictions.back().trial = trial;
      predictions.back().joint = joint;
    }
  }
  write_predictions(predictions, {"BIC"}, Provenance{}, folder.path());
  std::ptrdiff_t torques = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.path()))
    torques += entry.path().filename().string().starts_with("predicted_torque_");
  EXPECT_EQ(torques, 12);
}

TEST(PredictionFiles, TheTableHasARowForEachTrialAndJoint) {
  const std::string text = predictions_csv({prediction()});
  EXPECT_NE(text.find("\"fast, heavy\",elbow_flexion,false,3,"), std::string::npos) << text;
  // Two of three samples lie within the band.
  EXPECT_NE(text.find(",0.6666666666666666\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace myoid::results
