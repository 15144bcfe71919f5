#include "myoid/body/osim/osim_update_parts.h"

#include <algorithm>
#include <array>
#include <utility>

#include "myoid/body/osim/osim_xml.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

using Renaming = std::pair<std::string_view, const char*>;

/// Renamed classes and sets, wherever they stand.
constexpr Renaming kClasses[] = {
    {"NaturalCubicSpline", "SimmSpline"},
    {"natCubicSpline", "SimmSpline"},
    {"natCubicSplineFunction", "SimmSpline"},
    {"MusclePoint", "PathPoint"},
    {"MuscleViaPoint", "ConditionalPathPoint"},
    {"MovingMusclePoint", "MovingPathPoint"},
    {"MusclePointSet", "PathPointSet"},
    {"MuscleWrapSet", "PathWrapSet"},
    {"MuscleWrap", "PathWrap"},
    {"GeneralizedForce", "CoordinateActuator"},
    {"Force", "PointActuator"},
    {"Torque", "TorqueActuator"},
    {"Schutte1993Muscle", "Schutte1993Muscle_Deprecated"},
    {"Delp1990Muscle", "Delp1990Muscle_Deprecated"},
    {"ActuatorSet", "ForceSet"},
    {"IKTool", "InverseKinematicsTool"},
    {"actuator_set_files", "force_set_files"},
    {"replace_actuator_set", "replace_force_set"},
    {"use_model_actuator_set", "use_model_force_set"},
};

bool ends_with_any(std::string_view text, std::initializer_list<std::string_view> ends) {
  return std::any_of(ends.begin(), ends.end(), [&](auto end) { return text.ends_with(end); });
}

bool is_path_point(std::string_view kind) {
  return kind == "PathPoint" || kind == "ConditionalPathPoint" || kind == "MovingPathPoint";
}

/// Replaces <isDisabled> by the newer switch, its negation.
void update_switch(pugi::xml_node object) {
  const auto old = object.child("isDisabled");
  if (!old) return;
  const std::string_view kind = object.name();
  const char* name = kind.ends_with("Constraint")                   ? "isEnforced"
                     : ends_with_any(kind, {"Controller", "Probe"}) ? "enabled"
                                                                    : "appliesForce";
  if (object.child(name)) {
    object.remove_child(old);
    return;
  }
  // A text that is no flag stays, so that the reader refuses it.
  const std::string text = child_text(object, "isDisabled");
  const bool off = is_true(text), on = equal_ignoring_case(text, "false") || text == "0";
  auto renamed = old;
  renamed.set_name(name);
  if (off || on) renamed.text().set(off ? "false" : "true");
}

/// Turns <connectors> of 4.0's betas and <socket_x_connectee_name> into <socket_x>.
void update_sockets(pugi::xml_node object) {
  if (const auto connectors = object.child("connectors")) {
    for (const auto connector : connectors.children()) {
      const std::string name = "socket_" + OsimXml::name_of(connector);
      if (connector.child("connectee_name") && !object.child(name.c_str()))
        append_text(object, name.c_str(), child_text(connector, "connectee_name"));
    }
    object.remove_child(connectors);
  }
  constexpr std::string_view kEnd = "_connectee_name";
  for (auto child : object.children()) {
    std::string name = child.name();
    if (!name.starts_with("socket_") || !name.ends_with(kEnd)) continue;
    name.resize(name.size() - kEnd.size());
    child.set_name(name.c_str());
  }
}

/// Turns a property with a body's name, or a beta's socket of that name, into a socket with the body's path.
void body_to_socket(pugi::xml_node object, const char* property, const char* socket) {
  rename_child(object, (std::string("socket_") + property).c_str(), socket);
  auto old = object.child(property);
  if (!old) return;
  const std::string name = OsimXml::text_of(old);
  if (object.child(socket) || name.empty()) {
    object.remove_child(old);
    return;
  }
  old.set_name(socket);
  old.text().set(body_path(name).c_str());
}

void update_path_point(pugi::xml_node point) {
  body_to_socket(point, "body", "socket_parent_frame");
  rename_child(point, "attachment", "location");
  if (std::string_view(point.name()) == "ConditionalPathPoint") {
    rename_child(point, "coordinates", "socket_coordinate");
    rename_child(point, "coordinate", "socket_coordinate");
  } else if (std::string_view(point.name()) == "MovingPathPoint") {
    constexpr std::array<std::array<const char*, 4>, 3> kAxes{
        {{"XAttachment", "x_location", "XCoordinate", "x_coordinate"},
         {"YAttachment", "y_location", "YCoordinate", "y_coordinate"},
         {"ZAttachment", "z_location", "ZCoordinate", "z_coordinate"}}};
    for (const auto& axis : kAxes) {
      rename_child(point, axis[0], axis[1]);
      rename_child(point, axis[2], axis[3]);
      rename_child(point, axis[3], (std::string("socket_") + axis[3]).c_str());
    }
  }
}

/// Turns two bodies, each with a place and a rotation, into two frames of the object.
void bodies_to_frames(pugi::xml_node object) {
  if (!object.child("body_1") && !object.child("body_2")) return;
  const auto frames = child_or_new(object, "frames");
  for (const std::string k : {"1", "2"}) {
    const std::string body = child_text(object, ("body_" + k).c_str());
    object.remove_child(("body_" + k).c_str());
    if (body.empty()) continue;
    const std::string name = body.substr(body.find_last_of('/') + 1) + "_offset_" + k;
    const auto frame = append_frame(frames, name, body_path(body), {}, {});
    move_value(object.child(("location_body_" + k).c_str()), frame, "translation");
    move_value(object.child(("orientation_body_" + k).c_str()), frame, "orientation");
    append_text(object, ("socket_frame" + k).c_str(), name);
  }
}

