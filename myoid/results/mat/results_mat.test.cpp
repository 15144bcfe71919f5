#include "myoid/results/mat/results_mat.h"

#include <filesystem>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

const MatValue& field(const MatStruct& owner, const std::string& name) {
  for (const auto& [key, value] : owner.fields) {
    if (key == name) return value;
  }
  throw std::out_of_range(name);
}
const MatStruct& part(const MatStruct& owner, const std::string& name) {
  return std::get<std::vector<MatStruct>>(field(owner, name)).at(0);
}

class ResultsMat : public testing::Test {
 protected:
  void SetUp() override {
    write("parameters.csv",
          "muscle,parameter,unit,case,estimate,ci_low,at_bound\n"
          "BIC,max_isometric_force,N,both,600.5,,true\nBIC,emg_delay,s,both,0.04,0.03,false\n");
  }
  void write(const std::string& name, const std::string& text) { write_file(folder / name, text); }
  test::TemporaryFolder folder;
};

constexpr const char* kSeries =
    "Forces\nversion=1\nnRows=2\nnColumns=2\ninDegrees=no\nendheader\n"
    "time\tBIC\n0\t1.5\n0.01\t2.5\n";

TEST_F(ResultsMat, ColumnsKeepTheirKindAndAnEmptyCellIsNaN) {
  const MatStruct found = matlab_results(folder.path());
  const MatStruct& p = part(found, "parameters");
  EXPECT_EQ(std::get<MatTexts>(field(p, "muscle")).texts, (std::vector<std::string>{"BIC", "BIC"}));
  EXPECT_EQ(std::get<MatTexts>(field(p, "fit_case")).texts.front(), "both");
  EXPECT_EQ(std::get<Eigen::MatrixXd>(field(p, "estimate"))(1, 0), 0.04);
  EXPECT_TRUE(std::isnan(std::get<Eigen::MatrixXd>(field(p, "ci_low"))(0, 0)));
  EXPECT_EQ(std::get<std::vector<bool>>(field(p, "at_bound")), (std::vector<bool>{true, false}));
  EXPECT_EQ(found.fields.size(), 1U);
}

TEST_F(ResultsMat, DrawsHaveTheUnitsOfTheirParameters) {
  write("posterior.csv", "weight,BIC.max_isometric_force,subject.emg_delay\n0.5,600,0.04\n0.5,610,0.05\n");
  const MatStruct found = matlab_results(folder.path());
  const MatStruct& draws = part(found, "draws");
  EXPECT_EQ(std::get<MatTexts>(field(draws, "units")).texts, (std::vector<std::string>{"N", "s"}));
  Eigen::MatrixXd expected(2, 2);
  expected << 600, 0.04, 610, 0.05;
  EXPECT_EQ(std::get<Eigen::MatrixXd>(field(draws, "values")), expected);
}

TEST_F(ResultsMat, TrialsComeFromFoldersWhereThereIsNoRunJson) {
  write("2 walk/predicted_forces.sto", kSeries);
  write("empty/notes.txt", "");
  const MatStruct found = matlab_results(folder.path());
  const auto& trials = std::get<std::vector<MatStruct>>(field(found, "trials"));
  ASSERT_EQ(trials.size(), 1U);
  EXPECT_EQ(std::get<std::string>(field(trials[0], "name")), "2 walk");
  const MatStruct& series = part(part(trials[0], "series"), "predicted_forces");
  EXPECT_EQ(std::get<MatTexts>(field(series, "units")).texts, std::vector<std::string>{"N"});
  EXPECT_EQ(std::get<Eigen::MatrixXd>(field(series, "values")), Eigen::Vector2d(1.5, 2.5));
}

TEST_F(ResultsMat, NamesOfFieldsAreThoseOfMatlab) {
  const std::string stem = "MuscleAnalysis_MomentArm_" + std::string(50, 'q');
  for (const char* end : {"1", "2", "3"}) write("t/" + stem + end + ".sto", kSeries);
  write("t/3rd-force.sto", kSeries);
  const MatStruct found = matlab_results(folder.path());
  const MatStruct& series = part(part(found, "trials"), "series");
  ASSERT_EQ(series.fields.size(), 4U);
  EXPECT_EQ(series.fields[0].first, "x3rd_force");
  std::set<std::string> names;
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_TRUE(series.fields[i].first.starts_with(stem.substr(0, 50))) << series.fields[i].first;
    EXPECT_LE(series.fields[i].first.size(), 63U);
    names.insert(series.fields[i].first);
  }
  EXPECT_EQ(names.size(), 3U);
}

TEST_F(ResultsMat, RepairsOfAStorageFileAreReturned) {
  const std::string head = "id\nversion=1\nnRows=2\nnColumns=2\ninDegrees=no\nendheader\ntime\tknee\n0\t1\n1\t2";
  std::vector<Repair> repairs;
  write("whole.sto", head + "\n");
  (void)matlab_results(folder / "whole.sto", &repairs);
  EXPECT_TRUE(repairs.empty());
  write("cut.sto", head);
  (void)matlab_results(folder / "cut.sto", &repairs);
  EXPECT_FALSE(repairs.empty());
}

TEST_F(ResultsMat, RemarksAreColumnsAndADamagedRecordIsNamed) {
  write("run.json",
        R"({"program": "myoid", "version": "1", "command": "c", "study": "s", "faults": [],
            "trials": [{"name": "a", "use": "identify", "failure": "", "notes": ["one"],
                        "faults": [{"fault": "gap", "level": "warning", "channel": "BIC",
                                    "begin_s": 1.5, "end_s": 2.0, "message": "two"}]}]})");
  const MatStruct found = matlab_results(folder.path());
  const MatStruct& remarks = part(found, "remarks");
  EXPECT_EQ(std::get<MatTexts>(field(remarks, "text")).texts, (std::vector<std::string>{"two", "one"}));
  EXPECT_EQ(std::get<Eigen::MatrixXd>(field(remarks, "begin_s"))(0, 0), 1.5);
  EXPECT_EQ(std::get<std::string>(field(part(found, "run"), "version")), "1");
  for (const char* text : {"{\"trials\": []}", "{"}) {
    write("run.json", text);
    EXPECT_THROW((void)matlab_results(folder.path()), ReadError) << text;
  }
}

}  // namespace
}  // namespace myoid::results
