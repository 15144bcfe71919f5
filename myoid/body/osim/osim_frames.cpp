#include "myoid/body/osim/osim_frames.h"

#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/osim_updater.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::body {
namespace {

/// Returns true for a frame fixed to a body, or a point fixed in one.
bool is_frame(pugi::xml_node node) {
  for (const char* kind : {"PhysicalOffsetFrame", "StationDefinedFrame", "Station"})
    if (std::strcmp(node.name(), kind) == 0) return true;
  return false;
}

void collect_frames(OsimReading& r, pugi::xml_node parent, const std::string& owner, int depth = 0) {
  if (depth > 64) r.xml.fail(parent, "frames are nested more than 64 deep");
  for (const auto node : parent.children()) {
    if (is_frame(node)) {
      const std::string path = owner + "/" + OsimXml::name_of(node);
      r.frames[path] = {node, owner};
      collect_frames(r, node.child("components"), path, depth + 1);
    }
  }
}

Mat3 inertia_of(const OsimReading& r, pugi::xml_node node, const std::string& body) {
  const auto element = r.xml.property(node, "inertia");
  if (!element) return Mat3::Zero();
  const auto v = r.xml.numbers(element);
  if (v.size() != 6) r.xml.fail(element, "body '{}': expected six numbers xx yy zz xy xz yz, found {}", body, v.size());
  return (Mat3() << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2]).finished();
}

FixedFrame resolve(const OsimReading& r, pugi::xml_node where, std::string name, const std::string& owner, int depth);

/// Returns the frame that four stations of one body span: its origin, an axis from a to b, another
/// along ab x ac (StationDefinedFrame of OpenSim 4.5).
FixedFrame station_defined(const OsimReading& r, pugi::xml_node node, const std::string& owner, int depth) {
  const auto point = [&](const char* name) {
    const std::string target = socket(r, node, name);
    if (target.empty()) {
      r.xml.fail(node, "StationDefinedFrame '{}': the socket '{}' is missing", OsimXml::name_of(node), name);
    }
    return resolve(r, node, target, owner, depth + 1);
  };
  const FixedFrame a = point("point_a"), b = point("point_b"), c = point("point_c");
  const FixedFrame origin = point("origin_point");
  struct Axis {
    Eigen::Index index = 0;
    double sign = 1.0;
  };
  const auto axis = [&](const char* name, const char* otherwise) {
    std::string text = r.xml.word(node, name);
    if (text.empty()) text = otherwise;
    const bool has_sign = text.front() == '-' || text.front() == '+';
    const char letter = text.size() == (has_sign ? 2U : 1U) ? text.back() : '?';
    if (letter < 'x' || letter > 'z') {
      r.xml.fail(node, "<{}>: expected +x, -x, +y, -y, +z or -z, found '{}'", name, text);
    }
    return Axis{letter - 'x', text.front() == '-' ? -1.0 : 1.0};
  };
  const Axis first = axis("ab_axis", "+x"), second = axis("ab_x_ac_axis", "+y");
  const Vec3 ab = b.X_BF.p - a.X_BF.p;
  const Vec3 across = ab.cross(c.X_BF.p - a.X_BF.p);
  if (a.body != b.body || a.body != c.body || a.body != origin.body || first.index == second.index ||
      !(across.norm() > 0.0)) {
    r.xml.fail(node,
               "StationDefinedFrame '{}': expected four points of one body, three of them not on a line, and two "
               "different axes",
               OsimXml::name_of(node));
  }
  Mat3 R;
  R.col(first.index) = first.sign * ab.normalized();
  R.col(second.index) = second.sign * across.normalized();
  const Eigen::Index third = 3 - first.index - second.index;
  R.col(third) = R.col((third + 1) % 3).cross(R.col((third + 2) % 3));
  return {origin.body, {R, origin.X_BF.p}};
}

