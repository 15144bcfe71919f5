#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/osim/osim_parts.h"

namespace myoid::body {
namespace {

struct Surface {
  std::string name;
  BodyIndex body = 0;
  Pose X_BS;
  std::optional<double> radius_m;  ///< Radius of a sphere; empty for a half-space.
  Contact::Material material;
};

/// Returns the contact geometry of a name, from the model's set or its components.
pugi::xml_node geometry_named(const OsimReading& r, std::string_view name) {
  const auto model = r.xml.root().child("Model");
  const auto is_it = [&](pugi::xml_node node) {
    return std::string_view(node.name()).starts_with("Contact") && OsimXml::name_of(node) == name;
  };
  for (const auto node : OsimXml::objects(model.child("ContactGeometrySet")))
    if (is_it(node)) return node;
  for (const auto node : model.child("components").children())
    if (is_it(node)) return node;
  return {};
}

/// Returns the surface; empty, with an entry in the list of unsupported parts, if it is neither a
/// sphere nor a half-space.
std::optional<Surface> read_surface(OsimReading& r, pugi::xml_node force, const std::string& name) {
  const auto node = geometry_named(r, name);
  const std::string_view kind = node.name();
  if (kind != "ContactSphere" && kind != "ContactHalfSpace") {
    r.leave_out("{} '{}': {}; what touches it makes no force", force.name(), OsimXml::name_of(force),
                node ? fmt::format("contact geometry '{}' of kind {} is not supported", name, kind)
                     : fmt::format("there is no contact geometry '{}'", name));
    return {};
  }
  const FixedFrame frame = frame_of(r, node, "frame", "/contactgeometryset/" + name);
  Surface surface{name, frame.body, frame.X_BF * pose_of(r, node, "location", "orientation"), {}, {}};
  if (kind == "ContactSphere") {
    surface.radius_m = r.xml.number(node, "radius", 0.0);
    if (!(*surface.radius_m > 0.0) || !std::isfinite(*surface.radius_m)) {
      r.xml.fail(node, "ContactSphere '{}': expected <radius> above 0 m, found {}", name, *surface.radius_m);
    }
  }
  return surface;
}

Contact::Material material_of(const OsimReading& r, pugi::xml_node node) {
  const Contact::Material m{.stiffness = r.xml.number(node, "stiffness", 1.0),
                            .dissipation = r.xml.number(node, "dissipation", 0.0),
                            .static_friction = r.xml.number(node, "static_friction", 0.0),
                            .dynamic_friction = r.xml.number(node, "dynamic_friction", 0.0),
                            .viscous_friction = r.xml.number(node, "viscous_friction", 0.0)};
  if (!(m.stiffness > 0.0)) r.xml.fail(node, "contact: expected <stiffness> above 0, found {}", m.stiffness);
  return m;
}

double transition_velocity(const OsimReading& r, pugi::xml_node force) {
  const double v = r.xml.number(force, "transition_velocity", 0.01);
  if (!(v > 0.0)) {
    r.xml.fail(force, "contact: expected <transition_velocity> above 0 m/s, found {}", v);
  }
  return v;
}

Contact between(const Surface& sphere, const Surface& other) {
  return {.sphere_body = sphere.body,
          .other_body = other.body,
          .p_BS = sphere.X_BS.p,
          .radius_m = *sphere.radius_m,
          .X_BO = other.X_BS,
          .other_radius_m = other.radius_m,
          .materials = {sphere.material, other.material}};
}

}  // namespace

std::vector<Contact> read_contacts(OsimReading& r, pugi::xml_node force) {
  std::vector<Contact> contacts;
  if (std::string_view(force.name()) == "SmoothSphereHalfSpaceForce") {
    const auto last_part = [](std::string path) {
      return path.substr(path.find_last_of('/') + 1);  // the whole path if it has no slash
    };
    auto sphere = read_surface(r, force, last_part(socket(r, force, "sphere")));
    auto plane = read_surface(r, force, last_part(socket(r, force, "half_space")));
    if (!sphere || !plane) return contacts;
    if (!sphere->radius_m || plane->radius_m)
      r.xml.fail(force, "expected a ContactSphere and a ContactHalfSpace in its sockets");
    sphere->material = plane->material = material_of(r, force);
    Contact contact = between(*sphere, *plane);
    contact.transition_velocity_mps = transition_velocity(r, force);
    contact.smoothing = Contact::Smoothing{.constant = r.xml.number(force, "constant_contact_force", 1e-5),
                                           .hertz = r.xml.number(force, "hertz_smoothing", 300.0),
                                           .hunt_crossley = r.xml.number(force, "hunt_crossley_smoothing", 50.0)};
    contacts.push_back(std::move(contact));
    return contacts;
  }
  std::vector<Surface> surfaces;
  const auto set = either_child(force, "HuntCrossleyForce::ContactParametersSet", "contact_parameters");
  for (const auto parameters : OsimXml::objects(set)) {
    for (const std::string& name : r.xml.words(parameters, "geometry")) {
      if (auto surface = read_surface(r, force, name)) {
        surface->material = material_of(r, parameters);
        surfaces.push_back(std::move(*surface));
      }
    }
  }
  const double velocity = transition_velocity(r, force);
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    for (std::size_t k = i + 1; k < surfaces.size(); ++k) {
      const Surface& a = surfaces[i];
      const Surface& b = surfaces[k];
      if (a.body == b.body || (!a.radius_m && !b.radius_m)) continue;
      contacts.push_back(a.radius_m ? between(a, b) : between(b, a));
      contacts.back().transition_velocity_mps = velocity;
    }
  }
  return contacts;
}

}  // namespace myoid::body
