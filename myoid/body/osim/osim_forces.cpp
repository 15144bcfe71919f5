#include <utility>

#include "myoid/body/osim/osim_parts.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/units.h"

namespace myoid::body {
namespace {

void read_common(const OsimReading& r, pugi::xml_node node, ActuatorBase& actuator) {
  actuator.name = OsimXml::name_of(node);
  actuator.optimal_force = r.xml.number(node, "optimal_force", 1.0);
  actuator.min_control = r.xml.number(node, "min_control", actuator.min_control);
  actuator.max_control = r.xml.number(node, "max_control", actuator.max_control);
  actuator.applies_force = r.xml.flag(node, "appliesForce", true);
}

CoordinateLimitForce read_limit(const OsimReading& r, pugi::xml_node node, int coordinate) {
  CoordinateLimitForce f;
  f.coordinate = coordinate;
  const bool angle = r.model.coordinates[at(coordinate)].motion == MotionType::rotational;
  const double unit_rad = angle ? kDegree : 1.0;  // limits in degrees, stiffness per degree
  f.upper_limit = unit_rad * r.xml.number(node, "upper_limit", 0.0);
  f.lower_limit = unit_rad * r.xml.number(node, "lower_limit", 0.0);
  f.upper_stiffness = r.xml.number(node, "upper_stiffness", 1.0) / unit_rad;
  f.lower_stiffness = r.xml.number(node, "lower_stiffness", 1.0) / unit_rad;
  f.damping = r.xml.number(node, "damping", 0.001) / unit_rad;
  f.transition = unit_rad * r.xml.number(node, "transition", 0.1);
  if (!(f.transition > 0.0))
    r.xml.fail(node, "CoordinateLimitForce '{}': expected <transition> above 0", OsimXml::name_of(node));
  return f;
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

/// Reads the formula of a property; throws for a formula that cannot be read.
Expression formula_of(const OsimReading& r,
                      pugi::xml_node node,
                      const char* name,
                      const std::vector<std::string>& variables) {
  const std::string text = r.xml.word(node, name);
  try {
    return text.empty() ? Expression() : Expression(text, variables);
  } catch (const InvalidInput& error) {
    r.xml.fail(node, "{} '{}': <{}>: {}", node.name(), OsimXml::name_of(node), name, error.what());
  }
}

/// Reads a bushing whose forces are functions or formulas of its deflections.
Bushing read_shaped_bushing(OsimReading& r, pugi::xml_node node) {
  constexpr const char* kComponents[] = {"m_x_theta_x_function", "m_y_theta_y_function", "m_z_theta_z_function",
                                         "f_x_delta_x_function", "f_y_delta_y_function", "f_z_delta_z_function"};
  constexpr const char* kFormulas[] = {"Mx_expression", "My_expression", "Mz_expression",
                                       "Fx_expression", "Fy_expression", "Fz_expression"};
  Bushing bushing = read_bushing(r, node);
  bushing.rotational_stiffness = bushing.translational_stiffness = Vec3::Zero();
  if (std::string_view(node.name()) == "ExpressionBasedBushingForce") {
    for (const char* name : kFormulas)
      bushing.formulas.push_back(
          formula_of(r, node, name, {"theta_x", "theta_y", "theta_z", "delta_x", "delta_y", "delta_z"}));
    return bushing;
  }
  for (const char* name : kComponents)
    bushing.functions.push_back(function_property(r, node, name).value_or(Function(Constant{0.0})));
  if (r.compat.opensim_paths &&
      (!bushing.rotational_damping.isZero(0.0) || !bushing.translational_damping.isZero(0.0))) {
    r.note("FunctionBasedBushingForce '{}': its damping does not act, as in OpenSim 4.5.2", OsimXml::name_of(node));
    bushing.rotational_damping = bushing.translational_damping = Vec3::Zero();
  }
  return bushing;
}

PrescribedForce read_prescribed(OsimReading& r, pugi::xml_node node) {
  PrescribedForce f;
  const FixedFrame frame = frame_of(r, node, "frame", "/forceset/" + OsimXml::name_of(node));
  f.body = frame.body;
  f.X_BF = frame.X_BF;
  f.point_is_global = r.xml.flag(node, "pointIsGlobal", false);
  f.force_is_global = r.xml.flag(node, "forceIsGlobal", true);
  const auto three = [&](const char* name) {
    std::vector<Function> functions = functions_property(r, node, name);
    if (!functions.empty() && functions.size() != 3) {
      r.xml.fail(node, "PrescribedForce '{}': <{}> has {} functions, expected three or none", OsimXml::name_of(node),
                 name, functions.size());
    }
    return functions;
  };
  f.force = three("forceFunctions");
  f.point = three("pointFunctions");
  f.torque = three("torqueFunctions");
  return f;
}

PointSpring read_point_spring(const OsimReading& r, pugi::xml_node node) {
  const std::string owner = "/forceset/" + OsimXml::name_of(node);
  const BodyPoint first = point_of(r, node, owner, "body1", "point1");
  const BodyPoint second = point_of(r, node, owner, "body2", "point2");
  return {first.body,
          second.body,
          first.p_B,
          second.p_B,
          r.xml.number(node, "stiffness", 0.0),
          r.xml.number(node, "rest_length", 0.0)};
}

/// Returns the class's default curve of force (over pcsa_force) by length (over resting length).
Function default_ligament_curve() {
  return make_simm_spline({-5.0, 0.998, 0.999, 1.0, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.601, 1.602, 5.0},
                          {0.0, 0.0, 0.0, 0.0, 0.035, 0.12, 0.26, 0.55, 1.17, 2.0, 2.0, 2.0, 2.0});
}

int coordinate_of(const OsimReading& r, pugi::xml_node node) {
  std::string target = r.xml.word(node, "coordinate");
  if (target.empty()) target = socket(r, node, "coordinate");
  return coordinate_named(r, node, target);
}

PointActuator read_point_actuator(const OsimReading& r, pugi::xml_node node) {
  PointActuator actuator;
  read_common(r, node, actuator);
  actuator.body = resolve_frame(r, node, r.xml.word(node, "body"), "").body;
  actuator.point = r.xml.vec3(node, "point", Vec3::Zero());
  actuator.point_is_global = r.xml.flag(node, "point_is_global", false);
  actuator.direction = direction_of(r, node, "direction", Vec3::UnitX());
  actuator.force_is_global = r.xml.flag(node, "force_is_global", false);
  return actuator;
}

TorqueActuator read_torque_actuator(const OsimReading& r, pugi::xml_node node) {
  TorqueActuator actuator;
  read_common(r, node, actuator);
  const auto body = [&](const char* name) {
    const std::string target = r.xml.word(node, name);
    return target.empty() ? 0 : resolve_frame(r, node, target, "").body;
  };
  actuator.body_a = body("bodyA");
  actuator.body_b = body("bodyB");
  actuator.axis = direction_of(r, node, "axis", Vec3::UnitZ());
  actuator.torque_is_global = r.xml.flag(node, "torque_is_global", true);
  return actuator;
}

/// Reads a muscle or an actuator; false for another class.
bool read_driven(OsimReading& r, pugi::xml_node node) {
  const std::string_view kind = node.name();
  if (is_muscle(node)) {
    r.model.muscles.push_back(read_muscle(r, node));
  } else if (kind == "CoordinateActuator" || kind == "ActivationCoordinateActuator") {
    CoordinateActuator actuator;
    read_common(r, node, actuator);
    actuator.coordinate = coordinate_of(r, node);
    r.model.actuators.push_back(std::move(actuator));
  } else if (kind == "PointActuator") {
    r.model.point_actuators.push_back(read_point_actuator(r, node));
  } else if (kind == "TorqueActuator") {
    r.model.torque_actuators.push_back(read_torque_actuator(r, node));
  } else if (kind == "PathActuator") {
    PathActuator actuator;
    read_common(r, node, actuator);
    actuator.path = read_path(r, node);
    r.model.path_actuators.push_back(std::move(actuator));
  } else if (kind == "BodyActuator") {
    // Six controls without bounds: OpenSim's tools that solve for controls ignore them.
    r.note("BodyActuator '{}' makes no force: every tool keeps its six controls at zero", OsimXml::name_of(node));
  } else {
    return false;
  }
  return true;
}

/// Returns the law of a ligament; empty, with a note in `unsupported`, without a resting length.
std::optional<Ligament> read_ligament(OsimReading& r, pugi::xml_node node) {
  Ligament ligament{read_path(r, node), r.xml.number(node, "resting_length", 0.0),
                    r.xml.number(node, "pcsa_force", 0.0), default_ligament_curve()};
  if (!(ligament.rest_length_m > 0.0)) {
    r.leave_out("Ligament '{}' has no <resting_length> above 0; it is left out of inverse dynamics",
                OsimXml::name_of(node));
    return std::nullopt;
  }
  if (auto curve = function_property(r, node, "force_length_curve")) ligament.force_length = std::move(*curve);
  return ligament;
}

/// Reads a passive force; false for another class.
bool read_passive(OsimReading& r, pugi::xml_node node) {
  const std::string kind = node.name();
  const auto add = [&](auto law) {
    if (r.xml.flag(node, "appliesForce", true))
      r.model.passive_forces.push_back({OsimXml::name_of(node), kind, std::move(law)});
  };
  if (kind == "CoordinateLimitForce") {
    add(read_limit(r, node, coordinate_of(r, node)));
  } else if (kind == "SpringGeneralizedForce") {
    add(CoordinateSpring{coordinate_of(r, node), r.xml.number(node, "stiffness", 0.0),
                         r.xml.number(node, "rest_length", 0.0), r.xml.number(node, "viscosity", 0.0)});
  } else if (kind == "ExpressionBasedCoordinateForce") {
    add(CoordinateFormula{coordinate_of(r, node), formula_of(r, node, "expression", {"q", "qdot"})});
  } else if (kind == "BushingForce") {
    add(read_bushing(r, node));
  } else if (kind == "FunctionBasedBushingForce" || kind == "ExpressionBasedBushingForce") {
    add(read_shaped_bushing(r, node));
  } else if (kind == "ExpressionBasedPointToPointForce") {
    const PointSpring ends = read_point_spring(r, node);
    add(PointFormula{ends.body1, ends.body2, ends.p_B1, ends.p_B2, formula_of(r, node, "expression", {"d", "ddot"})});
  } else if (kind == "PrescribedForce") {
    add(read_prescribed(r, node));
  } else if (kind == "HuntCrossleyForce" || kind == "SmoothSphereHalfSpaceForce") {
    if (r.xml.flag(node, "appliesForce", true)) {
      for (Contact& contact : read_contacts(r, node)) add(std::move(contact));
    }
  } else if (kind == "PointToPointSpring") {
    add(read_point_spring(r, node));
  } else if (kind == "PathSpring") {
    add(PathSpring{read_path(r, node), r.xml.number(node, "stiffness", 0.0), r.xml.number(node, "resting_length", 0.0),
                   r.xml.number(node, "dissipation", 0.0)});
  } else if (kind == "Ligament") {
    if (auto ligament = read_ligament(r, node)) add(std::move(*ligament));
  } else {
    return false;
  }
  return true;
}

void read_law(OsimReading& r, pugi::xml_node node) {
  const std::string kind = node.name();
  const std::string name = OsimXml::name_of(node);
  if (const std::string path = foreign_path(r, node); !path.empty()) {
    r.leave_out("{} '{}' has a path of kind {}, which is not supported: it is left out", kind, name, path);
  } else if (!read_driven(r, node) && !read_passive(r, node) && r.xml.flag(node, "appliesForce", true)) {
    r.leave_out("force '{}' of kind {} is not part of inverse dynamics here", name, kind);
  }
}

}  // namespace

void read_force(OsimReading& r, pugi::xml_node node) {
  const auto count = [&] {
    std::size_t sum = r.model.muscles.size() + r.model.passive_forces.size();
    visit_actuators(r.model, [&](const auto& list) { sum += list.size(); });
    return sum;
  };
  const std::size_t before = count();
  read_law(r, node);
  if (count() > before) r.model.force_order.push_back(OsimXml::name_of(node));
}

void read_forces(OsimReading& r, pugi::xml_node set) {
  for (const auto node : OsimXml::objects(set)) read_force(r, node);
}

void read_component_force(OsimReading& r, pugi::xml_node node) {
  const std::string_view kind = node.name();
  if (kind.ends_with("Force") || kind.ends_with("Actuator") || kind.ends_with("Spring") || kind == "Ligament" ||
      is_muscle(node))
    read_force(r, node);
}

}  // namespace myoid::body
