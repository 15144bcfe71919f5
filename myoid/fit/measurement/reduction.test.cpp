#include "myoid/fit/measurement/reduction.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace myoid::fit {
namespace {

TEST(Reduction, HasMinusThreeDecibelsAtTheCutOff) {
  const Eigen::Index n = 401;
  const double rate = 20.0, cutoff = 1.5;
  const Reduction l(n, rate, cutoff);
  EXPECT_LT(l.outputs(), n / 3 + 2);
  Eigen::VectorXd sine(n), cosine(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double phase = 2.0 * std::numbers::pi * cutoff * static_cast<double>(i) / rate;
    sine[i] = std::sin(phase);
    cosine[i] = std::cos(phase);
  }
  const Eigen::Index middle = l.outputs() / 2;
  const double amplitude = std::hypot(l.apply(sine)(middle, 0), l.apply(cosine)(middle, 0));
  EXPECT_NEAR(amplitude, std::sqrt(0.5), 0.005);
  EXPECT_LT((l.apply(Eigen::VectorXd::Ones(n)).array() - 1.0).abs().maxCoeff(), 1e-12);
}

TEST(Reduction, ItsProductsAreThoseOfItsMatrix) {
  const Eigen::Index n = 60;
  const Reduction l(n, 20.0, 1.5);
  const Eigen::MatrixXd matrix = l.apply(Eigen::MatrixXd::Identity(n, n));
  const Eigen::MatrixXd a = Eigen::MatrixXd::NullaryExpr(l.outputs(), 3, [](Eigen::Index i, Eigen::Index j) {
    return std::sin(1.0 + 3.0 * static_cast<double>(i) + 7.0 * static_cast<double>(j));
  });
  EXPECT_LT((l.transposed(a) - matrix.transpose() * a).norm(), 1e-12 * a.norm());
  // Every row has the same weights, a stride later, inside the run.
  for (Eigen::Index j = 0; j < l.outputs(); ++j) {
    const Eigen::VectorXd row = matrix.row(j);
    EXPECT_EQ(row.segment(l.first(j), l.weights().size()), l.weights());
    EXPECT_NEAR(row.sum(), 1.0, 1e-12);
    EXPECT_EQ(l.first(j), l.first(0) + j * l.stride());
  }
  EXPECT_GE(l.first(0), 0);
  EXPECT_LE(l.first(l.outputs() - 1) + l.weights().size(), n);
}

TEST(Reduction, AShortRunIsOneRow) {
  const Reduction l(9, 20.0, 1.5);
  EXPECT_EQ(l.outputs(), 1);
  EXPECT_NEAR(l.apply(Eigen::VectorXd::Ones(9))(0, 0), 1.0, 1e-12);
}

TEST(Reduction, IsTheIdentityWithoutACutOff) {
  const Reduction l(10, 20.0, {});
  EXPECT_EQ(l.apply(Eigen::MatrixXd::Identity(10, 10)), Eigen::MatrixXd::Identity(10, 10));
}

}  // namespace
}  // namespace myoid::fit