FixedFrame resolve(const OsimReading& r, pugi::xml_node where, std::string name, const std::string& owner, int depth) {
  if (depth > 32) r.xml.fail(where, "frame '{}' refers to itself", name);
  const auto found = [&](const std::string& path) -> std::optional<FixedFrame> {
    if (path == "/ground") return FixedFrame{};
    // Bodies are in their set or among the components; their names are unique.
    for (const std::string_view set : {"/bodyset/", "/componentset/", "/"}) {
      if (!path.starts_with(set)) continue;
      if (const auto body = r.find_body(std::string_view(path).substr(set.size()))) return FixedFrame{*body, {}};
    }
    const auto it = r.frames.find(path);
    if (it == r.frames.end()) return std::nullopt;
    const pugi::xml_node frame = it->second.node;
    if (std::strcmp(frame.name(), "StationDefinedFrame") == 0)
      return station_defined(r, frame, it->second.owner, depth);
    const bool is_point = std::strcmp(frame.name(), "Station") == 0;
    const std::string target = socket(r, frame, is_point ? "parent_frame" : "parent");
    if (target.empty()) r.xml.fail(frame, "frame '{}': the socket 'parent' is missing", name);
    const FixedFrame parent = resolve(r, frame, target, it->second.owner, depth + 1);
    if (is_point) {
      return FixedFrame{parent.body, parent.X_BF * Pose{Mat3::Identity(), r.xml.vec3(frame, "location", Vec3::Zero())}};
    }
    return FixedFrame{parent.body, parent.X_BF * pose_of(r, frame, "translation", "orientation")};
  };
  if (name.starts_with('/')) {
    if (const auto frame = found(name)) return *frame;
  } else if (name == "..") {
    // The component that holds the frame.
    if (const auto frame = found(owner)) return *frame;
  } else {
    while (name.starts_with("../")) name.erase(0, 3);
    for (std::string base = owner;;) {
      if (const auto frame = found(base + "/" + name)) return *frame;
      if (base.empty()) break;
      base.erase(base.find_last_of('/'));
    }
    if (const auto frame = found("/frameset/" + name)) return *frame;
  }
  r.xml.fail(where, "there is no frame '{}'", name);
}

using Places = std::map<std::string, int, std::less<>>;

/// Returns "/bodyset" for "BodySet".
std::string path_of_set(std::string_view name) { return "/" + lower_case(name); }

std::optional<int> place_of(const Places& places, std::string_view name) {
  const auto it = places.find(name);
  return it == places.end() ? std::nullopt : std::optional(it->second);
}

}  // namespace

OsimReading::OsimReading(const OsimXml& document, const Compat& as, BodyModel known, Frames known_frames)
    : xml(document), compat(as), model(std::move(known)), frames(std::move(known_frames)) {
  for (std::size_t b = 0; b < model.bodies.size(); ++b) body_places.emplace(model.bodies[b].name, static_cast<int>(b));
  for (std::size_t c = 0; c < model.coordinates.size(); ++c)
    coordinate_places.emplace(model.coordinates[c].name, static_cast<int>(c));
}

int OsimReading::add(Body body) {
  const auto place = static_cast<int>(model.bodies.size());
  body_places.emplace(body.name, place);
  model.bodies.push_back(std::move(body));
  return place;
}

int OsimReading::add(Coordinate coordinate) {
  const auto place = static_cast<int>(model.coordinates.size());
  coordinate_places.emplace(coordinate.name, place);
  model.coordinates.push_back(std::move(coordinate));
  return place;
}

std::optional<int> OsimReading::find_body(std::string_view name) const { return place_of(body_places, name); }
std::optional<int> OsimReading::find_coordinate(std::string_view name) const {
  if (const auto place = place_of(coordinate_places, name)) return place;
  return name.find('/') == std::string_view::npos ? std::nullopt : model.find_coordinate(name);
}

std::vector<ModelComponent> components_of(pugi::xml_node model, const char* set, std::string_view kind) {
  std::vector<ModelComponent> found;
  for (const auto node : OsimXml::objects(model.child(set)))
    found.push_back({node, path_of_set(set) + "/" + OsimXml::name_of(node)});
  const auto add = [&](pugi::xml_node holder, const std::string& owner) {
    for (const auto node : holder.children())
      if (std::string_view(node.name()).ends_with(kind)) found.push_back({node, owner + "/" + OsimXml::name_of(node)});
  };
  add(model.child("components"), "");
  add(model.child("ComponentSet").child("objects"), "/componentset");
  return found;
}

void read_bodies(OsimReading& r, pugi::xml_node model) {
  r.add(Body{.name = "ground"});
  collect_frames(r, model.child("Ground").child("components"), "/ground");
  collect_frames(r, model.child("components"), "");
  for (const auto set : {model.child("ComponentSet"), model.child("FrameSet")})
    collect_frames(r, set.child("objects"), path_of_set(set.name()));
  for (const auto& [node, path] : components_of(model, "BodySet", "Body")) {
    Body body;
    body.name = OsimXml::name_of(node);
    if (body.name.empty()) r.xml.fail(node, "a body has no name");
    if (body.name == "ground") continue;
    if (r.find_body(body.name)) r.xml.fail(node, "two bodies are named '{}'", body.name);
    body.mass_kg = r.xml.number(node, "mass", std::nan(""));
    if (!(body.mass_kg >= 0.0) || !std::isfinite(body.mass_kg)) {
      r.xml.fail(node, "body '{}': expected a mass of 0 or more in kg, found '{}'", body.name,
                 r.xml.word(node, "mass"));
    }
    body.p_BBcm_B = r.xml.vec3(node, "mass_center", Vec3::Zero());
    body.I_BBcm_B = body.mass_kg == 0.0 ? Mat3::Zero() : inertia_of(r, node, body.name);
    if (!body.p_BBcm_B.allFinite() || !body.I_BBcm_B.allFinite()) {
      r.xml.fail(node, "body '{}': mass center or inertia is not finite", body.name);
    }
    for (int k = 0; k < 3; ++k) {
      if (body.I_BBcm_B(k, k) < 0.0) {
        r.note("body '{}': the moment of inertia about its axis {} is negative, {} kg m^2; it is used as it is",
               body.name, "xyz"[k], body.I_BBcm_B(k, k));
      }
    }
    collect_frames(r, node.child("components"), path);
    r.add(std::move(body));
  }
  for (const auto& [node, path] : components_of(model, "JointSet", "Joint"))
    collect_frames(r, node.child("frames"), path);
}

