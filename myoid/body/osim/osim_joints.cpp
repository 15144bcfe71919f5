#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/osim_parts.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

constexpr const char* kSlots[6] = {"rotation1",    "rotation2",    "rotation3",
                                   "translation1", "translation2", "translation3"};

/// Returns the coordinate elements of a joint.
auto coordinates_of(pugi::xml_node joint) { return joint.child("coordinates").children("Coordinate"); }

/// Returns a coordinate's name in the model, with its joint's name if several joints have a coordinate of that name.
std::string model_name(const OsimReading& r, const std::string& joint, const std::string& name) {
  return r.shared_coordinate_names.contains(name) ? fmt::format("{}_{}", joint, name) : name;
}

void read_coordinate(OsimReading& r, pugi::xml_node node, const std::string& joint) {
  const OsimXml& xml = r.xml;
  Coordinate c;
  c.name = model_name(r, joint, OsimXml::name_of(node));
  if (c.name.empty()) xml.fail(node, "a coordinate has no name");
  if (r.find_coordinate(c.name)) xml.fail(node, "two coordinates are named '{}'", c.name);
  c.default_value = xml.number(node, "default_value", 0.0);
  c.default_speed = xml.number(node, "default_speed_value", 0.0);
  if (!std::isfinite(c.default_value)) xml.fail(node, "coordinate '{}': the default value is not finite", c.name);
  if (const auto range = xml.property(node, "range")) {
    const auto v = xml.numbers(range);
    if (v.size() != 2) xml.fail(range, "<range>: expected two numbers, found {}", v.size());
    c.lower = std::min(v[0], v[1]);
    c.upper = std::max(v[0], v[1]);
  }
  c.clamped = xml.flag(node, "clamped", false);
  c.locked = xml.flag(node, "locked", false);
  c.is_free_to_satisfy_constraints = xml.flag(node, "is_free_to_satisfy_constraints", false);
  if (xml.flag(node, "prescribed", false)) c.prescribed = function_property(r, node, "prescribed_function");
  r.add(std::move(c));
}

pugi::xml_node transform_axis(const OsimReading& r, pugi::xml_node node, std::size_t slot) {
  for (const auto axis : r.xml.property(node, "SpatialTransform").children())
    if (OsimXml::name_of(axis) == kSlots[slot]) return axis;
  return {};
}

/// Returns the coordinate of a joint that an axis names; -1 if the axis names none.
int coordinate_of_axis(const OsimReading& r, pugi::xml_node slot, const Joint& joint) {
  const auto names = r.xml.words(slot, "coordinates");
  if (names.empty()) return -1;
  if (names.size() > 1) {
    r.xml.fail(slot, "<coordinates>: an axis of joint '{}' depends on {} coordinates; only one is supported",
               joint.name, names.size());
  }
  // Some files give the path of the coordinate.
  const std::string own = names[0].substr(names[0].find_last_of('/') + 1);
  const auto index = r.find_coordinate(model_name(r, joint.name, own));
  if (!index || std::find(joint.coordinates.begin(), joint.coordinates.end(), *index) == joint.coordinates.end()) {
    r.xml.fail(slot, "<coordinates>: joint '{}' has no coordinate '{}'", joint.name, names[0]);
  }
  return *index;
}

/// Reads an axis of a CustomJoint.
void read_axis(OsimReading& r, pugi::xml_node slot, const Joint& joint, TransformAxis& axis) {
  axis.axis = r.xml.vec3(slot, "axis", axis.axis);
  if (!(axis.axis.norm() > 0.0) || !axis.axis.allFinite()) r.xml.fail(slot, "<axis>: the direction is zero");
  axis.axis.normalize();
  axis.coordinate = coordinate_of_axis(r, slot, joint);
  pugi::xml_node function = OsimXml::first_element(slot, {"coordinates", "axis", "VisibleObject"});
  if (function && std::string_view(function.name()) == "function") function = OsimXml::first_element(function);
  if (function) {
    axis.function = read_function(r, function);
  } else if (axis.coordinate >= 0) {
    axis.function = Linear{1.0, 0.0};
  }
}

