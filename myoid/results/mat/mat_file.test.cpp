#include "myoid/results/mat/mat_file.h"

#include <memory>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/byte_source.h"
#include "myoid/results/mat/results_mat.h"

#include "tests/support/temporary_folder.h"

namespace myoid::results {
namespace {

bool has_matio() {
  try {
    require_matio();
    return true;
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("libmatio"), std::string::npos);
    return false;
  }
}

// What stands in a file is tested by its readers: Octave (tests/matlab) and SciPy (tests/python).
TEST(MatFile, IsTheSameToTheByteAndSmallerThanItsNumbers) {
  if (!has_matio()) GTEST_SKIP() << "no libmatio";
  const test::TemporaryFolder folder;
  const MatStruct inner{{{"text", std::string("Kraft µ")}, {"flags", std::vector<bool>{true}}}};
  const MatStruct variables{{{"numbers", Eigen::MatrixXd::Zero(1000, 3)},
                             {"structs", std::vector<MatStruct>{inner, inner}},
                             {"names", MatTexts{{"a", ""}, true}}}};
  write_mat_file(folder / "a.mat", variables);
  write_mat_file(folder / "b.mat", variables);
  const std::string bytes = read_bytes(folder / "a.mat");
  EXPECT_EQ(bytes, read_bytes(folder / "b.mat"));
  EXPECT_EQ(bytes.substr(0, 10), "MATLAB 5.0");
  EXPECT_LT(bytes.size(), 5000U);
}

TEST(MatFile, GoesWholeOrNotAtAll) {
  if (!has_matio()) GTEST_SKIP() << "no libmatio";
  const test::TemporaryFolder folder;
  EXPECT_THROW(write_mat_file(folder.path(), {{{"x", Eigen::MatrixXd::Zero(1, 1)}}}), InvalidInput);
  EXPECT_THROW(check_mat_file(folder / "results.txt"), InvalidInput);
}

}  // namespace
}  // namespace myoid::results