std::string socket(const OsimReading& r, pugi::xml_node node, std::string_view name) {
  return r.xml.word(node, fmt::format("socket_{}", name).c_str());
}

FixedFrame resolve_frame(const OsimReading& r, pugi::xml_node where, std::string name, const std::string& owner) {
  return resolve(r, where, std::move(name), owner, 0);
}

FixedFrame frame_of(const OsimReading& r, pugi::xml_node node, std::string_view socket_name, const std::string& owner) {
  std::string target = socket(r, node, socket_name);
  if (target.empty()) {
    r.xml.fail(node, "{} '{}': the socket '{}' is missing; expected the name of a frame", node.name(),
               OsimXml::name_of(node), socket_name);
  }
  return resolve_frame(r, node, std::move(target), owner);
}

BodyPoint point_of(
    const OsimReading& r, pugi::xml_node node, const std::string& owner, const char* frame, const char* place) {
  const FixedFrame fixed = frame_of(r, node, frame, owner);
  return {fixed.body, fixed.X_BF * r.xml.vec3(node, place, Vec3::Zero())};
}

Pose pose_of(const OsimReading& r, pugi::xml_node node, const char* location, const char* orientation) {
  const Vec3 p = r.xml.vec3(node, location, Vec3::Zero());
  return {rotation_body_xyz(r.xml.vec3(node, orientation, Vec3::Zero())), p};
}

int coordinate_named(const OsimReading& r, pugi::xml_node where, std::string_view text) {
  if (const auto index = r.find_coordinate(text)) return *index;
  // If several coordinates have that name, the first joint's counts, as in OpenSim.
  if (r.shared_coordinate_names.contains(text)) {
    for (const Joint& joint : r.model.joints)
      if (const auto index = r.find_coordinate(fmt::format("{}/{}", joint.name, text))) return *index;
  }
  r.xml.fail(where, "there is no coordinate '{}'", text);
}

double positive(const OsimReading& r, pugi::xml_node node, const char* name, double otherwise) {
  const double value = r.xml.number(node, name, otherwise);
  if (!(value > 0.0) || !std::isfinite(value)) {
    r.xml.fail(node, "{} '{}': expected <{}> above 0, found {}", node.name(), OsimXml::name_of(node), name, value);
  }
  return value;
}

Vec3 direction_of(const OsimReading& r, pugi::xml_node node, const char* name, const Vec3& otherwise) {
  const Vec3 v = r.xml.vec3(node, name, otherwise);
  if (!(v.norm() > 0.0) || !v.allFinite())
    r.xml.fail(node, "{} '{}': <{}> is no direction", node.name(), OsimXml::name_of(node), name);
  return v.normalized();
}

std::optional<FixedFrame> find_frame(const BodyModel& model,
                                     const std::filesystem::path& path,
                                     const std::string& name) {
  OsimXml xml(read_text_file(path), path);
  (void)bring_to_newest_form(xml, {.six_digits = model.compat.six_digit_offsets, .looks = false});
  OsimReading r{xml, model.compat};
  read_bodies(r, xml.root().child("Model"));
  try {
    return resolve_frame(r, xml.root(), name, "/jointset");
  } catch (const ReadError&) {
    return std::nullopt;
  }
}

std::pair<FixedFrame, FixedFrame> two_frames(const OsimReading& r, pugi::xml_node node) {
  const std::string owner = "/forceset/" + OsimXml::name_of(node);
  // Frames of its own: <frames><PhysicalOffsetFrame name="...">.
  const auto own = [&](const char* socket_name) {
    const std::string target = socket(r, node, socket_name);
    for (const auto frame : node.child("frames").children("PhysicalOffsetFrame")) {
      const std::string name = OsimXml::name_of(frame);
      if (target == name || target.ends_with("/" + name)) {
        const FixedFrame parent = frame_of(r, frame, "parent", owner);
        return FixedFrame{parent.body, parent.X_BF * pose_of(r, frame, "translation", "orientation")};
      }
    }
    return frame_of(r, node, socket_name, owner);
  };
  return {own("frame1"), own("frame2")};
}

}  // namespace myoid::body
