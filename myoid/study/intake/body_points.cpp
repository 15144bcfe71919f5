#include "myoid/study/intake/body_points.h"

#include <algorithm>
#include <limits>

namespace myoid::study {

BodyPoints::BodyPoints(const body::BodyModel& model, const MarkerSeries* markers, const TimeSeries* motion)
    : model_(&model), markers_(markers), motion_(motion), state_(body::make_state(model)) {
  if (markers == nullptr) return;
  for (const std::string& name : markers->names) {
    const auto known = model.find_marker(name);
    marker_body_.push_back(known ? model.markers[static_cast<std::size_t>(*known)].body : -1);
  }
}

Eigen::Index BodyPoints::frame_count() const {
  return markers_ != nullptr ? markers_->frame_count() : motion_->sample_count();
}

double BodyPoints::time_s(Eigen::Index frame) const {
  return markers_ != nullptr ? markers_->time_s[frame] : motion_->time_s()[frame];
}

void BodyPoints::pose(Eigen::Index frame) {
  points_.assign(model_->bodies.size(), {});
  if (markers_ != nullptr) {
    for (std::size_t m = 0; m < marker_body_.size(); ++m) {
      const auto column = static_cast<Eigen::Index>(m);
      if (marker_body_[m] < 0 || markers_->missing(frame, column)) continue;
      points_[static_cast<std::size_t>(marker_body_[m])].push_back(markers_->position(frame, column));
    }
    return;
  }
  Eigen::VectorXd q = model_->default_q();
  const TimeSeries& motion = *motion_;
  for (Eigen::Index c = 0; c < motion.channel_count(); ++c) {
    const auto index = model_->find_coordinate(motion.channels()[static_cast<std::size_t>(c)].name);
    if (index) q[*index] = motion.values()(frame, c);
  }
  body::compute_poses(*model_, q, state_);
  for (std::size_t b = 1; b < model_->bodies.size(); ++b) {
    points_[b].push_back(state_.X_GB[b].p);
    points_[b].push_back(state_.X_GB[b] * model_->bodies[b].p_BBcm_B);
  }
  for (const body::Marker& marker : model_->markers) {
    const auto b = static_cast<std::size_t>(marker.body);
    points_[b].push_back(state_.X_GB[b] * marker.p_BM);
  }
}

double BodyPoints::distance(const Vec3& p_G, body::BodyIndex body) const {
  double least = of_one(p_G, body);
  for (const body::Joint& joint : model_->joints) {
    if (joint.parent == body) least = std::min(least, of_one(p_G, joint.child));
    if (joint.child == body && joint.parent != 0) least = std::min(least, of_one(p_G, joint.parent));
  }
  return least;
}

double BodyPoints::of_one(const Vec3& p_G, body::BodyIndex body) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& point : points_[static_cast<std::size_t>(body)]) least = std::min(least, (point - p_G).norm());
  return least;
}

}  // namespace myoid::study
