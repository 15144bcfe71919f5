#include "myoid/program/commands/read_fit.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/fit/measurement/parameters.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/results/parameter_files.h"

#include "tests/support/elbow_study.h"
#include "tests/support/temporary_folder.h"

namespace myoid::program {
namespace {

using fit::IdentificationResult;

/// A fit with numbers that no decimal text of few digits holds.
IdentificationResult made_fit(const test::ElbowStudy& study, const fit::EstimatorOptions& options) {
  const fit::ParameterMap map(study.data, options);
  IdentificationResult fit;
  fit.method = fit::Method::torque;
  fit.solution = map.start() + Eigen::VectorXd::Constant(map.size(), 1.0 / 300.0);
  fit.covariance = Eigen::MatrixXd::Identity(map.size(), map.size()) / 7.0;
  for (const fit::Unknown& unknown : map.free()) fit.free_parameters.push_back(unknown.label);
  fit.values = map.values(fit.solution);
  fit.torque_sd_nm = 1.0 / 3.0;
  fit.envelope_variance = Eigen::Vector3d(0.1, 0.2, 0.3) / 9.0;
  fit.noise = Eigen::Vector4d(0.1, 0.2, 0.3, -4.0) / 7.0;
  return fit;
}

TEST(ReadFit, GivesBackTheNumbersThatWereWritten) {
  const test::TemporaryFolder folder;
  const test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 4.0});
  const IdentificationResult made = made_fit(study, {});
  write_file(folder / "parameters.json", results::parameters_json({made}, {}, {}));
  const IdentificationResult read = read_fit(folder.path(), study.data, {});
  EXPECT_EQ(read.solution, made.solution);
  EXPECT_EQ(read.covariance, made.covariance);
  EXPECT_EQ(read.noise, made.noise);
  EXPECT_EQ(read.envelope_variance, made.envelope_variance);
  EXPECT_EQ(read.torque_sd_nm, made.torque_sd_nm);
  EXPECT_EQ(read.lag, made.lag);
  ASSERT_EQ(read.values.muscles.size(), made.values.muscles.size());
  for (std::size_t k = 0; k < read.values.muscles.size(); ++k)
    EXPECT_EQ(read.values.muscles[k], made.values.muscles[k]);
}

TEST(ReadFit, RefusesListsOfAnotherLengthAndCellsThatAreNoNumbers) {
  const test::TemporaryFolder folder;
  const test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 4.0});
  const nlohmann::json good = nlohmann::json::parse(results::parameters_json({made_fit(study, {})}, {}, {}));
  const auto refuses = [&](const auto& damage) {
    nlohmann::json content = good;
    damage(content.at("methods").at(0));
    write_file(folder / "parameters.json", content.dump());
    EXPECT_THROW((void)read_fit(folder.path(), study.data, {}), ReadError);
  };
  refuses([](auto& method) { method.at("covariance").at("matrix").at(1).push_back(1.0); });
  refuses([](auto& method) { method.at("covariance").at("matrix").at(1).erase(0); });
  refuses([](auto& method) { method.at("covariance").at("matrix").erase(0); });
  refuses([](auto& method) { method.at("covariance").at("matrix").at(0).at(0) = "1"; });
  refuses([](auto& method) { method.at("covariance").at("mean").at(0) = nullptr; });
  refuses([](auto& method) { method.at("noise").at(0) = nullptr; });
}

TEST(ReadFit, RefusesOtherUnknownsAndOtherFiles) {
  const test::TemporaryFolder folder;
  test::ElbowStudy study = test::elbow_study({.trials = 1, .seconds = 4.0});
  EXPECT_THROW((void)read_fit(folder.path(), study.data, {}), ReadError);
  write_file(folder / "parameters.json", results::parameters_json({made_fit(study, {})}, {}, {}));
  study.data.rules = {test::freed("emg_exponent")};
  EXPECT_THROW((void)read_fit(folder.path(), study.data, {}), InvalidInput);
  write_file(folder / "parameters.json", "{\"methods\": [{\"method\": \"torque\"}]}");
  EXPECT_THROW((void)read_fit(folder.path(), study.data, {}), ReadError);
  write_file(folder / "parameters.json", "{\"methods\": []}");
  EXPECT_THROW((void)read_fit(folder.path(), study.data, {}), InvalidInput);
}

}  // namespace
}  // namespace myoid::program
