#include "myoid/body/model/joint_orientation.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"

namespace myoid::body {
namespace {

bool rests(const std::array<TransformAxis, 3>& axes) {
  return std::all_of(axes.begin(), axes.end(), [](const TransformAxis& axis) {
    return axis.coordinate < 0 && evaluate(axis.function, 0.0).value == 0.0;
  });
}

bool uses(const std::array<TransformAxis, 3>& axes, int coordinate) {
  return std::ranges::find(axes, coordinate, &TransformAxis::coordinate) != axes.end();
}

/// Returns the axes with opposite motions.
std::array<TransformAxis, 3> backward(std::array<TransformAxis, 3> axes) {
  for (TransformAxis& axis : axes) axis.function.scale = -axis.function.scale;
  return axes;
}

/// Returns the axes of a joint that does not move in this way.
std::array<TransformAxis, 3> at_rest(std::array<TransformAxis, 3> axes) {
  for (TransformAxis& axis : axes) {
    axis.coordinate = -1;
    axis.function = Constant{0.0};
  }
  return axes;
}

void turn_round(BodyModel& model, std::size_t number) {
  const Joint joint = model.joints[number];
  if (joint.ellipsoid_radii_m || joint.rod_length_m) {
    throw ModelError(fmt::format(
        "joint '{}' ({}) has its parent '{}' hang on its child '{}'; expected it the other way "
        "round: such a joint cannot be turned",
        joint.name, joint.class_name, model.bodies[at(joint.parent)].name, model.bodies[at(joint.child)].name));
  }
  model.notes.push_back(
      {.code = RemarkCode::reading,
       .severity = Severity::note,
       .says = fmt::format("joint '{}' leads from '{}' to '{}', which is nearer to ground: it is turned "
                           "round, its coordinates keep their sense",
                           joint.name, model.bodies[at(joint.parent)].name, model.bodies[at(joint.child)].name)});
  Joint back = joint;
  back.parent = joint.child;
  back.X_PF = joint.X_BM;
  back.child = joint.parent;
  back.X_BM = joint.X_PF;
  // X_FM^-1 is the inverse rotation and then, in its frame, the inverse translation.
  back.rotation = backward(joint.rotation);
  std::swap(back.rotation[0], back.rotation[2]);
  back.translation = backward(joint.translation);
  if (rests(joint.translation) || rests(joint.rotation)) {
    model.joints[number] = std::move(back);
    return;
  }
  Joint turn = back;
  Joint shift = back;
  turn.coordinates.clear();
  shift.coordinates.clear();
  for (const int c : joint.coordinates) {
    if (uses(joint.rotation, c) && uses(joint.translation, c)) {
      throw ModelError(
          fmt::format("joint '{}' has its parent '{}' hang on its child '{}', and coordinate '{}' both turns "
                      "and shifts: it cannot be turned round; exchange its parent and child",
                      joint.name, model.bodies[at(joint.parent)].name, model.bodies[at(joint.child)].name,
                      model.coordinates[at(c)].name));
    }
    (uses(joint.translation, c) ? shift : turn).coordinates.push_back(c);
  }
  model.bodies.push_back({.name = joint.name + "_turn"});
  const auto between = static_cast<BodyIndex>(model.bodies.size()) - 1;
  turn.name += "_turn";
  turn.child = between;
  turn.X_BM = {};
  turn.translation = at_rest(turn.translation);
  shift.parent = between;
  shift.X_PF = {};
  shift.rotation = at_rest(shift.rotation);
  model.joints[number] = std::move(turn);
  model.joints.insert(model.joints.begin() + static_cast<std::ptrdiff_t>(number) + 1, std::move(shift));
}

}  // namespace

void orient_joints(BodyModel& model) {
  std::vector<bool> reached(model.bodies.size(), false);
  reached[0] = true;
  for (;;) {
    std::vector<std::vector<BodyIndex>> children(model.bodies.size());
    for (const Joint& joint : model.joints) children[at(joint.parent)].push_back(joint.child);
    std::vector<BodyIndex> grown;
    for (std::size_t b = 0; b < reached.size(); ++b)
      if (reached[b]) grown.push_back(static_cast<BodyIndex>(b));
    while (!grown.empty()) {
      const BodyIndex parent = grown.back();
      grown.pop_back();
      for (const BodyIndex child : children[at(parent)]) {
        if (reached[at(child)]) continue;
        reached[at(child)] = true;
        grown.push_back(child);
      }
    }
    const auto reversed = std::find_if(model.joints.begin(), model.joints.end(),
                                       [&](const Joint& j) { return reached[at(j.child)] && !reached[at(j.parent)]; });
    if (reversed == model.joints.end()) return;
    turn_round(model, static_cast<std::size_t>(reversed - model.joints.begin()));
    reached.resize(model.bodies.size(), false);
  }
}

}  // namespace myoid::body
