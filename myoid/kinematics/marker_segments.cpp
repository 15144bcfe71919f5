#include "myoid/kinematics/marker_segments.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

namespace myoid::kinematics {

std::vector<signals::ExpectedSegment> segments_of(const model::BodyModel& model,
                                                  const recording::MarkerSeries& markers) {
  std::map<int, signals::ExpectedSegment> by_body;
  for (const model::Marker& marker : model.markers) {
    const auto it = std::find(markers.names.begin(), markers.names.end(), marker.name);
    if (it == markers.names.end()) continue;
    signals::ExpectedSegment& e = by_body[marker.body];
    e.segment.name =
        marker.body >= 0 ? model.bodies[static_cast<std::size_t>(marker.body)].name : std::string("ground");
    e.segment.markers.push_back(it - markers.names.begin());
    e.local_m.conservativeResize(3, e.local_m.cols() + 1);
    e.local_m.col(e.local_m.cols() - 1) = marker.p_BM;
  }
  std::vector<signals::ExpectedSegment> segments;
  for (auto& [body, e] : by_body) {
    if (e.segment.markers.size() >= 2) segments.push_back(std::move(e));
  }
  return segments;
}

}  // namespace myoid::kinematics
