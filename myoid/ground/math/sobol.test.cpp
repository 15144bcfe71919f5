#include "myoid/ground/math/sobol.h"

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground::math {
namespace {

TEST(Sobol, FirstTenPointsInThreeDimensionsAreJoeAndKuos) {
  // The worked example that accompanies the direction numbers.
  Eigen::MatrixXd expected(10, 3);
  expected << 0, 0, 0, 0.5, 0.5, 0.5, 0.75, 0.25, 0.25, 0.25, 0.75, 0.75, 0.375, 0.375, 0.625, 0.875, 0.875, 0.125,
      0.625, 0.125, 0.875, 0.125, 0.625, 0.375, 0.1875, 0.3125, 0.9375, 0.6875, 0.8125, 0.4375;
  EXPECT_EQ(sobol_points(10, 3), expected);
}

TEST(Sobol, EveryDimensionFillsEverySliceOnce) {
  for (const bool scrambled : {false, true}) {
    SobolOptions options{.first = 1024};
    if (scrambled) options.scramble_seed = 42;
    const Eigen::MatrixXd points = sobol_points(1024, kSobolMaxDimensions, options);
    for (int d = 0; d < kSobolMaxDimensions; ++d) {
      std::set<int> slices;
      for (Eigen::Index i = 0; i < points.rows(); ++i) slices.insert(static_cast<int>(points(i, d) * 1024.0));
      EXPECT_EQ(slices.size(), 1024U) << "dimension " << d + 1;
      EXPECT_EQ(*slices.rbegin(), 1023);
    }
  }
}

TEST(Sobol, FirstTwoDimensionsFillEveryElementaryRectangleOnceScrambledOrNot) {
  // Dimensions 1 and 2 are a (0, 2)-sequence: of 2^8 points every dyadic rectangle of area 2^-8
  // holds exactly one, for each shape.
  for (const bool scrambled : {false, true}) {
    SobolOptions options;
    if (scrambled) options.scramble_seed = 3;
    const Eigen::MatrixXd points = sobol_points(256, 2, options);
    for (int k = 0; k <= 8; ++k) {
      std::set<std::pair<int, int>> cells;
      for (Eigen::Index i = 0; i < 256; ++i) {
        cells.emplace(static_cast<int>(std::ldexp(points(i, 0), k)), static_cast<int>(std::ldexp(points(i, 1), 8 - k)));
      }
      EXPECT_EQ(cells.size(), 256U) << "shape 2^-" << k;
    }
  }
}

TEST(Sobol, NoTwoDimensionsAreAlike) {
  // A wrong entry of the table that repeats another dimension's directions would show as pairs that
  // fill few cells. 4096 points on 64 x 64 cells: the worst pair of Joe and Kuo's numbers (chosen
  // for good pairs) still fills an eighth of them.
  const Eigen::MatrixXd points = sobol_points(4096, kSobolMaxDimensions);
  for (int a = 0; a < kSobolMaxDimensions; ++a) {
    for (int b = a + 1; b < kSobolMaxDimensions; ++b) {
      std::vector<bool> filled(4096, false);
      int cells = 0;
      for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const auto cell = static_cast<std::size_t>(static_cast<int>(points(i, a) * 64.0) * 64 +
                                                   static_cast<int>(points(i, b) * 64.0));
        if (!filled[cell]) ++cells;
        filled[cell] = true;
      }
      EXPECT_GE(cells, 512) << a + 1 << " and " << b + 1;
    }
  }
}

/// Integral of prod (|4 x_j - 2| + j) / (1 + j), j = 1..d: exactly 1 (Sobol's g function).
double g_mean(const Eigen::MatrixXd& points) {
  double sum = 0.0;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    double product = 1.0;
    for (Eigen::Index j = 0; j < points.cols(); ++j) {
      const double a = static_cast<double>(j + 1);
      product *= (std::abs(4.0 * points(i, j) - 2.0) + a) / (1.0 + a);
    }
    sum += product;
  }
  return sum / static_cast<double>(points.rows());
}

TEST(Sobol, IntegratesBetterThanChance) {
  // Variance of g in 10 dimensions is prod(1 + 1/(3 (1+j)^2)) - 1 = 0.24: 2^14 random points err by
  // 3.8e-3. A tenth of that is asked.
  EXPECT_NEAR(g_mean(sobol_points(1 << 14, 10)), 1.0, 3.8e-4);
  for (std::uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_NEAR(g_mean(sobol_points(1 << 14, 10, {.scramble_seed = seed})), 1.0, 3.8e-4);
}

TEST(Sobol, ScrambleIsSeededAndLeavesTheOpenCube) {
  const Eigen::MatrixXd a = sobol_points(1000, 5, {.scramble_seed = 1});
  EXPECT_EQ(a, sobol_points(1000, 5, {.scramble_seed = 1}));
  EXPECT_NE(a, sobol_points(1000, 5, {.scramble_seed = 2}));
  EXPECT_GT(a.minCoeff(), 0.0);
  EXPECT_LT(a.maxCoeff(), 1.0);
}

TEST(Sobol, APieceOfTheSequenceIsThatPiece) {
  for (const bool scrambled : {false, true}) {
    SobolOptions all, piece{.first = 37};
    if (scrambled) all.scramble_seed = piece.scramble_seed = 9;
    EXPECT_EQ(sobol_points(20, 7, piece), sobol_points(57, 7, all).bottomRows(20));
  }
  // The last point exists.
  EXPECT_EQ(sobol_points(1, 1, {.first = (Eigen::Index{1} << 32) - 1}).rows(), 1);
}

TEST(Sobol, RefusesWhatIsNotTabulated) {
  EXPECT_THROW((void)sobol_points(8, 0), InvalidInput);
  EXPECT_THROW((void)sobol_points(8, 65), InvalidInput);
  EXPECT_THROW((void)sobol_points(-1, 2), InvalidInput);
  EXPECT_THROW((void)sobol_points(2, 2, {.first = (Eigen::Index{1} << 32) - 1}), InvalidInput);
}

}  // namespace
}  // namespace myoid::inline ground::math
