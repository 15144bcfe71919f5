#include <array>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/osim_parts.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

Quadrant read_quadrant(const OsimReading& r, pugi::xml_node node) {
  std::string text = lower_case(r.xml.word(node, "quadrant"));
  if (text.empty() || text == "all" || text == "unassigned") return 0;
  const bool negative = text.front() == '-';
  if (negative || text.front() == '+') text.erase(0, 1);
  if (text.size() != 1 || text[0] < 'x' || text[0] > 'z') {
    r.xml.fail(node, "<quadrant>: expected all, x, -x, y, -y, z or -z, found '{}'", r.xml.word(node, "quadrant"));
  }
  const int axis = text[0] - 'x' + 1;
  return negative ? -axis : axis;
}

void read_wraps_of(OsimReading& r, pugi::xml_node holder, const FixedFrame& frame) {
  for (const auto node : OsimXml::objects(holder.child("WrapObjectSet"))) {
    WrapObject wrap;
    wrap.name = OsimXml::name_of(node);
    wrap.body = frame.body;
    wrap.X_BW = frame.X_BF * pose_of(r, node, "translation", "xyz_body_rotation");
    wrap.active = r.xml.flag(node, "active", true);
    wrap.quadrant = read_quadrant(r, node);
    const std::string_view kind = node.name();
    if (kind == "WrapCylinder") {
      wrap.shape = CylinderShape{positive(r, node, "radius", 1.0), r.xml.number(node, "length", 1.0)};
    } else if (kind == "WrapSphere") {
      wrap.shape = SphereShape{positive(r, node, "radius", 1.0)};
    } else if (kind == "WrapTorus") {
      wrap.shape = TorusShape{positive(r, node, "inner_radius", 0.01), positive(r, node, "outer_radius", 0.05)};
    } else if (kind == "WrapEllipsoid") {
      const Vec3 radii = r.xml.vec3(node, "dimensions", Vec3::Constant(0.05));
      if (!(radii.minCoeff() > 0.0) || !radii.allFinite())
        r.xml.fail(node, "wrap object '{}': expected <dimensions> above 0", wrap.name);
      wrap.shape = EllipsoidShape{radii};
    } else {
      wrap.active = false;
      r.leave_out("wrap object '{}' of kind {}: paths run straight through it", wrap.name, kind);
    }
    r.model.wrap_objects.push_back(std::move(wrap));
  }
}

PathPoint::Moving read_moving(OsimReading& r, pugi::xml_node node) {
  PathPoint::Moving moving;
  int named = -1;
  std::array<bool, 3> has_function{};
  const char* axes[3] = {"x", "y", "z"};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto function = function_property(r, node, fmt::format("{}_location", axes[k]).c_str());
    if (!function) continue;
    moving.location[k] = *function;
    has_function[k] = true;
    const std::string target = socket(r, node, fmt::format("{}_coordinate", axes[k]));
    if (target.empty()) continue;
    moving.coordinates[k] = coordinate_named(r, node, target);
    named = moving.coordinates[k];
  }
  // A direction whose coordinate is not named follows that of the others.
  for (std::size_t k = 0; k < 3; ++k)
    if (moving.coordinates[k] < 0 && has_function[k]) moving.coordinates[k] = named;
  return moving;
}

PathPoint read_point(OsimReading& r, pugi::xml_node node, const std::string& owner) {
  PathPoint point;
  point.name = OsimXml::name_of(node);
  const FixedFrame frame = frame_of(r, node, "parent_frame", "/forceset/" + owner);
  point.body = frame.body;
  const std::string_view kind = node.name();
  if (kind == "MovingPathPoint") {
    point.moving = read_moving(r, node);
    point.moving->X_BF = frame.X_BF;
    return point;
  }
  point.p_BP = frame.X_BF * r.xml.vec3(node, "location", Vec3::Zero());
  if (!point.p_BP.allFinite()) r.xml.fail(node, "path point '{}': its location is not finite", point.name);
  if (kind == "ConditionalPathPoint") {
    PathPoint::Condition condition;
    condition.coordinate = coordinate_named(r, node, socket(r, node, "coordinate"));
    if (const auto range = r.xml.property(node, "range")) {
      const auto v = r.xml.numbers(range);
      if (v.size() != 2) r.xml.fail(range, "<range>: expected two numbers");
      condition.lower = v[0];
      condition.upper = v[1];
    }
    point.condition = condition;
  } else if (kind != "PathPoint") {
    r.leave_out("path of '{}': point '{}' of kind {} is taken as fixed", owner, point.name, kind);
  }
  return point;
}

