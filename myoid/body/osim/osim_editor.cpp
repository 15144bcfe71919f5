#include "myoid/body/osim/osim_editor.h"

#include <cmath>
#include <sstream>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/osim_update_parts.h"
#include "myoid/body/osim/osim_updater.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

void set_text(pugi::xml_node object, const char* name, const std::string& text) {
  child_or_new(object, name).text().set(text.c_str());
}

void set_vec3(pugi::xml_node object, const char* name, const Vec3& v) {
  set_text(object, name, fmt::format("{} {} {}", v[0], v[1], v[2]));
}

/// Multiplies a vector or a number that the object or its prototype has.
void multiply(const OsimXml& xml, pugi::xml_node object, const char* name, const Vec3& factor) {
  if (!xml.property(object, name)) return;
  set_vec3(object, name, xml.vec3(object, name, Vec3::Zero()).cwiseProduct(factor));
}

void multiply(const OsimXml& xml, pugi::xml_node object, const char* name, double factor) {
  if (!xml.property(object, name)) return;
  set_text(object, name, fmt::format("{}", xml.number(object, name, 0.0) * factor));
}

/// Multiplies the function in `holder`, by wrapping it if it has no scale of its own.
void multiply_function(const OsimXml& xml, pugi::xml_node holder, double factor, bool freedom) {
  if (const auto inner = holder.child("function"); inner && OsimXml::first_element(inner)) holder = inner;
  auto function = OsimXml::first_element(holder, {"coordinates", "axis", "coordinate"});
  if (!function || factor == 1.0) return;
  if (std::string_view(function.name()) == "MultiplierFunction") {
    set_text(function, "scale", fmt::format("{}", xml.number(function, "scale", 1.0) * factor));
    return;
  }
  if (freedom && std::string_view(function.name()) == "LinearFunction") {
    const auto coefficients = xml.property(function, "coefficients");
    const auto values = coefficients ? xml.numbers(coefficients) : std::vector<double>{1.0, 0.0};
    if (values.size() == 2 && values[0] == 1.0 && values[1] == 0.0) return;
  }
  auto wrapper = holder.insert_child_before("MultiplierFunction", function);
  if (const auto name = function.attribute("name")) wrapper.append_attribute("name") = name.value();
  wrapper.append_child("function").append_copy(function);
  set_text(wrapper, "scale", fmt::format("{}", factor));
  holder.remove_child(function);
}

void scale_meshes(const OsimXml& xml, pugi::xml_node holder, const Vec3& factor) {
  for (const auto mesh : holder.child("attached_geometry").children()) {
    if (mesh.type() == pugi::node_element) multiply(xml, mesh, "scale_factors", factor);
  }
  for (const char* name : {"VisibleObject", "FrameGeometry"})
    if (const auto object = holder.child(name)) multiply(xml, object, "scale_factors", factor);
}

/// Returns a set that stands in the skeleton or in the model: "MarkerSet", "ConstraintSet".
pugi::xml_node set_of(pugi::xml_node skeleton, pugi::xml_node model, const char* name) {
  const auto set = skeleton.child(name);
  return set ? set : model.child(name);
}

/// Returns the factors by which unit vectors along the axes of a frame become longer.
Vec3 stretch(const Mat3& R, const Vec3& factor) {
  Vec3 result;
  for (int k = 0; k < 3; ++k) result[k] = R.col(k).cwiseProduct(factor).norm();
  return result;
}

}  // namespace

OsimEditor::OsimEditor(std::string text, std::filesystem::path path)
    : path_(std::move(path)), xml_(text, path_), newest_(std::move(text), path_), reading_(is_old() ? newest_ : xml_) {
  model_ = xml_.root().child("Model");
  if (!model_) xml_.fail(xml_.root(), "the document has no <Model>");
  constexpr int kFirstRelease = 40000;  // between are version 4's betas
  OsimXml& read = is_old() ? newest_ : xml_;
  if (xml_.version() < kFirstRelease) (void)bring_to_newest_form(read, {.looks = false});
  xml_.set_prototypes(model_.child("defaults"));
  const auto engine = OsimXml::first_element(model_.child("DynamicsEngine"));
  skeleton_ = engine && !model_.child("BodySet") ? engine : model_;
  read_bodies(reading_, read.root().child("Model"));
}

bool OsimEditor::is_old() const { return xml_.version() < kFirstOsimWithSockets; }

