#include "myoid/body/kinematics/surrogate_file.h"

#include <fstream>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::body {
namespace {

class SurrogateFile : public testing::Test {
 protected:
  const std::string text_ = body::arm4_osim({});
  const body::BodyModel model_ = body::parse_osim(text_, "arm4.osim");
  const body::SurrogateOptions options_;
  const std::string key_ = surrogate_key(text_, model_.compat, options_);
  const std::vector<body::PathSurrogate> fitted_ = body::fit_surrogates(model_);
  const test::TemporaryFolder folder_;
  const std::filesystem::path path_ = folder_.path() / "surrogates.json";
};

TEST_F(SurrogateFile, GivesBackEveryDigit) {
  EXPECT_FALSE(read_surrogates(path_, model_, key_)) << "there is none yet";
  write_surrogates(path_, model_, key_, fitted_);
  const auto read = read_surrogates(path_, model_, key_);
  ASSERT_TRUE(read);
  ASSERT_EQ(read->size(), fitted_.size());
  for (std::size_t i = 0; i < fitted_.size(); ++i) {
    EXPECT_EQ((*read)[i].muscle, fitted_[i].muscle);
    EXPECT_EQ((*read)[i].coordinates, fitted_[i].coordinates);
    EXPECT_EQ((*read)[i].lower, fitted_[i].lower);
    EXPECT_EQ((*read)[i].upper, fitted_[i].upper);
    EXPECT_EQ((*read)[i].degree, fitted_[i].degree);
    EXPECT_EQ((*read)[i].coefficient_m, fitted_[i].coefficient_m);
    EXPECT_EQ((*read)[i].arm_error_m, fitted_[i].arm_error_m);
    EXPECT_EQ((*read)[i].within_tolerance, fitted_[i].within_tolerance);
  }
}

TEST_F(SurrogateFile, IsNotTakenForAnotherModelOrOtherOptions) {
  write_surrogates(path_, model_, key_, fitted_);
  EXPECT_FALSE(read_surrogates(path_, model_, surrogate_key(text_ + " ", model_.compat, options_)));
  EXPECT_FALSE(read_surrogates(path_, model_, surrogate_key(text_, body::kOpenSim452, options_)));
  EXPECT_FALSE(read_surrogates(path_, model_, surrogate_key(text_, model_.compat, {.length_tolerance_m = 1e-5})));
}

TEST_F(SurrogateFile, RefusesWhatIsDamagedOrSomethingElse) {
  write_file(path_, "time,value\n0,1\n");
  EXPECT_THROW((void)read_surrogates(path_, model_, key_), ReadError);
  write_file(path_, R"({"kind": "a recipe"})");
  EXPECT_THROW((void)read_surrogates(path_, model_, key_), ReadError);
  write_surrogates(path_, model_, key_, fitted_);
  const std::string whole = read_text_file(path_);
  write_file(path_, whole.substr(0, whole.size() / 2));
  EXPECT_THROW((void)read_surrogates(path_, model_, key_), ReadError);
  std::vector<body::PathSurrogate> bad = fitted_;
  bad[0].coefficient_m.conservativeResize(bad[0].coefficient_m.size() - 1);
  write_surrogates(path_, model_, key_, bad);
  EXPECT_THROW((void)read_surrogates(path_, model_, key_), ReadError);
  bad = fitted_;
  bad.pop_back();
  write_surrogates(path_, model_, key_, bad);
  EXPECT_THROW((void)read_surrogates(path_, model_, key_), ReadError);
}

}  // namespace
}  // namespace myoid::body
