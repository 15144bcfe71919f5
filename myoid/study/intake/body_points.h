#pragma once

#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"

namespace myoid::study {

/// Positions of a model's bodies in the frames of a trial: by its markers, or, for a motion without
/// markers, by the joints, centers of mass and markers of the model. One of the two is given.
class BodyPoints {
 public:
  BodyPoints(const body::BodyModel& model, const MarkerSeries* markers, const TimeSeries* motion);

  [[nodiscard]] Eigen::Index frame_count() const;
  [[nodiscard]] double time_s(Eigen::Index frame) const;

  /// Computes the points of this frame for the calls that follow.
  void pose(Eigen::Index frame);
  [[nodiscard]] const std::vector<Vec3>& of(body::BodyIndex body) const {
    return points_[static_cast<std::size_t>(body)];
  }
  /// Returns the distance from the nearest point of the body or of its neighbors across a joint. A foot may have its
  /// markers on the toes, and a marker of the ankle may belong to the shank. Infinite without points.
  [[nodiscard]] double distance(const Vec3& p_G, body::BodyIndex body) const;
  /// Returns the distance from the nearest point of the body alone.
  [[nodiscard]] double of_one(const Vec3& p_G, body::BodyIndex body) const;

 private:
  const body::BodyModel* model_;
  const MarkerSeries* markers_;
  const TimeSeries* motion_;
  body::BodyState state_;
  std::vector<body::BodyIndex> marker_body_;
  std::vector<std::vector<Vec3>> points_;
};

}  // namespace myoid::study