FixedFrame OsimEditor::frame_named(pugi::xml_node node, const char* socket, const std::string& owner) const {
  std::string name = xml_.word(node, fmt::format("socket_{}", socket).c_str());
  if (name.empty()) name = xml_.word(node, "body");
  if (name.empty()) xml_.fail(node, "{} '{}' names no frame", node.name(), OsimXml::name_of(node));
  return resolve_frame(reading_, node, std::move(name), owner);
}

std::string OsimEditor::text() const {
  std::ostringstream stream;
  stream << "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n";
  xml_.root().print(stream, "\t", pugi::format_indent);
  return stream.str();
}

void OsimEditor::set_name(const std::string& name) { set_attribute(model_, "name", name); }

pugi::xml_node OsimEditor::marker_set() const { return set_of(skeleton_, model_, "MarkerSet"); }

pugi::xml_node OsimEditor::marker(const std::string& name) const {
  for (const auto node : OsimXml::objects(marker_set())) {
    if (std::string_view(node.name()) == "Marker" && OsimXml::name_of(node) == name) return node;
  }
  return {};
}

void OsimEditor::add_markers(const std::filesystem::path& file) {
  OsimXml source(read_text_file(file), file, OsimXml::Root::any);
  auto set = source.root().child("MarkerSet");
  if (!set) source.fail(source.root(), "expected a <MarkerSet>");
  source.set_prototypes(set.child("defaults"));
  auto own = marker_set();
  if (!own) own = skeleton_.append_child("MarkerSet");
  auto objects = child_or_new(own, "objects");
  (void)bring_to_newest_form(source, {.looks = false});
  for (const auto node : OsimXml::objects(set)) {
    if (std::string_view(node.name()) != "Marker") continue;
    const std::string name = OsimXml::name_of(node);
    if (const auto old = marker(name)) objects.remove_child(old);
    std::string body = source.word(node, "socket_parent_frame");
    if (body.empty()) source.fail(node, "marker '{}' is on no body", name);
    auto added = objects.append_child("Marker");
    added.append_attribute("name") = name.c_str();
    if (is_old()) {
      if (const auto slash = body.rfind('/'); slash != std::string::npos) body.erase(0, slash + 1);
      set_text(added, "body", body);
    } else {
      if (body.find('/') == std::string::npos) body = body_path(body);
      set_text(added, "socket_parent_frame", body);
    }
    (void)resolve_frame(reading_, node, body, "");
    set_vec3(added, "location", source.vec3(node, "location", Vec3::Zero()));
    set_text(added, "fixed", source.flag(node, "fixed", false) ? "true" : "false");
  }
}

void OsimEditor::remove_markers(const std::function<bool(const std::string&)>& is_removed) {
  auto objects = marker_set().child("objects");
  for (auto node = objects.first_child(); node;) {
    const auto next = node.next_sibling();
    if (std::string_view(node.name()) == "Marker" && is_removed(OsimXml::name_of(node))) objects.remove_child(node);
    node = next;
  }
}

bool OsimEditor::is_fixed(const std::string& name) const {
  const auto node = marker(name);
  return node && xml_.flag(node, "fixed", false);
}

void OsimEditor::move_marker(const std::string& name, const Vec3& p_B) {
  const auto node = marker(name);
  if (!node) throw InvalidInput(fmt::format("the model has no marker '{}'", name));
  const FixedFrame frame = frame_named(node, "parent_frame", "/markerset/" + name);
  set_vec3(node, "location", frame.X_BF.inverse() * p_B);
}

std::string OsimEditor::marker_set_text() const {
  std::ostringstream stream;
  stream << "<?xml version=\"1.0\" encoding=\"UTF-8\" ?>\n<OpenSimDocument Version=\""
         << xml_.root().attribute("Version").value() << "\">\n";
  marker_set().print(stream, "\t", pugi::format_indent, pugi::encoding_auto, 1);
  stream << "</OpenSimDocument>\n";
  return stream.str();
}

Vec3 OsimEditor::factor_of(const Factors& factors, BodyIndex body) const {
  const auto it = factors.find(reading_.model.bodies[at(body)].name);
  return it == factors.end() ? Vec3(Vec3::Ones()) : it->second;
}

