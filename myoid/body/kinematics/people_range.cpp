#include "myoid/body/kinematics/people_range.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string_view>

#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

struct Published {
  std::string_view word;  ///< In the coordinate's name, without its signs.
  double low_deg, high_deg;
  bool either_way = false;  ///< Models differ in the direction of flexion.
};

constexpr std::array<Published, 12> kPublished{{{"elbowflex", 0.0, 150.0, true},
                                                {"kneeangle", 0.0, 135.0, true},
                                                {"kneeflex", 0.0, 135.0, true},
                                                {"ankleangle", -50.0, 20.0},
                                                {"subtalarangle", -35.0, 35.0},
                                                {"hipflexion", -30.0, 120.0},
                                                {"hipadduction", -45.0, 30.0},
                                                {"hipabduction", -30.0, 45.0},
                                                {"hiprotation", -45.0, 45.0},
                                                {"prosup", -80.0, 80.0},
                                                {"wristflex", -80.0, 80.0},
                                                {"shoulderflex", -60.0, 180.0}}};
constexpr double kBetweenPeopleDeg = 10.0;

}  // namespace

std::optional<PeopleRange> people_range(const std::string& coordinate, double lower_rad, double upper_rad) {
  std::string plain;  // "Knee_Angle_r" is "kneeangler"
  for (const char c : coordinate)
    if (std::isalpha(static_cast<unsigned char>(c)) != 0)
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  const auto found = std::ranges::find_if(
      kPublished, [&](const Published& each) { return plain.find(each.word) != std::string::npos; });
  if (found == kPublished.end()) return std::nullopt;
  const double low = (found->low_deg - kBetweenPeopleDeg) * kDegree;
  const double high = (found->high_deg + kBetweenPeopleDeg) * kDegree;
  if (found->either_way && std::abs(lower_rad) > std::abs(upper_rad)) return PeopleRange{-high, -low};
  return PeopleRange{low, high};
}

}  // namespace myoid::body
