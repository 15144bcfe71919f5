#include "myoid/model/osim_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <pugixml.hpp>

#include "myoid/core/error.h"
#include "myoid/recording/text_file.h"

namespace myoid::model {
namespace {

using recording::equal_ignoring_case;
using recording::parse_number;
using recording::split_words;
using recording::trim;

/// A frame fixed to a body.
struct FixedFrame {
  BodyIndex body = 0;
  Pose X_BF;
};

/// A frame as the file describes it, not yet resolved.
struct OffsetFrame {
  pugi::xml_node node;
  std::string owner;  ///< Path of the component that holds it.
};

std::string text_of(pugi::xml_node node) {
  std::string text = node.text().get();
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\r', ' ');
  return std::string(trim(text));
}

class Reader {
 public:
  Reader(std::string_view xml, std::filesystem::path path) : xml_(xml), path_(std::move(path)) {}

  BodyModel read();

 private:
  [[noreturn]] void fail(pugi::xml_node where, const std::string& message) const {
    const auto offset = std::max<std::ptrdiff_t>(0, where.offset_debug());
    const auto end =
        xml_.begin() + std::min<std::ptrdiff_t>(offset, static_cast<std::ptrdiff_t>(xml_.size()));
    throw ReadError(path_, static_cast<std::size_t>(1 + std::count(xml_.begin(), end, '\n')),
                    message);
  }

  /// The child of this name, or the one that `<defaults>` has for this class.
  pugi::xml_node property(pugi::xml_node object, const char* name) const {
    if (const auto child = object.child(name)) return child;
    const auto it = prototypes_.find(object.name());
    return it == prototypes_.end() ? pugi::xml_node() : it->second.child(name);
  }

  std::vector<double> numbers(pugi::xml_node node) const {
    std::vector<double> values;
    const std::string text = text_of(node);
    for (const std::string_view word : split_words(text)) {
      const auto value = parse_number(word);
      if (!value) fail(node, fmt::format("<{}>: expected numbers, found '{}'", node.name(), word));
      values.push_back(*value);
    }
    return values;
  }
  double number(pugi::xml_node object, const char* name, double otherwise) const {
    const auto node = property(object, name);
    if (!node || text_of(node).empty()) return otherwise;
    const auto values = numbers(node);
    if (values.size() != 1)
      fail(node, fmt::format("<{}>: expected one number, found {}", name, values.size()));
    return values[0];
  }
  Vec3 vec3(pugi::xml_node object, const char* name, const Vec3& otherwise) const {
    const auto node = property(object, name);
    if (!node || text_of(node).empty()) return otherwise;
    const auto values = numbers(node);
    if (values.size() != 3)
      fail(node, fmt::format("<{}>: expected three numbers, found {}", name, values.size()));
    return {values[0], values[1], values[2]};
  }
  bool flag(pugi::xml_node object, const char* name, bool otherwise) const {
    const auto node = property(object, name);
    if (!node) return otherwise;
    const std::string text = text_of(node);
    if (equal_ignoring_case(text, "true") || text == "1") return true;
    if (equal_ignoring_case(text, "false") || text == "0") return false;
    fail(node, fmt::format("<{}>: expected true or false, found '{}'", name, text));
  }
  std::string word(pugi::xml_node object, const char* name) const {
    return text_of(property(object, name));
  }

  /// The objects of a set: <XSet><objects>...</objects></XSet>.
  static auto objects(pugi::xml_node set) { return set.child("objects").children(); }

  void read_prototypes(pugi::xml_node defaults);
  void read_bodies(pugi::xml_node model);
  void collect_frames(pugi::xml_node parent, const std::string& owner);
  FixedFrame resolve(pugi::xml_node where,
                     std::string name,
                     const std::string& owner,
                     int depth = 0) const;
  BodyIndex whole_body(pugi::xml_node where, const FixedFrame& frame) const;

  void read_joints(pugi::xml_node model);
  void read_coordinates(pugi::xml_node joint, std::vector<std::string>& names);
  void set_axes(pugi::xml_node node, Joint& joint, const std::vector<std::string>& names);
  void set_custom_axes(pugi::xml_node node, Joint& joint);
  void set_motion_types(Joint& joint);
  Function read_function(pugi::xml_node node) const;

