#include "myoid/body/kinematics/marker_places.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/moving_markers.h"

namespace myoid::body {
namespace {

/// A model of one free body with these markers.
body::BodyModel body_with(const std::vector<std::string>& names, const Eigen::Matrix3Xd& places_m) {
  body::BodyModel model;
  model.bodies.push_back({.name = "thorax"});
  for (std::size_t k = 0; k < names.size(); ++k)
    model.markers.push_back({.name = names[k], .body = 0, .p_BM = places_m.col(static_cast<Eigen::Index>(k))});
  return model;
}

/// A recording of five markers in motion under these names; they stand 10 % farther apart than on `shape()`.
MarkerSeries recorded(const std::vector<std::string>& names) {
  MarkerSeries markers = test::moving_markers();
  markers.names = names;
  return markers;
}

Eigen::Matrix3Xd shape() { return test::forearm_shape() / 1.1; }

TEST(MarkersByPlace, FindsAMarkerUnderAnotherNameWhereItStands) {
  const body::BodyModel model = body_with({"IJ", "PX", "T8", "c7", "T4"}, shape());
  const std::vector<PlacedMarker> found = markers_by_place(model, recorded({"IJ", "PX", "T8", "Nacken", "X1"}));
  ASSERT_EQ(found.size(), 2U);
  for (const PlacedMarker& pair : found) {
    EXPECT_EQ(pair.wanted, pair.recorded == "Nacken" ? "c7" : "T4");
    EXPECT_LT(pair.distance_m, 0.005);
  }
  EXPECT_THAT(place_question(found), testing::HasSubstr("'Nacken' where the model has 'c7'"));
}

TEST(MarkersByPlace, ANameThatIsSpelledAlikeIsNoPlace) {
  // The model's c7 lies 6 cm from the recorded c1.
  Eigen::Matrix3Xd places = shape();
  places.col(3) += Vec3(-0.03, 0.05, 0.0);
  const body::BodyModel model = body_with({"IJ", "PX", "T8", "c7", "T4"}, places);
  EXPECT_TRUE(markers_by_place(model, recorded({"IJ", "PX", "T8", "c1", "T4"})).empty());
}

TEST(MarkersByPlace, TwoMarkersPlaceNoBody) {
  const body::BodyModel model = body_with({"IJ", "PX", "T8", "c7", "T4"}, shape());
  EXPECT_TRUE(markers_by_place(model, recorded({"IJ", "PX", "A", "B", "C"})).empty());
}

TEST(MarkersByPlace, AMarkerOfAnotherBodyThatPassesIsNotTaken) {
  const body::BodyModel model = body_with({"IJ", "PX", "T8", "c7", "T4"}, shape());
  MarkerSeries markers = recorded({"IJ", "PX", "T8", "hand", "T4"});
  // In most frames it is near, but now and then 10 cm away.
  for (Eigen::Index f = 0; f < markers.frame_count(); ++f)
    markers.positions_m(f, 9) += 0.1 * std::pow(std::sin(0.1 * static_cast<double>(f)), 8);
  EXPECT_TRUE(markers_by_place(model, markers).empty());
}

}  // namespace
}  // namespace myoid::body
