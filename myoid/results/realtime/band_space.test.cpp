#include "myoid/results/realtime/band_space.h"

#include <cmath>

#include <gtest/gtest.h>

namespace myoid::results {
namespace {

using Eigen::Index;

Eigen::MatrixXd numbers(Index rows, Index columns, double phase) {
  Eigen::MatrixXd m(rows, columns);
  for (Index i = 0; i < m.size(); ++i) m(i) = std::sin(phase + 0.7 * static_cast<double>(i * i % 97));
  return m;
}

/// Computes the variances and compares them with the dense products of their definition. All
/// numbers are about 1, so that round-off is some 1e-13 of the sums of thousands of products; of
/// torques block by block it is that of single precision.
void expect_dense(const std::vector<std::vector<Index>>& variables, Index unknowns, Index joints, bool by_block) {
  const Eigen::MatrixXd root = numbers(unknowns, unknowns, 0.3);
  const Eigen::MatrixXd C = root * root.transpose();
  BandSpace bands(C, variables, static_cast<std::size_t>(joints));
  EXPECT_EQ(bands.by_block(), by_block);
  const auto blocks = static_cast<Index>(variables.size());
  bands.arms.topRows(blocks - joints) = numbers(blocks - joints, joints, 0.9);
  Eigen::MatrixXd s = Eigen::MatrixXd::Zero(unknowns, blocks);
  for (std::size_t b = 0; b < variables.size(); ++b) {
    for (std::size_t i = 0; i < variables[b].size(); ++i) {
      const double slope = std::cos(static_cast<double>(3 * b + i));
      bands.slopes_of(b)[i] = slope;
      s(variables[b][i], static_cast<Index>(b)) += slope;
    }
  }
  for (int again = 0; again < 2; ++again) {
    bands.compute(C);
    for (Index m = 0; m < blocks - joints; ++m) {
      const double expected = s.col(m).dot(C * s.col(m));
      EXPECT_NEAR(bands.force_variance[m], expected, 1e-11 * (1.0 + expected)) << m;
    }
    for (Index j = 0; j < joints; ++j) {
      const Eigen::VectorXd t = s * bands.arms.col(j);
      const double expected = t.dot(C * t);
      const double terms = t.cwiseAbs().dot(C.cwiseAbs() * t.cwiseAbs());
      EXPECT_NEAR(bands.torque_variance[j], expected, (by_block ? 1e-7 : 1e-13) * terms) << j;
    }
  }
}

TEST(BandSpace, HasTheVariancesOfTheDenseProducts) {
  for (const Index joints : {1, 3, 6, 8}) {
    std::vector<std::vector<Index>> own, shared;
    Index unknowns = 0;
    for (Index m = 0; m < 13; ++m) {
      own.emplace_back();
      for (Index i = 0; i < 2 + m % 5; ++i) own.back().push_back(unknowns++);
      shared.push_back({m % 3, 3 + m % 2, 0, 5, 6});  // a muscle may have one unknown twice
    }
    for (Index j = 0; j < joints; ++j) {
      own.push_back({j, 2});
      shared.emplace_back();
    }
    expect_dense(own, unknowns, joints, true);
    expect_dense(shared, 7, joints, false);
  }
}

}  // namespace
}  // namespace myoid::results