PathWrap read_path_wrap(OsimReading& r, pugi::xml_node node, const std::string& owner) {
  const std::string name = r.xml.word(node, "wrap_object");
  PathWrap wrap;
  for (std::size_t w = 0; w < r.model.wrap_objects.size() && wrap.wrap_object < 0; ++w) {
    if (r.model.wrap_objects[w].name == name) wrap.wrap_object = static_cast<int>(w);
  }
  if (wrap.wrap_object < 0) r.xml.fail(node, "path of '{}': there is no wrap object '{}'", owner, name);
  const std::string method = r.xml.word(node, "method");
  using ground::equal_ignoring_case;
  if (equal_ignoring_case(method, "midpoint")) {
    wrap.method = WrapMethod::midpoint;
  } else if (equal_ignoring_case(method, "axial")) {
    wrap.method = WrapMethod::axial;
  } else if (!method.empty() && !equal_ignoring_case(method, "hybrid") && !equal_ignoring_case(method, "Unassigned")) {
    r.xml.fail(node, "<method>: expected hybrid, midpoint or axial, found '{}'", method);
  }
  if (const auto range = r.xml.property(node, "range")) {
    const auto v = r.xml.numbers(range);
    if (v.size() == 2) {
      wrap.range_start = static_cast<int>(v[0]);
      wrap.range_end = static_cast<int>(v[1]);
    } else if (!v.empty()) {
      r.xml.fail(range, "<range>: expected two numbers, found {}", v.size());
    }
  }
  return wrap;
}

/// Returns a path by functions; empty if one of them is no polynomial of all coordinates.
std::optional<FunctionPath> function_path(const OsimReading& r, pugi::xml_node node) {
  FunctionPath path;
  for (const std::string& name : r.xml.words(node, "coordinates"))
    path.coordinates.push_back(coordinate_named(r, node, name));
  const auto count = static_cast<int>(path.coordinates.size());
  auto length = multi_function(r, function_node(r, node, "length_function"), count);
  if (!length || count == 0) return std::nullopt;
  path.length = *std::move(length);
  const auto arms = r.xml.property(node, "moment_arm_functions");
  for (const auto element : (arms.child("objects") ? arms.child("objects") : arms).children()) {
    if (element.type() != pugi::node_element) continue;
    auto arm = multi_function(r, element, count);
    if (!arm) return std::nullopt;
    path.moment_arms.push_back(*std::move(arm));
  }
  if (!path.moment_arms.empty() && path.moment_arms.size() != path.coordinates.size()) {
    r.xml.fail(node, "<moment_arm_functions>: {} functions for {} coordinates", path.moment_arms.size(),
               path.coordinates.size());
  }
  return path;
}

}  // namespace

void read_wrap_objects(OsimReading& r, pugi::xml_node model) {
  read_wraps_of(r, model.child("Ground"), {});
  // A path refers to the first object of a name over the bodies in tree order.
  std::vector<pugi::xml_node> nodes(r.model.bodies.size());
  for (const auto& [node, path] : components_of(model, "BodySet", "Body")) {
    if (const auto body = r.find_body(OsimXml::name_of(node))) nodes[at(*body)] = node;
  }
  for (std::size_t b = 1; b < nodes.size(); ++b) {
    if (nodes[b]) read_wraps_of(r, nodes[b], {static_cast<BodyIndex>(b), {}});
  }
  for (const auto& [path, frame] : r.frames) {
    if (frame.node.child("WrapObjectSet")) read_wraps_of(r, frame.node, resolve_frame(r, frame.node, path, ""));
  }
}

std::string foreign_path(const OsimReading& r, pugi::xml_node node) {
  for (const auto holder : {node, node.child("path")}) {
    for (const auto child : holder.children()) {
      const std::string_view kind = child.name();
      if (!kind.ends_with("Path") || kind == "GeometryPath") continue;
      if (kind == "FunctionBasedPath" && function_path(r, child)) continue;
      return child.name();
    }
  }
  return {};
}

MusclePath read_path(OsimReading& r, pugi::xml_node node) {
  const std::string owner = OsimXml::name_of(node);
  for (const auto holder : {node, node.child("path")}) {
    if (const auto path = holder.child("FunctionBasedPath"))
      return {.points = {}, .wraps = {}, .function = function_path(r, path)};
  }
  pugi::xml_node geometry = node.child("GeometryPath");
  if (!geometry) geometry = OsimXml::first_element(node.child("path"));
  if (!geometry) r.xml.fail(node, "{} '{}' has no <GeometryPath>", node.name(), owner);
  MusclePath path;
  for (const auto point : OsimXml::objects(geometry.child("PathPointSet")))
    path.points.push_back(read_point(r, point, owner));
  for (const auto wrap : OsimXml::objects(geometry.child("PathWrapSet")))
    path.wraps.push_back(read_path_wrap(r, wrap, owner));
  if (path.points.size() < 2) {
    r.xml.fail(geometry, "{} '{}' has {} path points; at least two are needed", node.name(), owner, path.points.size());
  }
  return path;
}

}  // namespace myoid::body