/// Gives the coordinates of a joint a new order: `order` holds their indices in the model.
void reorder_coordinates(OsimReading& r, Joint& joint, const std::vector<int>& order) {
  std::vector<Coordinate> sorted;
  std::map<int, int> moved;
  for (std::size_t k = 0; k < order.size(); ++k) {
    sorted.push_back(r.model.coordinates[at(order[k])]);
    moved[order[k]] = joint.coordinates[k];
  }
  for (std::size_t k = 0; k < order.size(); ++k) {
    r.coordinate_places[sorted[k].name] = joint.coordinates[k];
    r.model.coordinates[at(joint.coordinates[k])] = sorted[k];
  }
  for (auto* axes : {&joint.rotation, &joint.translation}) {
    for (TransformAxis& axis : *axes) {
      if (axis.coordinate >= 0) axis.coordinate = moved.at(axis.coordinate);
    }
  }
}

/// Reads the six axes; orders the joint's coordinates by their first use, as OpenSim does.
void set_custom_axes(OsimReading& r, pugi::xml_node node, Joint& joint) {
  std::vector<int> order;
  const auto append = [&](int coordinate) {
    if (std::find(order.begin(), order.end(), coordinate) == order.end()) order.push_back(coordinate);
  };
  for (std::size_t k = 0; k < 6; ++k) {
    TransformAxis& axis = k < 3 ? joint.rotation[k] : joint.translation[k - 3];
    axis.axis = Vec3::Unit(static_cast<Eigen::Index>(k % 3));
    const auto slot = transform_axis(r, node, k);
    if (!slot) continue;
    read_axis(r, slot, joint, axis);
    if (axis.coordinate >= 0) append(axis.coordinate);
  }
  for (const int index : joint.coordinates) append(index);
  reorder_coordinates(r, joint, order);
  const Mat3 axes = (Mat3() << joint.rotation[0].axis, joint.rotation[1].axis, joint.rotation[2].axis).finished();
  if (axes.col(0).cross(axes.col(1)).norm() < 1e-5 || axes.col(1).cross(axes.col(2)).norm() < 1e-5) {
    r.xml.fail(node, "joint '{}': two successive axes of rotation are parallel", joint.name);
  }
}

void need_coordinates(const OsimReading& r, pugi::xml_node node, const Joint& joint, std::size_t count) {
  if (joint.coordinates.size() == count) return;
  r.xml.fail(node, "joint '{}' ({}): expected {} coordinates, found {}", joint.name, joint.class_name, count,
             joint.coordinates.size());
}

/// Reads the length of a ConstantCurvatureJoint; returns its neutral angles about x, z, y [rad].
Vec3 read_rod(OsimReading& r, pugi::xml_node node, Joint& joint) {
  const Vec3 neutral_rad = r.xml.vec3(node, "neutral_angle_x_z_y", Vec3::Zero());
  joint.rod_length_m = r.xml.number(node, "length", 1.0);
  if (!std::isfinite(*joint.rod_length_m) || !neutral_rad.allFinite())
    r.xml.fail(node, "joint '{}': length or neutral angle is not finite", joint.name);
  for (const int c : joint.coordinates) r.model.coordinates[at(c)].clamped = true;
  r.note(
      "joint '{}' (ConstantCurvatureJoint): its speeds are the rates of its coordinates and move its end along the "
      "arc; OpenSim gives its velocities in the axes of the child and leaves a part of its accelerations out, so that "
      "moment arms, inverse dynamics and static optimization differ there",
      joint.name);
  return neutral_rad;
}

/// The axes of the coordinates of a joint class, in their order: those of the rotations, then those of the
/// translations.
struct ClassAxes {
  std::string_view class_name, rotations, translations;
};
constexpr ClassAxes kClassAxes[] = {{"WeldJoint", "", ""},         {"PinJoint", "z", ""},
                                    {"SliderJoint", "", "x"},      {"UniversalJoint", "xy", ""},
                                    {"PlanarJoint", "z", "xy"},    {"BallJoint", "xyz", ""},
                                    {"GimbalJoint", "xyz", ""},    {"FreeJoint", "xyz", "xyz"},
                                    {"EllipsoidJoint", "xyz", ""}, {"ConstantCurvatureJoint", "xzy", ""}};

