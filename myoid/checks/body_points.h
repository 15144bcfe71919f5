#pragma once

#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/core/time_series.h"
#include "myoid/files/marker_series.h"
#include "myoid/model/body_model.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid {

/// Where the bodies of a model are in the frames of a trial: its markers, or, of a motion without
/// markers, the joints, centers of mass and markers of the model. One of the two is given.
class BodyPoints {
 public:
  BodyPoints(const model::BodyModel& model,
             const recording::MarkerSeries* markers,
             const TimeSeries* motion);

  [[nodiscard]] Eigen::Index frame_count() const;
  [[nodiscard]] double time_s(Eigen::Index frame) const;

  /// The points of this frame, for what follows.
  void pose(Eigen::Index frame);
  [[nodiscard]] const std::vector<Vec3>& of(model::BodyIndex body) const {
    return points_[static_cast<std::size_t>(body)];
  }
  /// From the nearest point of the body or of its neighbors across a joint: a foot may have its
  /// markers on the toes, and a marker of the ankle may be the shank's. Infinite without points.
  [[nodiscard]] double distance(const Vec3& p_G, model::BodyIndex body) const;
  /// From the nearest point of the body alone.
  [[nodiscard]] double of_one(const Vec3& p_G, model::BodyIndex body) const;

 private:
  const model::BodyModel* model_;
  const recording::MarkerSeries* markers_;
  const TimeSeries* motion_;
  model::BodyState state_;
  std::vector<model::BodyIndex> marker_body_;
  std::vector<std::vector<Vec3>> points_;
};

}  // namespace myoid
