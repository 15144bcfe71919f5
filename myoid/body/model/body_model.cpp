#include "myoid/body/model/body_model.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/body/model/joint_orientation.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/nearest_word.h"

namespace myoid::body {
namespace {

template <typename Items>
std::optional<int> find_by_name(const Items& items, std::string_view name) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return static_cast<int>(i);
  return std::nullopt;
}

template <typename Items>
int index_by_name(const Items& items, std::string_view name, std::string_view what) {
  if (const auto index = find_by_name(items, name)) return *index;
  throw ModelError(fmt::format("the model has no {} '{}'{}", what, name,
                               not_among(name, items, [](const auto& i) { return i.name; })));
}

void check_index(int index, std::size_t size, std::string_view what) {
  if (index < 0 || static_cast<std::size_t>(index) >= size) {
    throw ModelError(fmt::format("{} refers to number {} of {}", what, index, size));
  }
}

void check_references(const BodyModel& model) {
  for (const Joint& joint : model.joints) {
    check_index(joint.parent, model.bodies.size(), fmt::format("joint '{}': its parent", joint.name));
    check_index(joint.child, model.bodies.size(), fmt::format("joint '{}': its child", joint.name));
    for (const int c : joint.coordinates) {
      check_index(c, model.coordinates.size(), fmt::format("joint '{}': a coordinate", joint.name));
    }
    for (const auto* axes : {&joint.rotation, &joint.translation}) {
      for (const TransformAxis& axis : *axes) {
        if (axis.coordinate >= 0) {
          check_index(axis.coordinate, model.coordinates.size(), fmt::format("joint '{}': an axis", joint.name));
        }
      }
    }
  }
  for (const Marker& marker : model.markers) {
    check_index(marker.body, model.bodies.size(), fmt::format("marker '{}'", marker.name));
  }
  const auto check_path = [&](const std::string& owner, const MusclePath& path) {
    if (path.function) {
      for (const int c : path.function->coordinates)
        check_index(c, model.coordinates.size(), fmt::format("muscle '{}': its path", owner));
      return;
    }
    if (path.points.size() < 2) {
      throw ModelError(
          fmt::format("muscle '{}' has {} path points; at least two are needed", owner, path.points.size()));
    }
    for (const PathPoint& point : path.points) {
      check_index(point.body, model.bodies.size(), fmt::format("muscle '{}', point '{}'", owner, point.name));
    }
    for (const PathWrap& wrap : path.wraps) {
      check_index(wrap.wrap_object, model.wrap_objects.size(), fmt::format("muscle '{}': a wrap", owner));
    }
  };
  for (const Muscle& muscle : model.muscles) check_path(muscle.name, muscle.path);
  for (const PathActuator& actuator : model.path_actuators) check_path(actuator.name, actuator.path);
}

}  // namespace

std::optional<int> BodyModel::find_body(std::string_view n) const { return find_by_name(bodies, n); }
std::optional<int> BodyModel::find_coordinate(std::string_view n) const {
  if (const auto found = find_by_name(coordinates, n)) return found;
  const std::size_t slash = n.rfind('/');
  if (slash == std::string_view::npos) return std::nullopt;
  // In a path, the joint stands before the coordinate.
  const std::string_view last = n.substr(slash + 1);
  std::string_view owner = n.substr(0, slash);
  if (const std::size_t s = owner.rfind('/'); s != std::string_view::npos) owner.remove_prefix(s + 1);
  const std::string own_name = fmt::format("{}_{}", owner, last);
  for (const Joint& joint : joints) {
    if (joint.name != owner) continue;
    for (const int c : joint.coordinates) {
      const std::string& there = coordinates[at(c)].name;
      if (there == last || there == own_name) return c;
    }
  }
  return find_by_name(coordinates, last);
}
std::optional<int> BodyModel::find_marker(std::string_view n) const { return find_by_name(markers, n); }
std::optional<int> BodyModel::find_muscle(std::string_view n) const { return find_by_name(muscles, n); }
int BodyModel::coordinate_index(std::string_view n) const { return index_by_name(coordinates, n, "coordinate"); }
int BodyModel::muscle_index(std::string_view n) const { return index_by_name(muscles, n, "muscle"); }

bool BodyModel::is_constrained(int coordinate) const {
  const Coordinate& c = coordinates[at(coordinate)];
  return c.locked || c.prescribed || c.is_free_to_satisfy_constraints ||
         std::ranges::find(couplers, coordinate, &CoordinateCoupler::dependent) != couplers.end() ||
         std::any_of(constraints.begin(), constraints.end(), [&](const LoopConstraint& k) {
           const auto* f = std::get_if<FunctionConstraint>(&k.law);
           return f != nullptr && f->dependent == coordinate;
         });
}

Eigen::VectorXd BodyModel::default_q() const {
  Eigen::VectorXd q(static_cast<Eigen::Index>(coordinates.size()));
  for (std::size_t i = 0; i < coordinates.size(); ++i) q[static_cast<Eigen::Index>(i)] = coordinates[i].default_value;
  // A coupler's independent coordinate may itself depend on another.
  for (std::size_t round = 0; round < couplers.size(); ++round) {
    for (const CoordinateCoupler& c : couplers) q[c.dependent] = evaluate(c.function, q[c.independent]).value;
  }
  return q;
}