/// Lets the coordinates of a joint, in their order, drive its rotations and translations about and along these axes;
/// the other axes rest.
void drive_axes(Joint& joint, std::string_view rotations, std::string_view translations) {
  for (std::size_t k = 0; k < 3; ++k)
    joint.rotation[k].axis = joint.translation[k].axis = Vec3::Unit(static_cast<Eigen::Index>(k));
  auto coordinate = joint.coordinates.begin();
  for (std::size_t k = 0; k < rotations.size(); ++k)
    joint.rotation[k] = {Vec3::Unit(rotations[k] - 'x'), *coordinate++, Linear{1.0, 0.0}};
  for (std::size_t k = 0; k < translations.size(); ++k)
    joint.translation[k] = {Vec3::Unit(translations[k] - 'x'), *coordinate++, Linear{1.0, 0.0}};
}

/// Gives a joint its axes; false if the class is not known.
bool set_axes(OsimReading& r, pugi::xml_node node, Joint& joint) {
  drive_axes(joint, "", "");
  const std::string_view kind = joint.class_name;
  if (kind == "CustomJoint") {
    set_custom_axes(r, node, joint);
    return true;
  }
  const auto* known = std::ranges::find(kClassAxes, kind, &ClassAxes::class_name);
  if (known == std::end(kClassAxes)) return false;
  need_coordinates(r, node, joint, known->rotations.size() + known->translations.size());
  drive_axes(joint, known->rotations, known->translations);
  if (known->rotations == "z") joint.rotation[2].axis = Vec3::UnitX();  // all three axes differ
  if (kind == "EllipsoidJoint") joint.ellipsoid_radii_m = r.xml.vec3(node, "radii_x_y_z", Vec3::Ones());
  if (kind == "ConstantCurvatureJoint") {
    const Vec3 neutral_rad = read_rod(r, node, joint);
    for (std::size_t k = 0; k < 3; ++k)
      joint.rotation[k].function = Linear{1.0, neutral_rad[static_cast<Eigen::Index>(k)]};
  }
  if (kind == "BallJoint" || kind == "FreeJoint" || kind == "EllipsoidJoint") {
    r.note(
        "joint '{}' ({}): its speeds are the rates of its coordinates; OpenSim's tools take them for angular "
        "velocities, which --compat opensim reproduces",
        joint.name, kind);
  }
  return true;
}

void set_motion_types(OsimReading& r, const Joint& joint) {
  for (const int index : joint.coordinates) {
    MotionType type = MotionType::coupled;
    for (const TransformAxis& axis : joint.translation) {
      if (axis.coordinate == index) type = MotionType::translational;
    }
    for (const TransformAxis& axis : joint.rotation) {
      if (axis.coordinate != index) continue;
      const auto* line = std::get_if<Linear>(&axis.function.form);
      if (line != nullptr && std::abs(std::abs(line->slope * axis.function.scale) - 1.0) < 1e-12)
        type = MotionType::rotational;
    }
    r.model.coordinates[at(index)].motion = type;
  }
}

