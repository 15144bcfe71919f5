#include "myoid/page/packing.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "myoid/ground/core/numbers.h"

#include "tests/support/packed_codes.h"

namespace myoid::page {
namespace {

std::string base64_of(std::string_view text) {
  const std::vector<std::uint8_t> bytes(text.begin(), text.end());
  return base64(std::span<const std::uint8_t>(bytes));
}

TEST(Base64, GivesTheExamplesOfItsStandard) {
  // RFC 4648, section 10.
  EXPECT_EQ(base64_of(""), "");
  EXPECT_EQ(base64_of("f"), "Zg==");
  EXPECT_EQ(base64_of("fo"), "Zm8=");
  EXPECT_EQ(base64_of("foo"), "Zm9v");
  EXPECT_EQ(base64_of("foob"), "Zm9vYg==");
  EXPECT_EQ(base64_of("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64_of("foobar"), "Zm9vYmFy");
}

TEST(Base64, TakesNumbersWithTheLittleEndFirst) {
  EXPECT_EQ(base64(std::vector<std::uint16_t>{0x6f66, 0x626f}), base64_of("foob"));
  EXPECT_EQ(base64(std::vector<float>{1.0F}), base64_of(std::string_view("\0\0\x80\x3f", 4)));
}

TEST(PackedCodes, AreReadBack) {
  std::mt19937_64 random(7);
  std::uniform_int_distribution<int> any(0, 65535), small(-3, 3);
  for (const std::size_t columns : {1UL, 3UL, 4UL}) {
    std::vector<std::uint16_t> noise, walk, smooth, zeros(12, 0);
    for (std::size_t i = 0; i < 120; ++i) {
      noise.push_back(static_cast<std::uint16_t>(any(random)));
      walk.push_back(static_cast<std::uint16_t>((i < columns ? 70 : walk[i - columns]) + small(random)));
      smooth.push_back(static_cast<std::uint16_t>(8000.0 + 8000.0 * std::sin(0.05 * static_cast<double>(i / columns))));
    }
    smooth[50] = kPackedMissing;
    for (const auto& codes : {noise, walk, smooth, zeros, {}})
      EXPECT_EQ(test::read_codes(packed_codes(codes, columns), columns), std::vector<int>(codes.begin(), codes.end()));
  }
}

TEST(PackedCodes, OfASmoothCurveNeedFewBits) {
  std::vector<std::uint16_t> smooth;
  for (int i = 0; i < 600; ++i) smooth.push_back(static_cast<std::uint16_t>(8000.0 + 8000.0 * std::sin(0.03 * i)));
  // Second differences of at most 0.03^2 8000 = 7.2 and the rounding's 2: about 5 bits, of 6 in a digit.
  EXPECT_LT(packed_codes(smooth).size(), 600U);
}

TEST(Packing, BringsPointsBackWithinHalfAStep) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> number(-1.5, 2.0);
  std::vector<Vec3> points;
  for (int i = 0; i < 500; ++i) points.emplace_back(number(random), number(random), 0.1);
  points.emplace_back(kNan, kNan, kNan);
  const PackingBox box = packing_box(points);
  EXPECT_LT(box.step, 3.5 / kPlaceSteps * 1.0000001);
  for (const Vec3& p : points) {
    std::vector<std::uint16_t> packed;
    pack(box, p, packed);
    ASSERT_EQ(packed.size(), 3U);
    for (Eigen::Index k = 0; k < 3; ++k) {
      const std::uint16_t n = packed[static_cast<std::size_t>(k)];
      if (std::isnan(p[k])) {
        EXPECT_EQ(n, kPlaceMissing);
      } else {
        EXPECT_NEAR(box.origin[k] + box.step * n, p[k], 0.5000001 * box.step);
      }
    }
  }
}

TEST(Packing, OfOnePointOrNoneHasABoxToo) {
  const std::vector<Vec3> one{{1.0, 2.0, 3.0}};
  EXPECT_EQ(packing_box(one).origin, one[0]);
  EXPECT_GT(packing_box(one).step, 0.0);
  EXPECT_GT(packing_box({}).step, 0.0);
}

TEST(Packing, KeepsRotationsToAThirdOfAMillimeterAtAMeter) {
  for (const double angle : {0.0, 0.3, 1.5707963, 3.1415926, -2.0}) {
    const Mat3 R = Eigen::AngleAxisd(angle, Vec3(0.6, 0.0, 0.8)).toRotationMatrix();
    std::vector<std::uint16_t> n;
    pack(R, n);
    ASSERT_EQ(n.size(), 4U);
    Eigen::Quaterniond q;
    q.coeffs() << n[0] / 8191.0 - 1.0, n[1] / 8191.0 - 1.0, n[2] / 8191.0 - 1.0, n[3] / 8191.0 - 1.0;
    EXPECT_GE(q.w(), 0.0);
    // Four components off by at most 6.1e-5 each turn by at most twice their norm, 2.5e-4; the matrix by sqrt(2) of it.
    EXPECT_LT((q.normalized().toRotationMatrix() - R).norm(), 3.5e-4) << angle;
  }
}

TEST(Packing, OfValuesHoldsItsEndsAndMarksWhatIsMissing) {
  EXPECT_EQ(pack(0.0, 10.0), 0);
  EXPECT_EQ(pack(10.0, 10.0), kPackedSteps);
  EXPECT_EQ(pack(-1.0, 10.0), 0);
  EXPECT_EQ(pack(11.0, 10.0), kPackedSteps);
  EXPECT_EQ(pack(kNan, 10.0), kPackedMissing);
  EXPECT_NEAR(10.0 * pack(3.3, 10.0) / kPackedSteps, 3.3, 1.3e-3);
}

}  // namespace
}  // namespace myoid::page
