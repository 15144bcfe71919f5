#include "myoid/page/scene.h"

#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"

#include "tests/support/small_scene.h"

namespace myoid::page {
namespace {

using test::small_scene;

TEST(Scene, OfAgreeingNumbersIsValid) { EXPECT_NO_THROW(validate(small_scene())); }

TEST(Scene, WhoseNumbersDisagreeIsRefusedByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<std::string, std::function<void(Scene&)>>> faults{
      {"ground", [](Scene& s) { s.bodies.clear(); }},
      {"'WRI' is on no body", [](Scene& s) { s.markers[0].point.body = 2; }},
      {"'elbow' is on no body", [](Scene& s) { s.surfaces[0].body = -1; }},
      {"muscle 'BIC'", [&](Scene& s) { s.muscles[0].points[1].position_m.x() = nan; }},
      {"no frames", [](Scene& s) { s.time_s.resize(0); }},
      {"2 frames", [](Scene& s) { s.poses.pop_back(); }},
      {"frame 1: a pose for each body", [](Scene& s) { s.poses[1].pop_back(); }},
      {"'forearm' is nowhere", [&](Scene& s) { s.poses[1][1].p.y() = nan; }},
      {"frame 0: a line", [](Scene& s) { s.lines_m[0].clear(); }},
      {"the line of muscle number 1", [&](Scene& s) { s.lines_m[1][0][1].z() = nan; }},
      {"no muscle number 7", [](Scene& s) { s.moving_muscles[0] = 7; }},
      {"frames x coordinates", [](Scene& s) { s.coordinate_values.resize(2, 3); }},
      {"'force' of frames x muscles", [](Scene& s) { s.values[0].top = 0.0; }},
      {"frames x measured markers", [](Scene& s) { s.measured_m.resize(2, 4); }}};
  for (const auto& [text, fault] : faults) {
    Scene scene = small_scene();
    fault(scene);
    try {
      validate(scene);
      FAIL() << text;
    } catch (const InvalidInput& error) {
      EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr(text), testing::HasSubstr("flex <slow>")));
    }
  }
}

}  // namespace
}  // namespace myoid::page