void OsimEditor::scale_wraps(pugi::xml_node holder, const FixedFrame& frame, const Vec3& factor) {
  for (const auto node : OsimXml::objects(holder.child("WrapObjectSet"))) {
    // Factors along the object's own axes.
    const Pose X_FW = pose_of(reading_, node, "translation", "xyz_body_rotation");
    const Vec3 along = stretch((frame.X_BF * X_FW).R, factor);
    multiply(xml_, node, "translation", factor);
    const std::string_view kind = node.name();
    if (kind == "WrapCylinder") {
      multiply(xml_, node, "radius", 0.5 * (along[0] + along[1]));
      multiply(xml_, node, "length", along[2]);
    } else if (kind == "WrapEllipsoid") {
      multiply(xml_, node, "dimensions", along);
    } else if (kind == "WrapSphere") {
      multiply(xml_, node, "radius", factor.mean());
    } else if (kind == "WrapTorus") {
      multiply(xml_, node, "inner_radius", 0.5 * (along[0] + along[1]));
      multiply(xml_, node, "outer_radius", 0.5 * (along[0] + along[1]));
    }
  }
}

void OsimEditor::scale_joint(pugi::xml_node joint, const Vec3& parent, const Vec3& child) {
  for (const auto axis : joint.child("SpatialTransform").children()) {
    const std::string name = OsimXml::name_of(axis);
    if (!name.starts_with("translation")) continue;
    const Vec3 direction = xml_.vec3(axis, "axis", Vec3::UnitX()).normalized();
    multiply_function(xml_, axis, direction.cwiseAbs().dot(parent), true);
  }
  multiply(xml_, joint, "radii_x_y_z", parent);
  if (std::string_view(joint.name()) == "ConstantCurvatureJoint") multiply(xml_, joint, "length", child[1]);
  multiply(xml_, joint, "thoracic_ellipsoid_radii_x_y_z", parent);
  if (const auto origin = xml_.property(joint, "scapula_winging_axis_origin")) {
    const auto v = xml_.numbers(origin);
    if (v.size() == 2) {
      set_text(joint, "scapula_winging_axis_origin", fmt::format("{} {}", v[0] * child[0], v[1] * child[1]));
    }
  }
}

void OsimEditor::scale_points(pugi::xml_node force, const Factors& factors) {
  const std::string owner = "/forceset/" + OsimXml::name_of(force);
  const auto scale_path = [&](pugi::xml_node path) {
    for (const auto point : OsimXml::objects(either_child(path, "PathPointSet", "MusclePointSet"))) {
      const FixedFrame frame = frame_named(point, "parent_frame", owner);
      const Vec3 factor = factor_of(factors, frame.body);
      multiply(xml_, point, "location", factor);
      multiply(xml_, point, "attachment", factor);
      const char* functions[] = {"x_location", "y_location", "z_location"};
      const char* old_functions[] = {"XAttachment", "YAttachment", "ZAttachment"};
      for (int k = 0; k < 3; ++k) {
        for (const char* name : {functions[k], old_functions[k]})
          if (const auto holder = point.child(name)) multiply_function(xml_, holder, factor[k], false);
      }
    }
  };
  scale_path(force);  // before 20000 the muscle held the points
  if (const auto path = force.child("GeometryPath")) scale_path(path);
  for (const auto path : force.child("path").children()) scale_path(path);
  for (const auto frame : force.child("frames").children()) {
    if (std::string_view(frame.name()) != "PhysicalOffsetFrame") continue;
    const FixedFrame parent = frame_named(frame, "parent", owner);
    multiply(xml_, frame, "translation", factor_of(factors, parent.body));
  }
}

void OsimEditor::scale_geometry(const Factors& factors) {
  // Objects that refer to frames are scaled before the frames.
  for (const auto node : OsimXml::objects(marker_set())) {
    if (std::string_view(node.name()) != "Marker") continue;
    const FixedFrame frame = frame_named(node, "parent_frame", "/markerset/" + OsimXml::name_of(node));
    multiply(xml_, node, "location", factor_of(factors, frame.body));
  }
  for (const auto force : OsimXml::objects(either_child(model_, "ForceSet", "ActuatorSet")))
    scale_points(force, factors);
  for (const auto& [joint, owner] : components_of(skeleton_, "JointSet", "Joint")) {
    scale_joint(joint, factor_of(factors, frame_named(joint, "parent_frame", owner).body),
                factor_of(factors, frame_named(joint, "child_frame", owner).body));
  }
  std::vector<std::pair<pugi::xml_node, Vec3>> frames;
  for (const auto& [path, frame] : reading_.frames) {
    const FixedFrame own = resolve_frame(reading_, frame.node, path, "");
    frames.emplace_back(frame.node, factor_of(factors, own.body));
    scale_wraps(frame.node, own, factor_of(factors, own.body));
  }
  for (const auto& [node, factor] : frames) {
    multiply(xml_, node, "translation", factor);
    scale_meshes(xml_, node, factor);
  }
  scale_wraps(model_.child("Ground"), {}, factor_of(factors, 0));
  for (const auto& [node, path] : components_of(skeleton_, "BodySet", "Body")) {
    const auto body = reading_.find_body(OsimXml::name_of(node)).value_or(0);
    const Vec3 factor = factor_of(factors, body);
    multiply(xml_, node, "mass_center", factor);
    scale_wraps(node, {body, {}}, factor);
    scale_meshes(xml_, node, factor);
    auto joint = OsimXml::first_element(node.child("Joint"));
    if (!joint) continue;
    const auto parent = reading_.find_body(xml_.word(joint, "parent_body")).value_or(0);
    multiply(xml_, joint, "location_in_parent", factor_of(factors, parent));
    multiply(xml_, joint, "location", factor);
    multiply(xml_, joint, "location_in_child", factor);
    scale_joint(joint, factor_of(factors, parent), factor);
  }
  for (const auto node : OsimXml::objects(set_of(skeleton_, model_, "ConstraintSet"))) {
    const std::string_view kind = node.name();
    if (kind == "PointConstraint" || kind == "ConstantDistanceConstraint" || kind == "PointOnLineConstraint") {
      notes_.push_back(
          fmt::format("{} '{}': its points are not scaled (nor does OpenSim)", kind, OsimXml::name_of(node)));
    }
  }
}

