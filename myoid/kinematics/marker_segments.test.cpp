#include "myoid/kinematics/marker_segments.h"

#include <gtest/gtest.h>

#include "myoid/arm/arm4.h"
#include "myoid/osim/osim_reader.h"

namespace myoid::kinematics {
namespace {

TEST(SegmentsOf, AreTheBodiesThatCarryTwoMarkersOrMore) {
  const model::BodyModel model = model::parse_osim(model::arm4_osim(), "arm4.osim");
  recording::MarkerSeries markers;
  for (const model::Marker& marker : model.markers) markers.names.push_back(marker.name);
  markers.names.emplace_back("of nobody");
  std::size_t known = 0;
  for (const signals::ExpectedSegment& e : segments_of(model, markers)) {
    ASSERT_GE(e.segment.markers.size(), 2U);
    ASSERT_EQ(static_cast<std::size_t>(e.local_m.cols()), e.segment.markers.size());
    for (std::size_t k = 0; k < e.segment.markers.size(); ++k) {
      const auto& marker = model.markers[static_cast<std::size_t>(e.segment.markers[k])];
      EXPECT_EQ(model.bodies[static_cast<std::size_t>(marker.body)].name, e.segment.name);
      EXPECT_EQ(marker.p_BM, e.local_m.col(static_cast<Eigen::Index>(k)));
      ++known;
    }
  }
  EXPECT_GE(known, 2U);
}

}  // namespace
}  // namespace myoid::kinematics
