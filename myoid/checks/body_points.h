#pragma once

#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/core/time_series.h"
#include "myoid/files/marker_series.h"
#include "myoid/model/body_model.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid {

/// Positions of a model's bodies in the frames of a trial: by its markers, or, for a motion without
/// markers, by the joints, centers of mass and markers of the model. One of the two is given.
class BodyPoints {
 public:
  BodyPoints(const model::BodyModel& model, const recording::MarkerSeries* markers, const TimeSeries* motion);

  [[nodiscard]] Eigen::Index frame_count() const;
  [[nodiscard]] double time_s(Eigen::Index frame) const;

  /// Computes the points of this frame for the calls that follow.
  void pose(Eigen::Index frame);
  [[nodiscard]] const std::vector<Vec3>& of(model::BodyIndex body) const {
    return points_[static_cast<std::size_t>(body)];
  }
  /// Returns the distance from the nearest point of the body or of its neighbors across a joint. A foot may have its
  /// markers on the toes, and a marker of the ankle may belong to the shank. Infinite without points.
  [[nodiscard]] double distance(const Vec3& p_G, model::BodyIndex body) const;
  /// Returns the distance from the nearest point of the body alone.
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