namespace {

/// Adds a second copy of body `b` for a joint that closes a loop. The copies share the mass, and a
/// weld constraint keeps them together.
BodyIndex add_copy(BodyModel& model, BodyIndex b, int number) {
  Body copy = model.bodies[at(b)];
  copy.name += fmt::format("_slave_{}", number);
  model.bodies.push_back(copy);
  const auto index = static_cast<BodyIndex>(model.bodies.size()) - 1;
  model.constraints.push_back(
      {fmt::format("{}_loop_{}", model.bodies[at(b)].name, number), "WeldConstraint",
       FrameConstraint{.body1 = b, .body2 = index, .X_BF1 = {}, .X_BF2 = {}, .rotation_too = true}});
  return index;
}

/// Returns the joints in the order in which OpenSim builds the tree: level by level, in the order
/// of the file. After a body without mass its heaviest child follows at once.
std::vector<std::size_t> tree_order(const BodyModel& model) {
  std::vector<std::vector<std::size_t>> hanging_on(model.bodies.size());  // joints by their parent
  for (std::size_t j = 0; j < model.joints.size(); ++j) hanging_on[at(model.joints[j].parent)].push_back(j);
  std::vector<int> level(model.bodies.size(), -1);
  level[0] = 0;
  std::vector<std::vector<std::size_t>> bodies_at{{0}};  // by their level
  std::vector<bool> used(model.joints.size(), false);
  std::vector<std::size_t> ordered;
  const auto child_of = [&](std::size_t j) { return static_cast<std::size_t>(model.joints[j].child); };
  const auto place = [&](std::size_t j) {
    used[j] = true;
    const int below = level[at(model.joints[j].parent)] + 1;
    level[child_of(j)] = below;
    bodies_at.resize(std::max(bodies_at.size(), static_cast<std::size_t>(below) + 1));
    bodies_at[at(below)].push_back(child_of(j));
    ordered.push_back(j);
  };
  const auto is_open = [&](std::size_t j) { return !used[j] && level[child_of(j)] < 0; };
  for (std::size_t current = 0; current < bodies_at.size(); ++current) {
    std::vector<std::size_t> next;
    for (const std::size_t body : bodies_at[current])
      next.insert(next.end(), hanging_on[body].begin(), hanging_on[body].end());
    std::sort(next.begin(), next.end());
    for (const std::size_t j : next) {
      if (!is_open(j)) continue;
      place(j);
      for (std::size_t end = child_of(j); model.bodies[end].mass_kg == 0.0;) {
        std::optional<std::size_t> heaviest;
        const auto mass = [&](std::size_t i) { return model.bodies[child_of(i)].mass_kg; };
        for (const std::size_t k : hanging_on[end])
          if (is_open(k) && (!heaviest || mass(k) > mass(*heaviest))) heaviest = k;
        if (!heaviest) break;
        place(*heaviest);
        end = child_of(*heaviest);
      }
    }
  }
  return ordered;
}

/// Cuts loops: if another joint has placed the child of a joint, this joint gets a copy of the child.
void cut_loops(BodyModel& model) {
  const std::vector<std::size_t> placed = tree_order(model);
  std::vector<int> copies(model.bodies.size(), 1);
  std::vector<bool> in_tree(model.joints.size(), false), has_joint(model.bodies.size(), false);
  for (const std::size_t j : placed) in_tree[j] = has_joint[at(model.joints[j].child)] = true;
  const std::size_t bodies = model.bodies.size();
  std::vector<std::size_t> cut;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const auto child = static_cast<std::size_t>(model.joints[j].child);
    if (in_tree[j] || (child != 0 && !has_joint[child])) continue;
    if (child == 0) {
      throw ModelError(
          fmt::format("joint '{}' has ground as its child; expected ground as the parent", model.joints[j].name));
    }
    ++copies[child];
    cut.push_back(j);
  }
  for (std::size_t b = 0; b < bodies; ++b) {
    model.bodies[b].mass_kg /= copies[b];
    model.bodies[b].I_BBcm_B /= copies[b];
  }
  for (const std::size_t j : cut) {
    Joint& joint = model.joints[j];
    joint.child = add_copy(model, joint.child, static_cast<int>(model.bodies.size()));
    model.notes.push_back(
        {.code = RemarkCode::reading,
         .severity = Severity::note,
         .says = fmt::format("joint '{}' closes a loop: it is cut there and held by a weld constraint", joint.name)});
  }
}

void check_tree(const BodyModel& model, const std::vector<Joint>& ordered) {
  std::vector<bool> placed(model.bodies.size(), false);
  placed[0] = true;
  for (const Joint& joint : ordered) placed[at(joint.child)] = true;
  for (const Joint& joint : model.joints) {
    if (placed[at(joint.child)]) continue;
    throw ModelError(
        fmt::format("body '{}' is not connected to ground by joints: joint '{}' hangs on '{}', which hangs on it or on "
                    "nothing",
                    model.bodies[at(joint.child)].name, joint.name, model.bodies[at(joint.parent)].name));
  }
  for (std::size_t b = 0; b < placed.size(); ++b) {
    if (!placed[b]) {
      throw ModelError(fmt::format("body '{}' is not connected to ground by joints", model.bodies[b].name));
    }
  }
}

}  // namespace

BodyModel finalize(BodyModel model) {
  if (model.bodies.empty()) throw ModelError("the model has no ground");
  check_references(model);
  for (std::size_t j = 0; j < model.joints.size(); ++j)
    if (model.joints[j].place_in_file < 0) model.joints[j].place_in_file = static_cast<int>(j);
  orient_joints(model);
  cut_loops(model);
  std::vector<Joint> ordered;
  for (const std::size_t j : tree_order(model)) ordered.push_back(model.joints[j]);
  check_tree(model, ordered);
  model.joints = std::move(ordered);
  model.joint_of_body.assign(model.bodies.size(), -1);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    model.joint_of_body[at(model.joints[j].child)] = static_cast<int>(j);
    for (const int c : model.joints[j].coordinates) {
      model.coordinates[at(c)].joint = static_cast<int>(j);
    }
  }
  return model;
}

}  // namespace myoid::body