/// Adds ellipsoid joint, massless body, hinge: the two joints of a ScapulothoracicJoint.
void add_scapulothoracic(OsimReading& r, pugi::xml_node node, Joint joint) {
  need_coordinates(r, node, joint, 4);
  const Vec3 radii = r.xml.vec3(node, "thoracic_ellipsoid_radii_x_y_z", Vec3::Ones());
  const auto origin_node = r.xml.property(node, "scapula_winging_axis_origin");
  const auto origin = origin_node ? r.xml.numbers(origin_node) : std::vector<double>{0.0, 0.0};
  if (origin.size() != 2) r.xml.fail(node, "<scapula_winging_axis_origin>: expected two numbers");
  const double winging_rad = r.xml.number(node, "scapula_winging_axis_direction", 0.0);
  const Mat3 quarter = Eigen::AngleAxisd(0.5 * kPi, Vec3::UnitZ()).toRotationMatrix();

  Joint ellipsoid = joint;
  ellipsoid.name = joint.name + "_ellipsoid";
  ellipsoid.child = r.add(Body{.name = joint.name + "_winging_base"});
  ellipsoid.X_PF = joint.X_PF * Pose{quarter, Vec3::Zero()};
  ellipsoid.X_BM = Pose{quarter, Vec3::Zero()};
  ellipsoid.coordinates.resize(3);
  ellipsoid.ellipsoid_radii_m = Vec3(radii.y(), radii.x(), radii.z());
  drive_axes(ellipsoid, "xyz", "");
  Joint hinge = joint;
  const Vec3 axis(-std::sin(winging_rad), std::cos(winging_rad), 0.0);
  const Pose at_axis{Mat3::Identity(), {origin[0], origin[1], 0.0}};
  hinge.parent = ellipsoid.child;
  hinge.X_PF = at_axis;
  hinge.X_BM = joint.X_BM * at_axis;
  hinge.coordinates = {joint.coordinates[3]};
  drive_axes(hinge, "x", "");
  hinge.rotation[0].axis = axis;
  hinge.rotation[1].axis = Vec3::UnitZ();
  hinge.rotation[2].axis = axis.cross(Vec3::UnitZ());
  for (const int c : joint.coordinates) r.model.coordinates[at(c)].motion = MotionType::rotational;
  r.note(
      "joint '{}' (ScapulothoracicJoint) is an ellipsoid joint and a hinge with the massless body '{}_winging_base' "
      "between; its speeds are the rates of its coordinates; OpenSim's tools take them for angular velocities, which "
      "--compat opensim reproduces",
      joint.name, joint.name);
  r.model.joints.push_back(std::move(ellipsoid));
  r.model.joints.push_back(std::move(hinge));
}

/// Reads one joint.
void read_joint(OsimReading& r, pugi::xml_node node, const std::string& path) {
  Joint joint;
  joint.name = OsimXml::name_of(node);
  joint.class_name = node.name();
  const FixedFrame parent = frame_of(r, node, "parent_frame", path);
  const FixedFrame child = frame_of(r, node, "child_frame", path);
  joint.parent = parent.body;
  joint.X_PF = parent.X_BF;
  joint.child = child.body;
  joint.X_BM = child.X_BF;
  if (joint.parent == joint.child) {
    r.xml.fail(node, "joint '{}' connects body '{}' with itself", joint.name, r.model.bodies[at(joint.parent)].name);
  }
  for (const auto element : coordinates_of(node)) {
    joint.coordinates.push_back(static_cast<int>(r.model.coordinates.size()));
    read_coordinate(r, element, joint.name);
  }
  if (joint.class_name == "ScapulothoracicJoint") {
    add_scapulothoracic(r, node, std::move(joint));
    return;
  }
  if (!set_axes(r, node, joint)) {
    r.leave_out("joint '{}' of kind {} is held at its default position; body '{}' and what hangs on it are misplaced",
                joint.name, joint.class_name, r.model.bodies[at(joint.child)].name);
  }
  set_motion_types(r, joint);
  r.model.joints.push_back(std::move(joint));
}

/// Finds the names that coordinates of several joints share; OpenSim distinguishes these coordinates by their paths.
void find_shared_names(OsimReading& r, pugi::xml_node model) {
  std::map<std::string, std::vector<std::string>> joints_of;
  const auto add = [&](pugi::xml_node joint) {
    for (const auto node : coordinates_of(joint)) {
      auto& joints = joints_of[OsimXml::name_of(node)];
      const std::string name = OsimXml::name_of(joint);
      if (joints.empty() || joints.back() != name) joints.push_back(name);
    }
  };
  for (const auto& [node, path] : components_of(model, "JointSet", "Joint")) add(node);
  for (const auto& [name, joints] : joints_of) {
    if (joints.size() < 2) continue;
    r.shared_coordinate_names.insert(name);
    r.note(
        "{} joints have a coordinate '{}'; here their names are {}_{} to {}_{} (columns of files may also name them "
        "/jointset/{}/{}); where the model names no joint, the first is meant, as in OpenSim",
        joints.size(), name, joints.front(), name, joints.back(), name, joints.front(), name);
  }
}

}  // namespace

void read_joints(OsimReading& r, pugi::xml_node model) {
  find_shared_names(r, model);
  for (const auto& [node, path] : components_of(model, "JointSet", "Joint")) read_joint(r, node, path);
}

}  // namespace myoid::body
