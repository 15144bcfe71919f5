#include "myoid/model/osim_muscles.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/core/error.h"
#include "myoid/model/osim_functions.h"
#include "myoid/recording/text_file.h"

namespace myoid::model {
namespace {

Quadrant read_quadrant(const OsimReading& r, pugi::xml_node node) {
  std::string text = r.xml.word(node, "quadrant");
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  if (text.empty() || text == "all" || text == "unassigned") return 0;
  const bool negative = text.front() == '-';
  if (negative || text.front() == '+') text.erase(0, 1);
  if (text.size() != 1 || text[0] < 'x' || text[0] > 'z') {
    r.xml.fail(node, fmt::format("<quadrant>: expected all, x, -x, y, -y, z or -z, found '{}'",
                                 r.xml.word(node, "quadrant")));
  }
  const int axis = text[0] - 'x' + 1;
  return negative ? -axis : axis;
}

double positive(const OsimReading& r, pugi::xml_node node, const char* name, double otherwise) {
  const double value = r.xml.number(node, name, otherwise);
  if (!(value > 0.0) || !std::isfinite(value)) {
    r.xml.fail(node, fmt::format("{} '{}': expected <{}> above 0, found {}", node.name(),
                                 OsimXml::name_of(node), name, value));
  }
  return value;
}

void read_wraps_of(OsimReading& r, pugi::xml_node holder, const FixedFrame& frame) {
  for (const auto node : OsimXml::objects(holder.child("WrapObjectSet"))) {
    if (node.type() != pugi::node_element) continue;
    WrapObject wrap;
    wrap.name = OsimXml::name_of(node);
    wrap.body = frame.body;
    wrap.X_BW = frame.X_BF * pose_of(r, node, "translation", "xyz_body_rotation");
    wrap.active = r.xml.flag(node, "active", true);
    wrap.quadrant = read_quadrant(r, node);
    const std::string_view kind = node.name();
    if (kind == "WrapCylinder") {
      wrap.shape =
          CylinderShape{positive(r, node, "radius", 1.0), r.xml.number(node, "length", 1.0)};
    } else if (kind == "WrapSphere") {
      wrap.shape = SphereShape{positive(r, node, "radius", 1.0)};
    } else if (kind == "WrapTorus") {
      wrap.shape = TorusShape{positive(r, node, "inner_radius", 0.01),
                              positive(r, node, "outer_radius", 0.05)};
    } else if (kind == "WrapEllipsoid") {
      const Vec3 radii = r.xml.vec3(node, "dimensions", Vec3::Constant(0.05));
      if (!(radii.minCoeff() > 0.0) || !radii.allFinite())
        r.xml.fail(node, fmt::format("wrap object '{}': expected <dimensions> above 0", wrap.name));
      wrap.shape = EllipsoidShape{radii};
    } else {
      wrap.active = false;
      r.model.unsupported.push_back(fmt::format(
          "wrap object '{}' of kind {}: paths run straight through it", wrap.name, kind));
    }
    r.model.wrap_objects.push_back(std::move(wrap));
  }
}

PathPoint::Moving read_moving(OsimReading& r, pugi::xml_node node) {
  PathPoint::Moving moving;
  const char* axes[3] = {"x", "y", "z"};
  const char* old_axes[3] = {"XAttachment", "YAttachment", "ZAttachment"};
  const char* old_coordinates[3] = {"XCoordinate", "YCoordinate", "ZCoordinate"};
  for (std::size_t k = 0; k < 3; ++k) {
    auto function = function_property(r, node, fmt::format("{}_location", axes[k]).c_str());
    if (!function) function = function_in(r, node.child(old_axes[k]));
    if (!function) continue;
    moving.location[k] = *function;
    const std::string name = fmt::format("{}_coordinate", axes[k]);
    std::string target = socket(r, node, name, name.c_str());
    if (target.empty()) target = r.xml.word(node, old_coordinates[k]);
    if (target.empty()) continue;
    const int coordinate = coordinate_named(r, node, target);
    if (moving.coordinate >= 0 && coordinate != moving.coordinate) {
      r.xml.fail(node,
                 fmt::format("moving point '{}' depends on two coordinates, '{}' and '{}'; "
                             "one is expected",
                             OsimXml::name_of(node),
                             r.model.coordinates[static_cast<std::size_t>(moving.coordinate)].name,
                             target));
    }
    moving.coordinate = coordinate;
  }
  return moving;
}

PathPoint read_point(OsimReading& r, pugi::xml_node node, const std::string& owner) {
  PathPoint point;
  point.name = OsimXml::name_of(node);
  const FixedFrame frame = frame_of(r, node, "parent_frame", "/forceset/" + owner);
  point.body = frame.body;
  const std::string_view kind = node.name();
  if (kind == "MovingPathPoint" || kind == "MovingMusclePoint") {
    point.moving = read_moving(r, node);
    point.moving->X_BF = frame.X_BF;
    return point;
  }
  const bool attachment = !r.xml.property(node, "location") && node.child("attachment");
  point.p_BP = frame.X_BF * r.xml.vec3(node, attachment ? "attachment" : "location", Vec3::Zero());
  if (!point.p_BP.allFinite())
    r.xml.fail(node, fmt::format("path point '{}': its location is not finite", point.name));
  if (kind == "ConditionalPathPoint" || kind == "MuscleViaPoint") {
    PathPoint::Condition condition;
    std::string target = socket(r, node, "coordinate", "coordinate");
    if (target.empty()) target = r.xml.word(node, "coordinates");
    condition.coordinate = coordinate_named(r, node, target);
    if (const auto range = r.xml.property(node, "range")) {
      const auto v = r.xml.numbers(range);
      if (v.size() != 2) r.xml.fail(range, "<range>: expected two numbers");
      condition.lower = v[0];
      condition.upper = v[1];
    }
    point.condition = condition;
  } else if (kind != "PathPoint" && kind != "MusclePoint") {
    r.model.unsupported.push_back(fmt::format(
        "path of '{}': point '{}' of kind {} is taken as fixed", owner, point.name, kind));
  }
  return point;
}

pugi::xml_node either(pugi::xml_node parent, const char* name, const char* old_name) {
  const auto child = parent.child(name);
  return child ? child : parent.child(old_name);
}

PathWrap read_path_wrap(OsimReading& r, pugi::xml_node node, const std::string& owner) {
  const std::string name = r.xml.word(node, "wrap_object");
  PathWrap wrap;
  for (std::size_t w = 0; w < r.model.wrap_objects.size() && wrap.wrap_object < 0; ++w) {
    if (r.model.wrap_objects[w].name == name) wrap.wrap_object = static_cast<int>(w);
  }
  if (wrap.wrap_object < 0)
    r.xml.fail(node, fmt::format("path of '{}': there is no wrap object '{}'", owner, name));
  const std::string method = r.xml.word(node, "method");
  using recording::equal_ignoring_case;
  if (equal_ignoring_case(method, "midpoint")) {
    wrap.method = WrapMethod::midpoint;
  } else if (equal_ignoring_case(method, "axial")) {
    wrap.method = WrapMethod::axial;
  } else if (!method.empty() && !equal_ignoring_case(method, "hybrid") &&
             !equal_ignoring_case(method, "Unassigned")) {
    r.xml.fail(node,
               fmt::format("<method>: expected hybrid, midpoint or axial, found '{}'", method));
  }
  if (const auto range = r.xml.property(node, "range")) {
    const auto v = r.xml.numbers(range);
    if (v.size() == 2) {
      wrap.range_start = static_cast<int>(v[0]);
      wrap.range_end = static_cast<int>(v[1]);
    } else if (!v.empty()) {
      r.xml.fail(range, fmt::format("<range>: expected two numbers, found {}", v.size()));
    }
  }
  return wrap;
}

MillardCurves millard_curves(const OsimReading& r, pugi::xml_node node) {
  MillardCurves c;
  const auto set = [&](pugi::xml_node curve, const char* name, double& value) {
    value = r.xml.number(curve, name, value);
  };
  const auto active = r.xml.property(node, "ActiveForceLengthCurve");
  set(active, "min_norm_active_fiber_length", c.active_min_length);
  set(active, "transition_norm_fiber_length", c.active_transition_length);
  set(active, "max_norm_active_fiber_length", c.active_max_length);
  set(active, "shallow_ascending_slope", c.active_shallow_slope);
  set(active, "minimum_value", c.active_minimum);
  const auto velocity = r.xml.property(node, "ForceVelocityCurve");
  set(velocity, "concentric_slope_at_vmax", c.concentric_slope_at_vmax);
  set(velocity, "concentric_slope_near_vmax", c.concentric_slope_near_vmax);
  set(velocity, "isometric_slope", c.isometric_slope);
  set(velocity, "eccentric_slope_at_vmax", c.eccentric_slope_at_vmax);
  set(velocity, "eccentric_slope_near_vmax", c.eccentric_slope_near_vmax);
  set(velocity, "max_eccentric_velocity_force_multiplier", c.eccentric_force);
  set(velocity, "concentric_curviness", c.concentric_curviness);
  set(velocity, "eccentric_curviness", c.eccentric_curviness);
  const auto fiber = r.xml.property(node, "FiberForceLengthCurve");
  set(fiber, "strain_at_zero_force", c.fiber_strain_at_zero_force);
  set(fiber, "strain_at_one_norm_force", c.fiber_strain_at_one_force);
  set(fiber, "stiffness_at_low_force", c.fiber_stiffness_at_low_force);
  set(fiber, "stiffness_at_one_norm_force", c.fiber_stiffness_at_one_force);
  set(fiber, "curviness", c.fiber_curviness);
  const auto tendon = r.xml.property(node, "TendonForceLengthCurve");
  set(tendon, "strain_at_one_norm_force", c.tendon_strain_at_one_force);
  set(tendon, "stiffness_at_one_norm_force", c.tendon_stiffness_at_one_force);
  set(tendon, "norm_force_at_toe_end", c.tendon_force_at_toe_end);
  set(tendon, "curviness", c.tendon_curviness);
  c.fiber_damping = r.xml.number(node, "fiber_damping", 0.1);
  c.ignore_tendon_compliance = r.xml.flag(node, "ignore_tendon_compliance", false);
  c.ignore_activation_dynamics = r.xml.flag(node, "ignore_activation_dynamics", false);
  return c;
}

SchutteCurves schutte_curves(OsimReading& r, pugi::xml_node node) {
  SchutteCurves c;
  c.time_scale_s = r.xml.number(node, "time_scale", 0.1);
  c.activation1 = r.xml.number(node, "activation1", 7.667);
  c.activation2 = r.xml.number(node, "activation2", 1.459854);
  c.damping = r.xml.number(node, "damping", 0.05);
  const auto curve = [&](const char* name) { return function_property(r, node, name); };
  c.active_force_length = curve("active_force_length_curve");
  c.passive_force_length = curve("passive_force_length_curve");
  c.tendon_force_length = curve("tendon_force_length_curve");
  c.force_velocity = curve("force_velocity_curve");
  return c;
}

DeGrooteCurves de_groote_curves(const OsimReading& r, pugi::xml_node node) {
  DeGrooteCurves c;
  c.active_width_scale = r.xml.number(node, "active_force_width_scale", 1.0);
  c.fiber_damping = r.xml.number(node, "fiber_damping", 0.0);
  c.passive_fiber_strain_at_one_force =
      r.xml.number(node, "passive_fiber_strain_at_one_norm_force", 0.6);
  c.tendon_strain_at_one_force = r.xml.number(node, "tendon_strain_at_one_norm_force", 0.049);
  c.ignore_passive_fiber_force = r.xml.flag(node, "ignore_passive_fiber_force", false);
  c.ignore_tendon_compliance = r.xml.flag(node, "ignore_tendon_compliance", false);
  c.ignore_activation_dynamics = r.xml.flag(node, "ignore_activation_dynamics", false);
  c.tendon_dynamics_implicit = r.xml.word(node, "tendon_compliance_dynamics_mode") == "implicit";
  return c;
}

}  // namespace

void read_wrap_objects(OsimReading& r, pugi::xml_node model) {
  read_wraps_of(r, model.child("Ground"), {});
  // A path finds the first object of a name over the bodies in tree order.
  std::vector<pugi::xml_node> nodes(r.model.bodies.size());
  for (const auto node : OsimXml::objects(model.child("BodySet"))) {
    if (const auto body = r.model.find_body(OsimXml::name_of(node)))
      nodes[static_cast<std::size_t>(*body)] = node;
  }
  if (nodes[0]) read_wraps_of(r, nodes[0], {});
  for (std::size_t b = 1; b < nodes.size(); ++b) {
    if (nodes[b]) read_wraps_of(r, nodes[b], {static_cast<BodyIndex>(b), {}});
  }
  for (const auto& [path, frame] : r.frames) {
    if (frame.node.child("WrapObjectSet"))
      read_wraps_of(r, frame.node, resolve_frame(r, frame.node, path, ""));
  }
}

std::string foreign_path(pugi::xml_node node) {
  for (const auto holder : {node, node.child("path")}) {
    for (const auto child : holder.children()) {
      const std::string_view kind = child.name();
      if (kind.ends_with("Path") && kind != "GeometryPath") return child.name();
    }
  }
  return {};
}

MusclePath read_path(OsimReading& r, pugi::xml_node node) {
  const std::string owner = OsimXml::name_of(node);
  pugi::xml_node geometry = node.child("GeometryPath");
  if (!geometry) geometry = OsimXml::first_element(node.child("path"));
  if (!geometry && (node.child("MusclePointSet") || node.child("PathPointSet"))) geometry = node;
  if (!geometry) r.xml.fail(node, fmt::format("{} '{}' has no <GeometryPath>", node.name(), owner));
  MusclePath path;
  for (const auto point : OsimXml::objects(either(geometry, "PathPointSet", "MusclePointSet"))) {
    if (point.type() == pugi::node_element) path.points.push_back(read_point(r, point, owner));
  }
  for (const auto wrap : OsimXml::objects(either(geometry, "PathWrapSet", "MuscleWrapSet"))) {
    if (wrap.type() == pugi::node_element) path.wraps.push_back(read_path_wrap(r, wrap, owner));
  }
  if (path.points.size() < 2) {
    r.xml.fail(geometry, fmt::format("{} '{}' has {} path points; at least two are needed",
                                     node.name(), owner, path.points.size()));
  }
  return path;
}

void note_classes(BodyModel& model) {
  std::map<std::string, std::vector<std::string>> by_class;
  for (const Muscle& muscle : model.muscles)
    if (!muscle.class_name.starts_with("Thelen2003Muscle"))
      by_class[muscle.class_name].push_back(muscle.name);
  for (const auto& [name, muscles] : by_class) {
    const bool own = name.starts_with("Millard2012") || name.starts_with("DeGrooteFregly2016");
    model.notes.push_back(fmt::format(
        "{} {} of class {}: {}; identification starts from the numbers that the class shares with "
        "Thelen's ({})",
        muscles.size(), muscles.size() == 1 ? "muscle is" : "muscles are", name,
        own ? "so, run-tool and simulate use the class's own curves"
            : "so, run-tool and simulate take Thelen's curves with their numbers",
        fmt::join(muscles, ", ")));
  }
}

bool is_muscle(pugi::xml_node node) {
  return std::string_view(node.name()).find("Muscle") != std::string_view::npos;
}

Muscle read_muscle(OsimReading& r, pugi::xml_node node) {
  Muscle muscle;
  muscle.name = OsimXml::name_of(node);
  muscle.class_name = node.name();
  if (muscle.name.empty()) r.xml.fail(node, "a muscle has no name");
  if (r.model.find_muscle(muscle.name))
    r.xml.fail(node, fmt::format("two muscles are named '{}'", muscle.name));
  muscle.applies_force = is_enabled(r, node, "appliesForce");
  const bool thelen = muscle.class_name.starts_with("Thelen2003Muscle");
  const bool de_groote = muscle.class_name.starts_with("DeGrooteFregly2016");
  const bool millard = muscle.class_name.starts_with("Millard2012");
  const bool schutte =
      muscle.class_name.starts_with("Schutte1993") || muscle.class_name.starts_with("Delp1990");
  MuscleProperties& p = muscle.properties;
  const auto set = [&](const char* name, double& value) {
    value = r.xml.number(node, name, value);
    if (!std::isfinite(value) && std::string_view(name) != "min_control" &&
        std::string_view(name) != "max_control")
      r.xml.fail(node, fmt::format("muscle '{}': <{}> is not finite", muscle.name, name));
  };
  if (!thelen) {
    p.activation_time_s = de_groote ? 0.015 : 0.01;
    p.deactivation_time_s = de_groote ? 0.06 : 0.04;
  }
  if (!thelen && !millard) p.min_control = 0.0;
  const double class_min_control = p.min_control;
  set("max_isometric_force", p.max_isometric_force_n);
  p.optimal_fiber_length_m = positive(r, node, "optimal_fiber_length", p.optimal_fiber_length_m);
  set("tendon_slack_length", p.tendon_slack_length_m);
  set("pennation_angle_at_optimal", p.pennation_at_optimal_rad);
  if (!r.xml.property(node, "pennation_angle_at_optimal"))
    set("pennation_angle", p.pennation_at_optimal_rad);
  set("max_contraction_velocity", p.max_contraction_velocity);
  set("KshapeActive", p.active_shape);
  set("KshapePassive", p.passive_shape);
  set("FmaxTendonStrain", p.max_tendon_strain);
  set("FmaxMuscleStrain", p.max_muscle_strain);
  set("Af", p.concentric_shape);
  set("Flen", p.eccentric_plateau);
  set("fv_linear_extrap_threshold", p.force_velocity_extrapolation);
  set("maximum_pennation_angle", p.max_pennation_rad);
  set("activation_time_constant", p.activation_time_s);
  set("deactivation_time_constant", p.deactivation_time_s);
  set("minimum_activation", p.minimum_activation);
  set("default_activation", p.default_activation);
  p.default_fiber_length_m = p.optimal_fiber_length_m;
  set("default_fiber_length", p.default_fiber_length_m);
  set("min_control", p.min_control);
  set("max_control", p.max_control);
  if (r.xml.version() < 30513 && p.min_control == 0.0) p.min_control = class_min_control;
  if (millard) {
    p.curves = millard_curves(r, node);
  } else if (schutte) {
    p.curves = schutte_curves(r, node);
  } else if (de_groote) {
    p.curves = de_groote_curves(r, node);
  }
  muscle.path = read_path(r, node);
  return muscle;
}

}  // namespace myoid::model