  void read_markers(pugi::xml_node model);
  void read_wrap_objects(pugi::xml_node holder, const std::string& frame);
  void read_forces(pugi::xml_node set);
  Muscle read_muscle(pugi::xml_node node);
  PathPoint read_point(pugi::xml_node node, const std::string& muscle);
  int coordinate_of_socket(pugi::xml_node where, const std::string& text) const;
  void read_constraints(pugi::xml_node model);

  std::string_view xml_;
  std::filesystem::path path_;
  BodyModel model_;
  std::map<std::string, pugi::xml_node> prototypes_;
  std::map<std::string, OffsetFrame> frames_;  ///< By absolute path.
  std::set<std::string> unsupported_wraps_;
};

void Reader::read_prototypes(pugi::xml_node defaults) {
  for (const auto node : defaults.children()) prototypes_[node.name()] = node;
}

void Reader::collect_frames(pugi::xml_node parent, const std::string& owner) {
  for (const auto node : parent.children()) {
    if (std::strcmp(node.name(), "PhysicalOffsetFrame") == 0) {
      const std::string path = owner + "/" + node.attribute("name").value();
      frames_[path] = {node, owner};
      collect_frames(node.child("components"), path);
    }
  }
}

void Reader::read_bodies(pugi::xml_node model) {
  model_.bodies.push_back({.name = "ground"});
  collect_frames(model.child("Ground").child("components"), "/ground");
  collect_frames(model.child("components"), "");
  for (const auto node : objects(model.child("ComponentSet"))) {
    if (std::strcmp(node.name(), "PhysicalOffsetFrame") == 0) {
      frames_[std::string("/componentset/") + node.attribute("name").value()] = {node,
                                                                                 "/componentset"};
    }
  }
  for (const auto node : objects(model.child("BodySet"))) {
    Body body;
    body.name = node.attribute("name").value();
    if (body.name.empty()) fail(node, "a body has no name");
    if (model_.find_body(body.name))
      fail(node, fmt::format("two bodies are named '{}'", body.name));
    body.mass_kg = number(node, "mass", std::nan(""));
    if (!(body.mass_kg >= 0.0) || !std::isfinite(body.mass_kg)) {
      fail(node, fmt::format("body '{}': expected a mass of 0 or more in kg", body.name));
    }
    body.p_BBcm_B = vec3(node, "mass_center", Vec3::Zero());
    if (const auto inertia = property(node, "inertia")) {
      const auto v = numbers(inertia);
      if (v.size() != 6)
        fail(inertia, fmt::format("body '{}': expected six numbers xx yy zz xy xz yz, found {}",
                                  body.name, v.size()));
      body.I_BBcm_B << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
    }
    if (body.mass_kg == 0.0) body.I_BBcm_B.setZero();
    collect_frames(node.child("components"), "/bodyset/" + body.name);
    model_.bodies.push_back(std::move(body));
  }
}

FixedFrame Reader::resolve(pugi::xml_node where,
                           std::string name,
                           const std::string& owner,
                           int depth) const {
  if (depth > 32) fail(where, fmt::format("frame '{}' refers to itself", name));
  std::vector<std::string> candidates;
  if (name.starts_with('/')) {
    candidates.push_back(name);
  } else {
    std::string base = owner;
    while (name.starts_with("../")) {
      name.erase(0, 3);
      base.erase(std::min(base.find_last_of('/'), base.size()));
    }
    for (;;) {
      candidates.push_back(base + "/" + name);
      if (base.empty()) break;
      base.erase(base.find_last_of('/'));
    }
    candidates.push_back("/bodyset/" + name);
  }
  for (const std::string& path : candidates) {
    if (path == "/ground") return {0, {}};
    if (path.starts_with("/bodyset/")) {
      if (const auto body = model_.find_body(path.substr(9))) return {*body, {}};
    }
    if (const auto it = frames_.find(path); it != frames_.end()) {
      const FixedFrame parent = resolve(it->second.node, word(it->second.node, "socket_parent"),
                                        it->second.owner, depth + 1);
      const Pose X{rotation_body_xyz(vec3(it->second.node, "orientation", Vec3::Zero())),
                   vec3(it->second.node, "translation", Vec3::Zero())};
      return {parent.body, parent.X_BF * X};
    }
  }
  fail(where, fmt::format("there is no frame '{}'", name));
}

Function Reader::read_function(pugi::xml_node node) const {
  const std::string kind = node.name();
  if (kind == "Constant") return Constant{number(node, "value", 0.0)};
  if (kind == "LinearFunction") {
    const auto c = node.child("coefficients") ? numbers(node.child("coefficients"))
                                              : std::vector<double>{1.0, 0.0};
    if (c.size() != 2)
      fail(node,
           fmt::format("<coefficients>: expected slope and intercept, found {} numbers", c.size()));
    return Linear{c[0], c[1]};
  }
  if (kind == "PolynomialFunction") return Polynomial{numbers(node.child("coefficients"))};
  if (kind == "MultiplierFunction") {
    pugi::xml_node inner = node.child("function").first_child();
    while (inner && inner.type() != pugi::node_element) inner = inner.next_sibling();
    if (!inner) fail(node, "<MultiplierFunction> has no function inside");
    Function function = read_function(inner);
    function.scale *= number(node, "scale", 1.0);
    return function;
  }
  const bool spline =
      kind == "SimmSpline" || kind == "NaturalCubicSpline" || kind == "natCubicSpline";
  if (spline || kind == "PiecewiseLinearFunction") {
    std::vector<double> x = numbers(node.child("x"));
    std::vector<double> y = numbers(node.child("y"));
    try {
      SimmSpline checked = make_simm_spline(x, y);
      if (spline) return checked;
      return PiecewiseLinear{std::move(x), std::move(y)};
    } catch (const InvalidInput& error) {
      fail(node, error.what());
    }
  }
  fail(node, fmt::format("the function <{}> is not supported", kind));
}

void Reader::read_coordinates(pugi::xml_node joint, std::vector<std::string>& names) {
  for (const auto node : joint.child("coordinates").children("Coordinate")) {
    Coordinate c;
    c.name = node.attribute("name").value();
    if (model_.find_coordinate(c.name))
      fail(node, fmt::format("two coordinates are named '{}'", c.name));
    c.default_value = number(node, "default_value", 0.0);
    if (const auto range = property(node, "range")) {
      const auto v = numbers(range);
      if (v.size() != 2) fail(range, "<range>: expected two numbers");
      c.lower = v[0];
      c.upper = v[1];
    }
    c.clamped = flag(node, "clamped", false);
    c.locked = flag(node, "locked", false);
    if (flag(node, "prescribed", false) && node.child("prescribed_function").first_child()) {
      model_.notes.push_back(
          fmt::format("coordinate '{}' is prescribed; it is held at its default value", c.name));
      c.locked = true;
    }
    names.push_back(c.name);
    model_.coordinates.push_back(std::move(c));
  }
}

void Reader::set_custom_axes(pugi::xml_node node, Joint& joint) {
  const char* slots[6] = {"rotation1",    "rotation2",    "rotation3",
                          "translation1", "translation2", "translation3"};
  std::vector<int> order;
  for (std::size_t k = 0; k < 6; ++k) {
    TransformAxis& axis = k < 3 ? joint.rotation[k] : joint.translation[k - 3];
    axis.axis = Vec3::Unit(static_cast<Eigen::Index>(k % 3));
    const auto transform = property(node, "SpatialTransform");
    const auto slot = transform.find_child_by_attribute("TransformAxis", "name", slots[k]);
    if (!slot) continue;
    axis.axis = vec3(slot, "axis", axis.axis);
    if (!(axis.axis.norm() > 0.0)) fail(slot, "<axis>: the direction is zero");
    axis.axis.normalize();
    const std::string coordinate = word(slot, "coordinates");
    if (!coordinate.empty()) {
      const auto index = model_.find_coordinate(coordinate);
      if (!index)
        fail(slot, fmt::format("<coordinates>: the joint has no coordinate '{}'", coordinate));
      axis.coordinate = *index;
      if (std::find(order.begin(), order.end(), *index) == order.end()) order.push_back(*index);
    }
    pugi::xml_node function;
    for (const auto child : slot.children()) {
      const std::string name = child.name();
      if (child.type() != pugi::node_element || name == "coordinates" || name == "axis") continue;
      if (name == "function") {
        for (const auto inner : child.children()) {
          if (inner.type() == pugi::node_element) function = inner;
        }
      } else {
        function = child;
      }
    }
    if (function) {
      axis.function = read_function(function);
    } else if (axis.coordinate >= 0) {
      axis.function = Linear{1.0, 0.0};
    }
  }
  // OpenSim orders a joint's coordinates by their first use.
  std::vector<Coordinate> sorted;
  std::map<int, int> moved;
  for (const int index : joint.coordinates) {
    if (std::find(order.begin(), order.end(), index) == order.end()) order.push_back(index);
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    sorted.push_back(model_.coordinates[static_cast<std::size_t>(order[k])]);
    moved[order[k]] = joint.coordinates[k];
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    model_.coordinates[static_cast<std::size_t>(joint.coordinates[k])] = sorted[k];
  }
  for (auto* axes : {&joint.rotation, &joint.translation}) {
    for (TransformAxis& axis : *axes) {
      if (axis.coordinate >= 0) axis.coordinate = moved.at(axis.coordinate);
    }
  }
}

void Reader::set_axes(pugi::xml_node node, Joint& joint, const std::vector<std::string>& names) {
  for (std::size_t k = 0; k < 3; ++k) {
    joint.rotation[k].axis = joint.translation[k].axis = Vec3::Unit(static_cast<Eigen::Index>(k));
  }
  if (joint.class_name == "CustomJoint") return set_custom_axes(node, joint);
  std::size_t used = 0;
  const auto drive = [&](TransformAxis& axis, Eigen::Index direction) {
    if (used >= joint.coordinates.size()) {
      fail(node, fmt::format("joint '{}' ({}): {} coordinates are too few", joint.name,
                             joint.class_name, names.size()));
    }
    axis.axis = Vec3::Unit(direction);
    axis.coordinate = joint.coordinates[used++];
    axis.function = Linear{1.0, 0.0};
  };
  const std::string& kind = joint.class_name;
  if (kind == "WeldJoint") return;
  if (kind == "PinJoint") {
    drive(joint.rotation[0], 2);
    joint.rotation[2].axis = Vec3::UnitX();
  } else if (kind == "SliderJoint") {
    drive(joint.translation[0], 0);
  } else if (kind == "UniversalJoint") {
    drive(joint.rotation[0], 0);
    drive(joint.rotation[1], 1);
  } else if (kind == "BallJoint" || kind == "GimbalJoint" || kind == "FreeJoint") {
    for (std::size_t k = 0; k < 3; ++k) drive(joint.rotation[k], static_cast<Eigen::Index>(k));
    if (kind == "FreeJoint") {
      for (std::size_t k = 0; k < 3; ++k) drive(joint.translation[k], static_cast<Eigen::Index>(k));
    }
    if (kind != "GimbalJoint") {
      model_.notes.push_back(fmt::format(
          "joint '{}' ({}): its speeds are the rates of its coordinates here; OpenSim's inverse "
          "dynamics takes them as angular velocities and differs there",
          joint.name, kind));
    }
  } else if (kind == "PlanarJoint") {
    drive(joint.rotation[0], 2);
    joint.rotation[2].axis = Vec3::UnitX();
    drive(joint.translation[0], 0);
    drive(joint.translation[1], 1);
  } else {
    model_.unsupported.push_back(
        fmt::format("joint '{}' of kind {} is held at its default position", joint.name, kind));
  }
}

void Reader::set_motion_types(Joint& joint) {
  for (const int index : joint.coordinates) {
    MotionType type = MotionType::coupled;
    for (const TransformAxis& axis : joint.translation) {
      if (axis.coordinate == index && std::holds_alternative<Linear>(axis.function.form))
        type = MotionType::translational;
    }
    for (const TransformAxis& axis : joint.rotation) {
      if (axis.coordinate != index) continue;
      const auto* line = std::get_if<Linear>(&axis.function.form);
      if (line != nullptr && std::abs(std::abs(line->slope * axis.function.scale) - 1.0) < 1e-12)
        type = MotionType::rotational;
    }
    model_.coordinates[static_cast<std::size_t>(index)].motion = type;
  }
}

void Reader::read_joints(pugi::xml_node model) {
  for (const auto node : objects(model.child("JointSet"))) {
    const std::string path = std::string("/jointset/") + node.attribute("name").value();
    collect_frames(node.child("frames"), path);
  }
  for (const auto node : objects(model.child("JointSet"))) {
    Joint joint;
    joint.name = node.attribute("name").value();
    joint.class_name = node.name();
    const std::string path = "/jointset/" + joint.name;
    const FixedFrame parent = resolve(node, word(node, "socket_parent_frame"), path);
    const FixedFrame child = resolve(node, word(node, "socket_child_frame"), path);
    joint.parent = parent.body;
    joint.X_PF = parent.X_BF;
    joint.child = child.body;
    joint.X_BM = child.X_BF;
    std::vector<std::string> names;
    const int first = static_cast<int>(model_.coordinates.size());
    read_coordinates(node, names);
    for (int k = 0; k < static_cast<int>(names.size()); ++k) joint.coordinates.push_back(first + k);
    set_axes(node, joint, names);
    set_motion_types(joint);
    model_.joints.push_back(std::move(joint));
  }
}

void Reader::read_markers(pugi::xml_node model) {
  for (const auto node : objects(model.child("MarkerSet"))) {
    if (std::strcmp(node.name(), "Marker") != 0) continue;
    Marker marker;
    marker.name = node.attribute("name").value();
    const FixedFrame frame =
        resolve(node, word(node, "socket_parent_frame"), "/markerset/" + marker.name);
    marker.body = frame.body;
    marker.p_BM = frame.X_BF * vec3(node, "location", Vec3::Zero());
    model_.markers.push_back(std::move(marker));
  }
}

void Reader::read_wrap_objects(pugi::xml_node holder, const std::string& frame_path) {
  for (const auto node : objects(holder.child("WrapObjectSet"))) {
    WrapObject wrap;
    wrap.name = node.attribute("name").value();
    const FixedFrame frame = resolve(node, frame_path, "");
    wrap.body = frame.body;
    wrap.X_BW = frame.X_BF * Pose{rotation_body_xyz(vec3(node, "xyz_body_rotation", Vec3::Zero())),
                                  vec3(node, "translation", Vec3::Zero())};
    wrap.active = flag(node, "active", true);
    const std::string quadrant = word(node, "quadrant");
    if (!quadrant.empty() && quadrant != "all" && !equal_ignoring_case(quadrant, "Unassigned")) {
      const int axis = quadrant.back() - 'x' + 1;
      if (axis < 1 || axis > 3)
        fail(node, fmt::format("<quadrant>: expected all, x, -x, ..., found '{}'", quadrant));
      wrap.quadrant = quadrant.front() == '-' ? -axis : axis;
    }
    const std::string kind = node.name();
    if (kind == "WrapCylinder") {
      wrap.shape = CylinderShape{number(node, "radius", 1.0), number(node, "length", 1.0)};
    } else if (kind == "WrapEllipsoid") {
      wrap.shape = EllipsoidShape{vec3(node, "dimensions", Vec3::Constant(0.05))};
    } else {
      unsupported_wraps_.insert(wrap.name);
      continue;
    }
    model_.wrap_objects.push_back(std::move(wrap));
  }
}

int Reader::coordinate_of_socket(pugi::xml_node where, const std::string& text) const {
  const std::string name =
      text.substr(text.find_last_of('/') == std::string::npos ? 0 : text.find_last_of('/') + 1);
  const auto index = model_.find_coordinate(name);
  if (!index) fail(where, fmt::format("there is no coordinate '{}'", text));
  return *index;
}

PathPoint Reader::read_point(pugi::xml_node node, const std::string& muscle) {
  PathPoint point;
  point.name = node.attribute("name").value();
  const FixedFrame frame = resolve(node, word(node, "socket_parent_frame"), "/forceset/" + muscle);
  point.body = frame.body;
  const std::string kind = node.name();
  if (kind == "MovingPathPoint") {
    PathPoint::Moving moving;
    const char* axes[3] = {"x", "y", "z"};
    for (std::size_t k = 0; k < 3; ++k) {
      pugi::xml_node holder = node.child(fmt::format("{}_location", axes[k]).c_str());
      pugi::xml_node function;
      for (const auto child : holder.children()) {
        if (child.type() == pugi::node_element) function = child;
      }
      if (!function) continue;
      moving.location[k] = read_function(function);
      const std::string socket = word(node, fmt::format("socket_{}_coordinate", axes[k]).c_str());
      if (!socket.empty()) moving.coordinate = coordinate_of_socket(node, socket);
    }
    if (frame.X_BF.p != Vec3::Zero() || frame.X_BF.R != Mat3::Identity()) {
      fail(node, fmt::format("moving point '{}' sits on an offset frame; that is not supported",
                             point.name));
    }
    point.moving = std::move(moving);
    return point;
  }
  point.p_BP = frame.X_BF * vec3(node, "location", Vec3::Zero());
  if (kind == "ConditionalPathPoint") {
    PathPoint::Condition condition;
    const std::string socket = word(node, "socket_coordinate");
    condition.coordinate = coordinate_of_socket(node, socket);
    if (const auto range = property(node, "range")) {
      const auto v = numbers(range);
      if (v.size() != 2) fail(range, "<range>: expected two numbers");
      condition.lower = std::min(v[0], v[1]);
      condition.upper = std::max(v[0], v[1]);
    }
    point.condition = condition;
  } else if (kind != "PathPoint") {
    model_.unsupported.push_back(
        fmt::format("muscle '{}': path point of kind {} taken as fixed", muscle, kind));
  }
  return point;
}

Muscle Reader::read_muscle(pugi::xml_node node) {
  Muscle muscle;
  muscle.name = node.attribute("name").value();
  muscle.class_name = node.name();
  muscle.applies_force = flag(node, "appliesForce", true);
  MuscleProperties& p = muscle.properties;
  const bool thelen = muscle.class_name == "Thelen2003Muscle";
  p.max_isometric_force_n = number(node, "max_isometric_force", 1000.0);
  p.optimal_fiber_length_m = number(node, "optimal_fiber_length", 0.1);
  p.tendon_slack_length_m = number(node, "tendon_slack_length", 0.2);
  p.pennation_at_optimal_rad = number(node, "pennation_angle_at_optimal", 0.0);
  p.max_contraction_velocity = number(node, "max_contraction_velocity", 10.0);
  p.active_shape = number(node, "KshapeActive", p.active_shape);
  p.passive_shape = number(node, "KshapePassive", p.passive_shape);
  p.max_tendon_strain = number(node, "FmaxTendonStrain", p.max_tendon_strain);
  p.max_muscle_strain = number(node, "FmaxMuscleStrain", p.max_muscle_strain);
  p.concentric_shape = number(node, "Af", p.concentric_shape);
  p.eccentric_plateau = number(node, "Flen", p.eccentric_plateau);
  p.force_velocity_extrapolation =
      number(node, "fv_linear_extrap_threshold", p.force_velocity_extrapolation);
  p.max_pennation_rad = number(node, "maximum_pennation_angle", p.max_pennation_rad);
  p.activation_time_s = number(node, "activation_time_constant", thelen ? 0.015 : 0.01);
  p.deactivation_time_s = number(node, "deactivation_time_constant", thelen ? 0.05 : 0.04);
  p.min_control = number(node, "min_control", 0.01);
  p.max_control = number(node, "max_control", 1.0);
  if (!thelen) {
    model_.notes.push_back(
        fmt::format("muscle '{}' is a {}; its force law is taken as Thelen's with the same numbers",
                    muscle.name, muscle.class_name));
  }
  pugi::xml_node geometry = node.child("GeometryPath");
  if (!geometry) {
    for (const auto child : node.child("path").children()) {
      if (child.type() == pugi::node_element) geometry = child;
    }
    if (!geometry) geometry = node.child("path").child("GeometryPath");
  }
  if (!geometry) fail(node, fmt::format("muscle '{}' has no <GeometryPath>", muscle.name));
  for (const auto point : objects(geometry.child("PathPointSet")))
    muscle.path.points.push_back(read_point(point, muscle.name));
  for (const auto wrap_node : objects(geometry.child("PathWrapSet"))) {
    const std::string name = word(wrap_node, "wrap_object");
    PathWrap wrap;
    for (std::size_t w = 0; w < model_.wrap_objects.size() && wrap.wrap_object < 0; ++w) {
      if (model_.wrap_objects[w].name == name) wrap.wrap_object = static_cast<int>(w);
    }
    if (wrap.wrap_object < 0) {
      if (!unsupported_wraps_.contains(name))
        fail(wrap_node, fmt::format("there is no wrap object '{}'", name));
      model_.unsupported.push_back(
          fmt::format("muscle '{}' runs straight where it should wrap over '{}' (sphere and torus "
                      "are not supported)",
                      muscle.name, name));
      continue;
    }
    const std::string method = word(wrap_node, "method");
    wrap.method = method == "midpoint" ? WrapMethod::midpoint
                  : method == "axial"  ? WrapMethod::axial
                                       : WrapMethod::hybrid;
    if (const auto range = property(wrap_node, "range")) {
      const auto v = numbers(range);
      if (v.size() == 2) {
        wrap.range_start = static_cast<int>(v[0]);
        wrap.range_end = static_cast<int>(v[1]);
      }
    }
    muscle.path.wraps.push_back(wrap);
  }
  return muscle;
}

void Reader::read_forces(pugi::xml_node set) {
  for (const auto node : objects(set)) {
    const std::string kind = node.name();
    if (kind.find("Muscle") != std::string::npos) {
      model_.muscles.push_back(read_muscle(node));
    } else if (kind == "CoordinateActuator") {
      CoordinateActuator actuator;
      actuator.name = node.attribute("name").value();
      actuator.coordinate = coordinate_of_socket(node, word(node, "coordinate"));
      actuator.optimal_force = number(node, "optimal_force", 1.0);
      actuator.min_control = number(node, "min_control", actuator.min_control);
      actuator.max_control = number(node, "max_control", actuator.max_control);
      model_.actuators.push_back(std::move(actuator));
    } else if (flag(node, "appliesForce", true)) {
      model_.unsupported.push_back(
          fmt::format("force '{}' of kind {} is not part of inverse dynamics here",
                      node.attribute("name").value(), kind));
    }
  }
}

void Reader::read_constraints(pugi::xml_node model) {
  for (const auto node : objects(model.child("ConstraintSet"))) {
    if (!flag(node, "isEnforced", true)) continue;
    model_.unsupported.push_back(fmt::format("constraint '{}' of kind {} is not enforced",
                                             node.attribute("name").value(), node.name()));
  }
}

BodyModel Reader::read() {
  pugi::xml_document document;
  const auto parsed = document.load_buffer(xml_.data(), xml_.size(), pugi::parse_default);
  if (!parsed) {
    const auto end = xml_.begin() + std::clamp<std::ptrdiff_t>(
                                        parsed.offset, 0, static_cast<std::ptrdiff_t>(xml_.size()));
    throw ReadError(
        path_, static_cast<std::size_t>(1 + std::count(xml_.begin(), end, '\n')),
        fmt::format("not valid XML: {}; the file may be cut off", parsed.description()));
  }
  const auto root = document.child("OpenSimDocument");
  if (!root)
    throw ReadError(path_, 1,
                    "expected <OpenSimDocument> as the root; this is not an OpenSim file");
  const int version = root.attribute("Version").as_int();
  const auto model = root.child("Model");
  if (!model)
    fail(root, "the document has no <Model>; this is another kind of OpenSim file (a set-up?)");
  if (version < 30517) {
    fail(root, fmt::format(
                   "document version {} is too old: open the model in OpenSim 4 and save it again",
                   version));
  }
  model_.name = model.attribute("name").value();
  read_prototypes(model.child("defaults"));
  model_.gravity_G = vec3(model, "gravity", model_.gravity_G);
  read_bodies(model);
  read_joints(model);
  read_markers(model);
  read_wrap_objects(model.child("Ground"), "/ground");
  for (const auto node : objects(model.child("BodySet"))) {
    read_wrap_objects(node, std::string("/bodyset/") + node.attribute("name").value());
  }
  read_forces(model.child("ForceSet"));
  read_constraints(model);
  return finalize(std::move(model_));
}

}  // namespace

BodyModel parse_osim(std::string_view xml, const std::filesystem::path& path) {
  return Reader(xml, path).read();
}

BodyModel read_osim(const std::filesystem::path& path) {
  const std::string text = recording::read_text_file(path);
  return parse_osim(text, path);
}

}  // namespace myoid::model
