#include "myoid/model/osim_frames.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"

namespace myoid::model {
namespace {

/// As a number is after a text with six significant digits.
double six_digits(double value) {
  if (!std::isfinite(value)) return value;
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return std::strtod(text, nullptr);
}

void collect_frames(OsimReading& r,
                    pugi::xml_node parent,
                    const std::string& owner,
                    int depth = 0) {
  if (depth > 64) r.xml.fail(parent, "frames are nested more than 64 deep");
  for (const auto node : parent.children()) {
    if (std::strcmp(node.name(), "PhysicalOffsetFrame") == 0) {
      const std::string path = owner + "/" + OsimXml::name_of(node);
      r.frames[path] = {node, owner};
      collect_frames(r, node.child("components"), path, depth + 1);
    }
  }
}

Mat3 inertia_of(const OsimReading& r, pugi::xml_node node, const std::string& body) {
  Mat3 inertia = Mat3::Zero();
  double v[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
  if (const auto element = r.xml.property(node, "inertia")) {
    const auto values = r.xml.numbers(element);
    if (values.size() != 6) {
      r.xml.fail(element, fmt::format("body '{}': expected six numbers xx yy zz xy xz yz, found {}",
                                      body, values.size()));
    }
    std::copy(values.begin(), values.end(), v);
  } else if (r.is_old()) {
    const char* names[6] = {"inertia_xx", "inertia_yy", "inertia_zz",
                            "inertia_xy", "inertia_xz", "inertia_yz"};
    for (int k = 0; k < 6; ++k) {
      v[k] = r.xml.number(node, names[k], k < 3 ? 1.0 : 0.0);
      if (r.compat.six_digit_offsets) v[k] = six_digits(v[k]);
    }
  }
  inertia << v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2];
  return inertia;
}

FixedFrame resolve(const OsimReading& r,
                   pugi::xml_node where,
                   std::string name,
                   const std::string& owner,
                   int depth) {
  if (depth > 32) r.xml.fail(where, fmt::format("frame '{}' refers to itself", name));
  const auto found = [&](const std::string& path) -> std::optional<FixedFrame> {
    if (path == "/ground") return FixedFrame{};
    if (path.starts_with("/bodyset/")) {
      if (const auto body = r.model.find_body(std::string_view(path).substr(9)))
        return FixedFrame{*body, {}};
    }
    const auto it = r.frames.find(path);
    if (it == r.frames.end()) return std::nullopt;
    const pugi::xml_node frame = it->second.node;
    const std::string target = socket(r, frame, "parent");
    if (target.empty())
      r.xml.fail(frame, fmt::format("frame '{}': the socket 'parent' is missing", name));
    const FixedFrame parent = resolve(r, frame, target, it->second.owner, depth + 1);
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
    if (const auto frame = found("/bodyset/" + name)) return *frame;
  }
  r.xml.fail(where, fmt::format("there is no frame '{}'", name));
}

}  // namespace

void read_bodies(OsimReading& r, pugi::xml_node model) {
  r.model.bodies.push_back({.name = "ground"});
  collect_frames(r, model.child("Ground").child("components"), "/ground");
  collect_frames(r, model.child("components"), "");
  for (const auto node : OsimXml::objects(model.child("ComponentSet"))) {
    if (std::strcmp(node.name(), "PhysicalOffsetFrame") == 0)
      r.frames["/componentset/" + OsimXml::name_of(node)] = {node, "/componentset"};
  }
  for (const auto node : OsimXml::objects(model.child("BodySet"))) {
    if (node.type() != pugi::node_element) continue;
    Body body;
    body.name = OsimXml::name_of(node);
    if (body.name.empty()) r.xml.fail(node, "a body has no name");
    if (body.name == "ground") continue;
    if (r.model.find_body(body.name))
      r.xml.fail(node, fmt::format("two bodies are named '{}'", body.name));
    body.mass_kg = r.xml.number(node, "mass", r.is_old() ? 0.0 : std::nan(""));
    if (!(body.mass_kg >= 0.0) || !std::isfinite(body.mass_kg)) {
      r.xml.fail(node, fmt::format("body '{}': expected a mass of 0 or more in kg, found '{}'",
                                   body.name, r.xml.word(node, "mass")));
    }
    body.p_BBcm_B = r.xml.vec3(node, "mass_center", Vec3::Zero());
    body.I_BBcm_B = body.mass_kg == 0.0 ? Mat3::Zero() : inertia_of(r, node, body.name);
    if (!body.p_BBcm_B.allFinite() || !body.I_BBcm_B.allFinite()) {
      r.xml.fail(node, fmt::format("body '{}': mass center or inertia is not finite", body.name));
    }
    collect_frames(r, node.child("components"), "/bodyset/" + body.name);
    r.model.bodies.push_back(std::move(body));
  }
  for (const auto node : OsimXml::objects(model.child("JointSet")))
    collect_frames(r, node.child("frames"), "/jointset/" + OsimXml::name_of(node));
}

std::string socket(const OsimReading& r,
                   pugi::xml_node node,
                   std::string_view name,
                   const char* old_name) {
  std::string key = fmt::format("socket_{}", name);
  if (const auto child = r.xml.property(node, key.c_str())) return OsimXml::text_of(child);
  key += "_connectee_name";
  if (const auto child = r.xml.property(node, key.c_str())) return OsimXml::text_of(child);
  for (const auto child : node.child("connectors").children()) {
    if (OsimXml::name_of(child) == name) return OsimXml::text_of(child.child("connectee_name"));
  }
  return old_name == nullptr ? std::string() : r.xml.word(node, old_name);
}

FixedFrame resolve_frame(const OsimReading& r,
                         pugi::xml_node where,
                         std::string name,
                         const std::string& owner) {
  return resolve(r, where, std::move(name), owner, 0);
}

FixedFrame frame_of(const OsimReading& r,
                    pugi::xml_node node,
                    std::string_view socket_name,
                    const std::string& owner,
                    const char* old_name) {
  std::string target = socket(r, node, socket_name, old_name);
  if (target.empty()) {
    r.xml.fail(node,
               fmt::format("{} '{}': the socket '{}' is missing; expected the name of a frame",
                           node.name(), OsimXml::name_of(node), socket_name));
  }
  return resolve_frame(r, node, std::move(target), owner);
}

Pose pose_of(const OsimReading& r,
             pugi::xml_node node,
             const char* location,
             const char* orientation,
             bool rounded) {
  Vec3 p = r.xml.vec3(node, location, Vec3::Zero());
  Vec3 angles = r.xml.vec3(node, orientation, Vec3::Zero());
  if (rounded) {
    p = p.unaryExpr(&six_digits);
    angles = angles.unaryExpr(&six_digits);
  }
  return {rotation_body_xyz(angles), p};
}

int coordinate_named(const OsimReading& r, pugi::xml_node where, std::string_view text) {
  const std::size_t slash = text.find_last_of('/');
  const auto index =
      r.model.find_coordinate(slash == std::string_view::npos ? text : text.substr(slash + 1));
  if (!index) r.xml.fail(where, fmt::format("there is no coordinate '{}'", text));
  return *index;
}

bool is_enabled(const OsimReading& r, pugi::xml_node node, const char* positive) {
  if (node.child(positive)) return r.xml.flag(node, positive, true);
  if (node.child("isDisabled")) return !r.xml.flag(node, "isDisabled", false);
  return r.xml.flag(node, positive, true);
}

}  // namespace myoid::model