void OsimEditor::scale_masses(const Factors& factors, bool keep_masses, double total_kg) {
  std::vector<double> masses;
  std::vector<Mat3> inertias;
  double total = 0.0;
  for (const Body& body : reading_.model.bodies) {
    const auto it = factors.find(body.name);
    double mass = body.mass_kg;
    Mat3 inertia = body.I_BBcm_B;
    if (it != factors.end()) {
      const Vec3& f = it->second;
      const double volume = std::abs(f.prod());
      if (!keep_masses) mass *= volume;
      if (mass <= 2.220446049250313e-16) {
        inertia.setZero();
      } else if (f[0] == f[1] && f[1] == f[2]) {
        inertia *= f[0] * f[0] * (keep_masses ? 1.0 : volume);
      } else {
        // A cylinder about the axis of least inertia.
        Eigen::Index axis = 0;
        inertia.diagonal().minCoeff(&axis);
        const Eigen::Index other = axis == 0 ? 1 : 0;
        const double old = body.mass_kg;
        const double radius2 = std::max(0.0, 2.0 * inertia(axis, axis) / old);
        const double length2 =
            std::max(0.0, 12.0 * (inertia(other, other) - 0.25 * old * radius2) / old) * f[axis] * f[axis];
        const double new_radius2 = radius2 * f.prod() / f[axis];
        for (Eigen::Index a = 0; a < 3; ++a) {
          for (Eigen::Index b = 0; b < 3; ++b) {
            if (a != b) inertia(a, b) *= f[a] * f[b] * (keep_masses ? 1.0 : volume);
          }
          inertia(a, a) = a == axis ? 0.5 * mass * new_radius2 : mass * (length2 / 12.0 + 0.25 * new_radius2);
        }
      }
    }
    total += mass;
    masses.push_back(mass);
    inertias.push_back(inertia);
  }
  const double share = total_kg > 0.0 && total > 0.0 ? total_kg / total : 1.0;
  for (const auto& [node, path] : components_of(skeleton_, "BodySet", "Body")) {
    const auto body = reading_.find_body(OsimXml::name_of(node));
    if (!body || *body == 0) continue;
    const auto b = static_cast<std::size_t>(*body);
    set_text(node, "mass", fmt::format("{}", share * masses[b]));
    const Mat3 I = share * inertias[b];
    const double values[] = {I(0, 0), I(1, 1), I(2, 2), I(0, 1), I(0, 2), I(1, 2)};
    if (is_old()) {
      const char* names[] = {"inertia_xx", "inertia_yy", "inertia_zz", "inertia_xy", "inertia_xz", "inertia_yz"};
      for (int k = 0; k < 6; ++k) set_text(node, names[k], fmt::format("{}", values[k]));
    } else {
      set_text(node, "inertia",
               fmt::format("{} {} {} {} {} {}", values[0], values[1], values[2], values[3], values[4], values[5]));
    }
  }
}

void OsimEditor::scale_lengths(const std::string& name, double factor) {
  for (const auto force : OsimXml::objects(either_child(model_, "ForceSet", "ActuatorSet"))) {
    if (OsimXml::name_of(force) != name) continue;
    for (const char* property : {"optimal_fiber_length", "tendon_slack_length", "resting_length"})
      multiply(xml_, force, property, factor);
    return;
  }
}

}  // namespace myoid::body
