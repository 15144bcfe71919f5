#include "myoid/study/checks/person_size.h"

#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::study {
namespace {

using ::testing::HasSubstr;

/// A forearm of this length that turns, with markers on both ends and noise of the skin.
MarkerSeries forearm(double length_m, double skin_m, std::uint64_t seed) {
  constexpr Eigen::Index kFrames = 200;
  MarkerSeries markers;
  markers.names = {"r_epicondyle_lateral", "r_epicondyle_medial", "r_styloid_radial", "r_styloid_ulnar"};
  markers.time_s = Eigen::VectorXd::LinSpaced(kFrames, 0.0, 1.99);
  markers.positions_m = Eigen::MatrixXd(kFrames, 12);
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> noise(0.0, skin_m);
  for (Eigen::Index f = 0; f < kFrames; ++f) {
    const double q = 0.01 * static_cast<double>(f);
    const Vec3 along(std::sin(q), -std::cos(q), 0.0);
    for (Eigen::Index m = 0; m < 4; ++m) {
      const Vec3 end = m < 2 ? Vec3::Zero() : Vec3(length_m * along);
      const Vec3 p =
          end + Vec3(0.0, 0.0, m % 2 == 0 ? 0.03 : -0.03) + Vec3(noise(engine), noise(engine), noise(engine));
      markers.positions_m.block<1, 3>(f, 3 * m) = p.transpose();
    }
  }
  return markers;
}

std::optional<Remark> of_forearms(const std::vector<double>& lengths_m, double skin_m = 0.002) {
  const body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  std::vector<TrialSize> sizes;
  for (std::size_t i = 0; i < lengths_m.size(); ++i)
    sizes.push_back(size_of(model, std::string(1, static_cast<char>('a' + i)), forearm(lengths_m[i], skin_m, 1 + i)));
  return unlike_sizes(sizes);
}

TEST(PersonSize, AForearmThatIsLongerInOneTrialIsNamedWithBothLengths) {
  const auto found = of_forearms({0.240, 0.288, 0.242});
  ASSERT_TRUE(found);
  EXPECT_THAT(found->says,
              HasSubstr("segments are 20 % longer in 'b' than in 'a' (the forearm from the epicondyles to "
                        "the styloids: 240 mm in 'a', 'c'; 288 mm in 'b'): the trials are of two persons"));
  EXPECT_THAT(found->remedy, HasSubstr("myoid cohort"));
}

TEST(PersonSize, WhatSkinAndMarkersMoveIsNoOtherPerson) {
  EXPECT_FALSE(of_forearms({0.250, 0.260, 0.255}));
  EXPECT_FALSE(of_forearms({0.250, 0.290}, 0.02));  // the length changes as much within the trials
  EXPECT_FALSE(of_forearms({0.250}));
}

/// Trials with these lengths [m] of a thorax.
std::optional<Remark> of_thorax(const std::vector<std::vector<double>>& lengths_m) {
  std::vector<TrialSize> sizes;
  for (const auto& of_trial : lengths_m) {
    TrialSize size{.trial = std::string(1, static_cast<char>('a' + sizes.size())), .lengths_m = {}};
    for (const double length : of_trial) size.lengths_m[fmt::format("length {}", size.lengths_m.size())] = length;
    sizes.push_back(size);
  }
  return unlike_sizes(sizes);
}

// A marker that slips, or skin that moves it, changes the distances to this marker only.
TEST(PersonSize, OneMovedMarkerIsNoOtherPerson) {
  EXPECT_FALSE(of_thorax({{0.26, 0.31, 0.24, 0.18, 0.28}, {0.26, 0.31, 0.24, 0.21, 0.23}}));
  EXPECT_TRUE(of_thorax({{0.26, 0.31, 0.24, 0.18, 0.28}, {0.29, 0.35, 0.27, 0.20, 0.28}}));
  EXPECT_FALSE(of_thorax({{}, {}}));
}

TEST(PersonSize, AnyTwoMarkersOfABodyAreALengthUnlessTheyAreNear) {
  const body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  MarkerSeries markers = forearm(0.25, 0.0, 1);
  for (const Eigen::Index m : {2, 3}) markers.positions_m.col(3 * m + 2) *= 4.0;
  const TrialSize size = size_of(model, "a", markers);
  EXPECT_EQ(size.lengths_m.size(), 2U);  // not between the epicondyles
  EXPECT_NEAR(size.lengths_m.at("forearm_hand from marker 'r_styloid_radial' to 'r_styloid_ulnar'"), 0.24, 1e-12);
}

}  // namespace
}  // namespace myoid::study
