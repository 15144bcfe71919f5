#include "myoid/model/body_model.h"

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::model {
namespace {

template <typename Items>
std::optional<int> find_by_name(const Items& items, std::string_view name) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == name) return static_cast<int>(i);
  }
  return std::nullopt;
}

template <typename Items>
int index_by_name(const Items& items, std::string_view name, std::string_view what) {
  if (const auto index = find_by_name(items, name)) return *index;
  std::string names;
  for (const auto& item : items) names += (names.empty() ? "" : ", ") + item.name;
  throw ModelError(fmt::format("the model has no {} '{}'; there are: {}", what, name,
                               names.empty() ? "none" : names));
}

void check_index(int index, std::size_t size, std::string_view what) {
  if (index < 0 || static_cast<std::size_t>(index) >= size) {
    throw ModelError(fmt::format("{} refers to number {} of {}", what, index, size));
  }
}

void check_references(const BodyModel& model) {
  for (const Joint& joint : model.joints) {
    check_index(joint.parent, model.bodies.size(),
                fmt::format("joint '{}': its parent", joint.name));
    check_index(joint.child, model.bodies.size(), fmt::format("joint '{}': its child", joint.name));
    for (const int c : joint.coordinates) {
      check_index(c, model.coordinates.size(), fmt::format("joint '{}': a coordinate", joint.name));
    }
    for (const auto* axes : {&joint.rotation, &joint.translation}) {
      for (const TransformAxis& axis : *axes) {
        if (axis.coordinate >= 0) {
          check_index(axis.coordinate, model.coordinates.size(),
                      fmt::format("joint '{}': an axis", joint.name));
        }
      }
    }
  }
  for (const Marker& marker : model.markers) {
    check_index(marker.body, model.bodies.size(), fmt::format("marker '{}'", marker.name));
  }
  for (const Muscle& muscle : model.muscles) {
    if (muscle.path.points.size() < 2) {
      throw ModelError(fmt::format("muscle '{}' has {} path points; at least two are needed",
                                   muscle.name, muscle.path.points.size()));
    }
    for (const PathPoint& point : muscle.path.points) {
      check_index(point.body, model.bodies.size(),
                  fmt::format("muscle '{}', point '{}'", muscle.name, point.name));
    }
    for (const PathWrap& wrap : muscle.path.wraps) {
      check_index(wrap.wrap_object, model.wrap_objects.size(),
                  fmt::format("muscle '{}': a wrap", muscle.name));
    }
  }
}

}  // namespace

std::optional<int> BodyModel::find_body(std::string_view n) const {
  return find_by_name(bodies, n);
}
std::optional<int> BodyModel::find_coordinate(std::string_view n) const {
  return find_by_name(coordinates, n);
}
std::optional<int> BodyModel::find_marker(std::string_view n) const {
  return find_by_name(markers, n);
}
std::optional<int> BodyModel::find_muscle(std::string_view n) const {
  return find_by_name(muscles, n);
}
int BodyModel::coordinate_index(std::string_view n) const {
  return index_by_name(coordinates, n, "coordinate");
}
int BodyModel::muscle_index(std::string_view n) const {
  return index_by_name(muscles, n, "muscle");
}

Eigen::VectorXd BodyModel::default_q() const {
  Eigen::VectorXd q(static_cast<Eigen::Index>(coordinates.size()));
  for (std::size_t i = 0; i < coordinates.size(); ++i)
    q[static_cast<Eigen::Index>(i)] = coordinates[i].default_value;
  return q;
}

BodyModel finalize(BodyModel model) {
  if (model.bodies.empty()) throw ModelError("the model has no ground");
  check_references(model);
  std::vector<bool> placed(model.bodies.size(), false);
  placed[0] = true;
  std::vector<Joint> ordered;
  std::vector<bool> used(model.joints.size(), false);
  for (bool progress = true; progress;) {
    progress = false;
    for (std::size_t j = 0; j < model.joints.size(); ++j) {
      const Joint& joint = model.joints[j];
      if (used[j] || !placed[static_cast<std::size_t>(joint.parent)]) continue;
      if (placed[static_cast<std::size_t>(joint.child)]) {
        throw ModelError(fmt::format(
            "body '{}' is the child of two joints ('{}' closes a loop); loops are not supported",
            model.bodies[static_cast<std::size_t>(joint.child)].name, joint.name));
      }
      placed[static_cast<std::size_t>(joint.child)] = true;
      used[j] = true;
      progress = true;
      ordered.push_back(joint);
    }
  }
  for (std::size_t b = 0; b < placed.size(); ++b) {
    if (!placed[b]) {
      throw ModelError(
          fmt::format("body '{}' is not connected to ground by joints", model.bodies[b].name));
    }
  }
  model.joints = std::move(ordered);
  model.joint_of_body.assign(model.bodies.size(), -1);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    model.joint_of_body[static_cast<std::size_t>(model.joints[j].child)] = static_cast<int>(j);
    for (const int c : model.joints[j].coordinates) {
      model.coordinates[static_cast<std::size_t>(c)].joint = static_cast<int>(j);
    }
  }
  return model;
}

}  // namespace myoid::model
