#include "myoid/identification/row_filter.h"

#include <cmath>

#include <gtest/gtest.h>

#include "myoid/core/units.h"
#include "myoid/math/zero_phase.h"

namespace myoid::identification {
namespace {

TEST(RowFilter, AgreesWithTheFilterOfOneSignalAwayFromTheEnds) {
  // Eleven rows: one full set of eight and a part of one.
  const Eigen::Index n = 800;
  const auto sections = math::design_butterworth(math::FilterBand::low_pass, 2, 1.9, 50.0);
  Eigen::MatrixXd x(11, n);
  for (Eigen::Index r = 0; r < x.rows(); ++r) {
    for (Eigen::Index i = 0; i < n; ++i) {
      const double t = static_cast<double>(i) / 50.0;
      x(r, i) = std::sin(2.0 * kPi * (0.3 + 0.4 * static_cast<double>(r)) * t) + 0.1 * static_cast<double>(r);
    }
  }
  const Eigen::MatrixXd raw = x;
  filter_rows(sections, x);
  for (Eigen::Index r = 0; r < x.rows(); ++r) {
    const Eigen::VectorXd alone = math::zero_phase(sections, raw.row(r).transpose());
    // The ends differ by how far they are reflected: by 1e-4 there, and by nothing 200 samples in.
    EXPECT_LT((x.row(r).transpose() - alone).segment(200, n - 400).cwiseAbs().maxCoeff(), 1e-7);
    EXPECT_LT((x.row(r).transpose() - alone).cwiseAbs().maxCoeff(), 2e-3);
  }
}

TEST(RowFilter, LeavesAConstantAndWhatLiesBetweenTheRowsAsItIs) {
  const auto sections = math::design_butterworth(math::FilterBand::low_pass, 2, 1.5, 50.0);
  Eigen::VectorXd memory(300);
  for (Eigen::Index i = 0; i < 300; ++i) memory[i] = i % 3 == 0 ? 4.25 : static_cast<double>(i);
  const Eigen::VectorXd before = memory;
  filter_rows(sections, {{memory.data(), 3}}, 100);
  for (Eigen::Index i = 0; i < 300; ++i) {
    if (i % 3 == 0) {
      EXPECT_NEAR(memory[i], 4.25, 1e-12);
    } else {
      EXPECT_EQ(memory[i], before[i]);
    }
  }
}

TEST(RowFilter, ItsTransposeIsTheOneOfTheMatrixThatItIs) {
  const auto sections = math::design_butterworth(math::FilterBand::low_pass, 4, 3.0, 50.0);
  ASSERT_EQ(sections.size(), 2);
  for (const Eigen::Index n : {1, 2, 7, 90}) {  // shorter than the reflected ends, and longer
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
    filter_rows(sections, matrix);  // row r is what a 1 at sample r becomes
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::VectorXd back = transposed_filter(sections, Eigen::VectorXd::Unit(n, i));
      EXPECT_LT((back - matrix.col(i)).cwiseAbs().maxCoeff(), 1e-13) << n << " " << i;
    }
  }
}

}  // namespace
}  // namespace myoid::identification
