#include "myoid/body/kinematics/open_coordinates.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "myoid/body/arm/arm4.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/body/osim/osim_reader.h"

namespace myoid::body {
namespace {

/// Twenty frames of a bending elbow as the markers of these bodies see it.
MarkerSeries seen_on(const body::BodyModel& model, const std::vector<std::string>& bodies) {
  MarkerSeries series;
  constexpr Eigen::Index kFrames = 20;
  series.time_s = Eigen::VectorXd::LinSpaced(kFrames, 0.0, 0.19);
  std::vector<std::size_t> taken;
  for (std::size_t m = 0; m < model.markers.size(); ++m) {
    const std::string& body = model.bodies[static_cast<std::size_t>(model.markers[m].body)].name;
    if (std::ranges::find(bodies, body) == bodies.end()) continue;
    taken.push_back(m);
    series.names.push_back(model.markers[m].name);
  }
  series.positions_m.resize(kFrames, static_cast<Eigen::Index>(3 * taken.size()));
  body::BodyState state = body::make_state(model);
  Eigen::VectorXd q = model.default_q();
  for (Eigen::Index i = 0; i < kFrames; ++i) {
    q[model.coordinate_index("elbow_flexion")] = 0.6 + 0.05 * static_cast<double>(i);
    body::compute_poses(model, q, state);
    for (std::size_t k = 0; k < taken.size(); ++k) {
      const body::Marker& marker = model.markers[taken[k]];
      series.positions_m.block<1, 3>(i, static_cast<Eigen::Index>(3 * k)) =
          (state.X_GB[static_cast<std::size_t>(marker.body)] * marker.p_BM).transpose();
    }
  }
  return series;
}

bool is_open(const std::vector<std::string>& open, const std::string& name) {
  return std::ranges::find(open, name) != open.end();
}

TEST(OpenCoordinates, AreThoseThatNoMarkerFollows) {
  const body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  EXPECT_TRUE(open_coordinates(model, seen_on(model, {"upper_arm", "forearm_hand"})).empty());
  const std::vector<std::string> open = open_coordinates(model, seen_on(model, {"trunk", "upper_arm"}));
  EXPECT_EQ(open, std::vector<std::string>{"elbow_flexion"});
  EXPECT_TRUE(is_open(open_coordinates(model, seen_on(model, {"trunk"})), "shoulder_rotation"));
}

TEST(OpenCoordinates, OfFramesInWhichMarkersAreLostTheFullestCount) {
  const body::BodyModel model = body::parse_osim(body::arm4_osim(), "arm4.osim");
  MarkerSeries markers = seen_on(model, {"upper_arm", "forearm_hand"});
  // The forearm is hidden in the first and the last frames.
  for (Eigen::Index i : {Eigen::Index{0}, Eigen::Index{1}, Eigen::Index{19}}) {
    for (std::size_t m = 0; m < markers.names.size(); ++m) {
      const body::Marker& marker = model.markers[static_cast<std::size_t>(*model.find_marker(markers.names[m]))];
      if (model.bodies[static_cast<std::size_t>(marker.body)].name == "forearm_hand")
        markers.positions_m.block<1, 3>(i, static_cast<Eigen::Index>(3 * m))
            .setConstant(std::numeric_limits<double>::quiet_NaN());
    }
  }
  EXPECT_TRUE(open_coordinates(model, markers).empty());
}

}  // namespace
}  // namespace myoid::body