void update_constraint(pugi::xml_node object) {
  const std::string_view kind = object.name();
  if (kind == "WeldConstraint") {
    bodies_to_frames(object);
  } else if (kind == "PointConstraint" || kind == "ConstantDistanceConstraint") {
    body_to_socket(object, "body_1", "socket_body_1");
    body_to_socket(object, "body_2", "socket_body_2");
  } else if (kind == "PointOnLineConstraint") {
    body_to_socket(object, "line_body", "socket_line_body");
    body_to_socket(object, "follower_body", "socket_follower_body");
  }
}

/// Updates muscles of documents before 10900, which hold their points themselves.
void update_path_holder(pugi::xml_node force) {
  rename_child(force, "MusclePointSet", "PathPointSet");
  rename_child(force, "MuscleWrapSet", "PathWrapSet");
  if (!force.child("GeometryPath") && force.child("PathPointSet")) {
    auto path = force.append_child("GeometryPath");
    for (const char* set : {"PathPointSet", "PathWrapSet"})
      if (const auto child = force.child(set)) path.append_move(child);
  }
  if (const auto path = force.child("GeometryPath")) set_attribute(path, "name", "path");
}

void update_force(pugi::xml_node object, int version) {
  const std::string_view kind = object.name();
  update_path_holder(object);
  if (kind.find("Muscle") != std::string_view::npos) {
    rename_child(object, "pennation_angle", "pennation_angle_at_optimal");
    // A bound of 0 meant no bound: the class's default holds.
    while (version < 30513 && parse_number(child_text(object, "min_control")) == 0.0)
      object.remove_child("min_control");
  } else if (kind == "TorqueActuator") {
    rename_child(object, "body_A", "bodyA");
    rename_child(object, "body_B", "bodyB");
  } else if (kind.ends_with("BushingForce")) {
    bodies_to_frames(object);
  } else if (kind == "PointToPointSpring" || kind == "ExpressionBasedPointToPointForce") {
    body_to_socket(object, "body1", "socket_body1");
    body_to_socket(object, "body2", "socket_body2");
  } else if (kind == "PrescribedForce") {
    body_to_socket(object, "body", "socket_frame");
  }
}

void update_object(pugi::xml_node object, int version) {
  const std::string_view old_kind = object.name();
  const auto* renamed = std::ranges::find(kClasses, old_kind, &Renaming::first);
  if (renamed != std::end(kClasses)) object.set_name(renamed->second);
  const std::string_view kind = object.name();
  update_switch(object);
  update_sockets(object);
  if (is_path_point(kind)) {
    update_path_point(object);
  } else if (kind == "Marker") {
    body_to_socket(object, "body", "socket_parent_frame");
  } else if (kind == "Coordinate") {
    rename_child(object, "initial_value", "default_value");
    for (const char* gone : {"initial_value", "motion_type"})
      if (version < 40000) object.remove_child(gone);
  } else if (kind == "TransformAxis") {
    rename_child(object, "coordinate", "coordinates");
  } else if (kind.starts_with("Contact") && object.child("body_name")) {
    body_to_socket(object, "body_name", "socket_frame");
  } else if (kind.ends_with("Constraint")) {
    update_constraint(object);
  } else if (ends_with_any(kind, {"Force", "Actuator", "Spring", "Ligament"}) ||
             kind.find("Muscle") != std::string_view::npos) {
    update_force(object, version);
  }
}

}  // namespace

void rename_child(pugi::xml_node object, const char* old_name, const char* new_name) {
  if (auto child = object.child(old_name); child && !object.child(new_name)) child.set_name(new_name);
}

bool is_true(std::string_view text) { return equal_ignoring_case(text, "true") || text == "1"; }

std::string body_path(std::string_view name) {
  const std::string text(trim(name));
  if (text.starts_with('/')) return text;
  return text == "ground" ? "/ground" : "/bodyset/" + text;
}

pugi::xml_node append_text(pugi::xml_node parent, const char* name, const std::string& text) {
  auto child = parent.append_child(name);
  child.text().set(text.c_str());
  return child;
}

std::string child_text(pugi::xml_node parent, const char* name) { return OsimXml::text_of(parent.child(name)); }

pugi::xml_node append_frame(pugi::xml_node parent,
                            const std::string& name,
                            const std::string& body,
                            const std::string& translation,
                            const std::string& orientation) {
  auto frame = parent.append_child("PhysicalOffsetFrame");
  set_attribute(frame, "name", name);
  append_text(frame, "socket_parent", body);
  append_text(frame, "translation", translation.empty() ? "0 0 0" : translation);
  append_text(frame, "orientation", orientation.empty() ? "0 0 0" : orientation);
  return frame;
}

void move_value(pugi::xml_node value, pugi::xml_node object, const char* new_name) {
  if (!value) return;
  object.remove_child(new_name);
  auto moved = object.append_move(value);
  moved.set_name(new_name);
  moved.text().set(OsimXml::text_of(moved).c_str());
}

void update_parts(pugi::xml_node document, const std::function<int(pugi::xml_node)>& version) {
  for_each_element(document, [&](pugi::xml_node node) {
    if (node.type() == pugi::node_element) update_object(node, version(node));
  });
}

}  // namespace myoid::body
