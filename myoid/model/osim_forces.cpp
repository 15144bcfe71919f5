#include "myoid/model/osim_forces.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/units.h"
#include "myoid/model/osim_joints.h"
#include "myoid/model/osim_muscles.h"

namespace myoid::model {
namespace {

Vec3 unit(const OsimReading& r, pugi::xml_node node, const char* name, const Vec3& otherwise) {
  const Vec3 v = r.xml.vec3(node, name, otherwise);
  if (!(v.norm() > 0.0) || !v.allFinite())
    r.xml.fail(node, fmt::format("{} '{}': <{}> is no direction", node.name(),
                                 OsimXml::name_of(node), name));
  return v.normalized();
}

/// Name, strength, bounds and switch that all actuators have.
template <typename Actuator>
void read_common(const OsimReading& r, pugi::xml_node node, Actuator& actuator) {
  actuator.name = OsimXml::name_of(node);
  actuator.optimal_force = r.xml.number(node, "optimal_force", 1.0);
  actuator.min_control = r.xml.number(node, "min_control", actuator.min_control);
  actuator.max_control = r.xml.number(node, "max_control", actuator.max_control);
  actuator.applies_force = is_enabled(r, node, "appliesForce");
}

CoordinateLimitForce read_limit(const OsimReading& r, pugi::xml_node node, int coordinate) {
  CoordinateLimitForce f;
  f.coordinate = coordinate;
  const bool angle =
      r.model.coordinates[static_cast<std::size_t>(coordinate)].motion == MotionType::rotational;
  const double unit_rad = angle ? kDegree : 1.0;  // limits in degrees, stiffness per degree
  f.upper_limit = unit_rad * r.xml.number(node, "upper_limit", 0.0);
  f.lower_limit = unit_rad * r.xml.number(node, "lower_limit", 0.0);
  f.upper_stiffness = r.xml.number(node, "upper_stiffness", 1.0) / unit_rad;
  f.lower_stiffness = r.xml.number(node, "lower_stiffness", 1.0) / unit_rad;
  f.damping = r.xml.number(node, "damping", 0.001) / unit_rad;
  f.transition = unit_rad * r.xml.number(node, "transition", 0.1);
  if (!(f.transition > 0.0))
    r.xml.fail(node, fmt::format("CoordinateLimitForce '{}': expected <transition> above 0",
                                 OsimXml::name_of(node)));
  return f;
}

/// The two frames that a bushing or a constraint joins, in the new and in the old spelling.
std::pair<FixedFrame, FixedFrame> two_frames(const OsimReading& r, pugi::xml_node node) {
  const std::string owner = "/forceset/" + OsimXml::name_of(node);
  // Frames of its own: <frames><PhysicalOffsetFrame name="...">.
  const auto own = [&](const char* socket_name, const char* old_name, const char* location,
                       const char* orientation) {
    const std::string target = socket(r, node, socket_name);
    for (const auto frame : node.child("frames").children("PhysicalOffsetFrame")) {
      const std::string name = OsimXml::name_of(frame);
      if (target == name || target.ends_with("/" + name)) {
        const FixedFrame parent = frame_of(r, frame, "parent", owner);
        return FixedFrame{parent.body,
                          parent.X_BF * pose_of(r, frame, "translation", "orientation")};
      }
    }
    FixedFrame frame = frame_of(r, node, socket_name, owner, old_name);
    if (target.empty()) frame.X_BF = frame.X_BF * pose_of(r, node, location, orientation);
    return frame;
  };
  return {own("frame1", "body_1", "location_body_1", "orientation_body_1"),
          own("frame2", "body_2", "location_body_2", "orientation_body_2")};
}

Bushing read_bushing(const OsimReading& r, pugi::xml_node node) {
  const auto [first, second] = two_frames(r, node);
  Bushing b{first.body, second.body, first.X_BF, second.X_BF, {}, {}, {}, {}};
  b.rotational_stiffness = r.xml.vec3(node, "rotational_stiffness", Vec3::Zero());
  b.translational_stiffness = r.xml.vec3(node, "translational_stiffness", Vec3::Zero());
  b.rotational_damping = r.xml.vec3(node, "rotational_damping", Vec3::Zero());
  b.translational_damping = r.xml.vec3(node, "translational_damping", Vec3::Zero());
  return b;
}

PointSpring read_point_spring(const OsimReading& r, pugi::xml_node node) {
  const std::string owner = "/forceset/" + OsimXml::name_of(node);
  const FixedFrame first = frame_of(r, node, "body1", owner, "body1");
  const FixedFrame second = frame_of(r, node, "body2", owner, "body2");
  return {first.body,
          second.body,
          first.X_BF * r.xml.vec3(node, "point1", Vec3::Zero()),
          second.X_BF * r.xml.vec3(node, "point2", Vec3::Zero()),
          r.xml.number(node, "stiffness", 0.0),
          r.xml.number(node, "rest_length", 0.0)};
}

/// The class's own curve of force (over pcsa_force) by length (over resting length).
Function default_ligament_curve() {
  return make_simm_spline(
      {-5.0, 0.998, 0.999, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.601, 1.602, 5.0},
      {0.0, 0.0, 0.0, 0.0, 0.035, 0.12, 0.26, 0.55, 1.17, 2.0, 2.0, 2.0, 2.0});
}

void read_force(OsimReading& r, pugi::xml_node node) {
  const std::string kind = node.name();
  const std::string name = OsimXml::name_of(node);
  const auto passive = [&](auto law) {
    if (is_enabled(r, node, "appliesForce"))
      r.model.passive_forces.push_back({name, kind, std::move(law)});
  };
  const auto coordinate = [&] { return coordinate_named(r, node, r.xml.word(node, "coordinate")); };
  if (is_muscle(node)) {
    r.model.muscles.push_back(read_muscle(r, node));
  } else if (kind == "CoordinateActuator" || kind == "GeneralizedForce" ||
             kind == "ActivationCoordinateActuator") {
    CoordinateActuator actuator;
    read_common(r, node, actuator);
    std::string target = r.xml.word(node, "coordinate");
    if (target.empty()) target = socket(r, node, "coordinate");
    actuator.coordinate = coordinate_named(r, node, target);
    r.model.actuators.push_back(std::move(actuator));
  } else if (kind == "PointActuator" || kind == "Force") {
    PointActuator actuator;
    read_common(r, node, actuator);
    actuator.body = resolve_frame(r, node, r.xml.word(node, "body"), "").body;
    actuator.point = r.xml.vec3(node, "point", Vec3::Zero());
    actuator.point_is_global = r.xml.flag(node, "point_is_global", false);
    actuator.direction = unit(r, node, "direction", Vec3::UnitX());
    actuator.force_is_global = r.xml.flag(node, "force_is_global", false);
    r.model.point_actuators.push_back(std::move(actuator));
  } else if (kind == "TorqueActuator" || kind == "Torque") {
    TorqueActuator actuator;
    read_common(r, node, actuator);
    const auto body = [&](const char* new_name, const char* old_name) {
      std::string target = r.xml.word(node, new_name);
      if (target.empty()) target = r.xml.word(node, old_name);
      return target.empty() ? 0 : resolve_frame(r, node, target, "").body;
    };
    actuator.body_a = body("bodyA", "body_A");
    actuator.body_b = body("bodyB", "body_B");
    actuator.axis = unit(r, node, "axis", Vec3::UnitZ());
    actuator.torque_is_global = r.xml.flag(node, "torque_is_global", true);
    r.model.torque_actuators.push_back(std::move(actuator));
  } else if (kind == "CoordinateLimitForce") {
    passive(read_limit(r, node, coordinate()));
  } else if (kind == "SpringGeneralizedForce") {
    passive(CoordinateSpring{coordinate(), r.xml.number(node, "stiffness", 0.0),
                             r.xml.number(node, "rest_length", 0.0),
                             r.xml.number(node, "viscosity", 0.0)});
  } else if (kind == "BushingForce") {
    passive(read_bushing(r, node));
  } else if (kind == "PointToPointSpring") {
    passive(read_point_spring(r, node));
  } else if (kind == "PathSpring") {
    passive(PathSpring{read_path(r, node), r.xml.number(node, "stiffness", 0.0),
                       r.xml.number(node, "resting_length", 0.0),
                       r.xml.number(node, "dissipation", 0.0)});
  } else if (kind == "Ligament") {
    Ligament ligament{read_path(r, node), r.xml.number(node, "resting_length", 0.0),
                      r.xml.number(node, "pcsa_force", 0.0), default_ligament_curve()};
    if (!(ligament.rest_length_m > 0.0)) {
      r.model.unsupported.push_back(fmt::format(
          "Ligament '{}' has no <resting_length> above 0; it is left out of inverse dynamics",
          name));
      return;
    }
    if (auto curve = function_in(r, r.xml.property(node, "force_length_curve")))
      ligament.force_length = std::move(*curve);
    passive(std::move(ligament));
  } else if (is_enabled(r, node, "appliesForce")) {
    r.model.unsupported.push_back(
        fmt::format("force '{}' of kind {} is not part of inverse dynamics here", name, kind));
  }
}

}  // namespace

void read_forces(OsimReading& r, pugi::xml_node set) {
  for (const auto node : OsimXml::objects(set)) {
    if (node.type() != pugi::node_element) continue;
    const auto count = [&] {
      return r.model.muscles.size() + r.model.actuators.size() + r.model.point_actuators.size() +
             r.model.torque_actuators.size() + r.model.passive_forces.size();
    };
    const std::size_t before = count();
    read_force(r, node);
    if (count() > before) r.model.force_order.push_back(OsimXml::name_of(node));
  }
}

void read_constraints(OsimReading& r, pugi::xml_node set) {
  for (const auto node : OsimXml::objects(set)) {
    if (node.type() != pugi::node_element || !is_enabled(r, node, "isEnforced")) continue;
    const std::string kind = node.name();
    const std::string name = OsimXml::name_of(node);
    const std::string owner = "/constraintset/" + name;
    if (kind == "CoordinateCouplerConstraint") {
      const auto independent = r.xml.words(node, "independent_coordinate_names");
      const auto function = function_in(r, r.xml.property(node, "coupled_coordinates_function"));
      if (independent.size() != 1 || !function) {
        r.model.unsupported.push_back(
            fmt::format("constraint '{}' couples {} independent coordinates; it is not enforced",
                        name, independent.size()));
        continue;
      }
      CoordinateCoupler coupler;
      coupler.name = name;
      coupler.independent = coordinate_named(r, node, independent[0]);
      coupler.dependent = coordinate_named(r, node, r.xml.word(node, "dependent_coordinate_name"));
      coupler.function = *function;
      coupler.function.scale *= r.xml.number(node, "scale_factor", 1.0);
      if (coupler.independent == coupler.dependent)
        r.xml.fail(node, fmt::format("constraint '{}' couples a coordinate with itself", name));
      for (const CoordinateCoupler& other : r.model.couplers) {
        if (other.dependent == coupler.dependent) {
          r.xml.fail(
              node,
              fmt::format("constraints '{}' and '{}' both set coordinate '{}'", other.name, name,
                          r.model.coordinates[static_cast<std::size_t>(coupler.dependent)].name));
        }
      }
      r.model.couplers.push_back(std::move(coupler));
    } else if (kind == "WeldConstraint") {
      const auto [first, second] = two_frames(r, node);
      r.model.constraints.push_back(
          {name, kind, FrameConstraint{first.body, second.body, first.X_BF, second.X_BF, true}});
    } else if (kind == "PointConstraint") {
      const FixedFrame first = frame_of(r, node, "body_1", owner, "body_1");
      const FixedFrame second = frame_of(r, node, "body_2", owner, "body_2");
      FrameConstraint law{first.body, second.body, first.X_BF, second.X_BF, false};
      law.X_BF1.p = first.X_BF * r.xml.vec3(node, "location_body_1", Vec3::Zero());
      law.X_BF2.p = second.X_BF * r.xml.vec3(node, "location_body_2", Vec3::Zero());
      r.model.constraints.push_back({name, kind, law});
    } else if (kind == "ConstantDistanceConstraint") {
      const FixedFrame first = frame_of(r, node, "body_1", owner, "body_1");
      const FixedFrame second = frame_of(r, node, "body_2", owner, "body_2");
      r.model.constraints.push_back(
          {name, kind,
           DistanceConstraint{first.body, second.body,
                              first.X_BF * r.xml.vec3(node, "location_body_1", Vec3::Zero()),
                              second.X_BF * r.xml.vec3(node, "location_body_2", Vec3::Zero()),
                              r.xml.number(node, "constant_distance", 0.0)}});
    } else if (kind == "PointOnLineConstraint") {
      const FixedFrame line = frame_of(r, node, "line_body", owner, "line_body");
      const FixedFrame follower = frame_of(r, node, "follower_body", owner, "follower_body");
      r.model.constraints.push_back(
          {name, kind,
           LineConstraint{line.body, follower.body,
                          line.X_BF.R * unit(r, node, "line_direction_vec", Vec3::UnitX()),
                          line.X_BF * r.xml.vec3(node, "point_on_line", Vec3::Zero()),
                          follower.X_BF * r.xml.vec3(node, "point_on_follower", Vec3::Zero())}});
    } else {
      r.model.unsupported.push_back(
          fmt::format("constraint '{}' of kind {} is not enforced", name, kind));
    }
  }
}

}  // namespace myoid::model
