#include "myoid/contents/model_contents.h"

#include <string>

#include <fmt/format.h>

#include "myoid/core/units.h"
#include "myoid/model/path_survey.h"

namespace myoid {

using nlohmann::ordered_json;

namespace {

/// Muscles whose exact paths differ from OpenSim's, and by how much.
ordered_json differences_json(const model::BodyModel& m, int postures, std::uint64_t seed) {
  ordered_json list = ordered_json::array();
  for (const model::PathDifference& d : model::compare_with_opensim(m, postures, seed)) {
    list.push_back(
        fmt::format("{}: length by up to {:.3g} mm (rms {:.3g} mm, above 1 mm in {} of {} postures), moment "
                    "arm "
                    "by up to {:.3g} mm",
                    m.muscles[static_cast<std::size_t>(d.muscle)].name, 1e3 * d.length_m, 1e3 * d.typical_length_m,
                    d.postures_above_1mm, postures, 1e3 * d.moment_arm_m));
  }
  return list;
}

ordered_json jumps_json(const model::BodyModel& m) {
  ordered_json list = ordered_json::array();
  for (const model::PathJump& jump : model::find_jumps(m)) list.push_back(model::describe(m, jump));
  return list;
}

/// Returns the unit of a coordinate's values in files. A coordinate that turns a body by another law than its own
/// angle, or that follows an angle, is in radians there, whatever OpenSim calls its motion.
std::string unit_of(const model::BodyModel& m, int index) {
  const model::Coordinate& c = m.coordinates[static_cast<std::size_t>(index)];
  if (c.motion == model::MotionType::rotational) return "deg";
  for (const model::TransformAxis& axis : m.joints[static_cast<std::size_t>(c.joint)].rotation)
    if (axis.coordinate == index) return "rad";
  for (const model::CoordinateCoupler& coupler : m.couplers) {
    const auto leader = static_cast<std::size_t>(coupler.independent);
    if (coupler.dependent == index && m.coordinates[leader].motion == model::MotionType::rotational) return "rad";
  }
  return c.motion == model::MotionType::translational ? "m" : "coupled";
}

}  // namespace

ordered_json model_contents(const model::BodyModel& m, const ModelQuestions& ask) {
  ordered_json j{{"kind", "OpenSim model"}, {"name", m.name}};
  double mass = 0.0;
  for (std::size_t b = 1; b < m.bodies.size(); ++b) {
    mass += m.bodies[b].mass_kg;
    j["bodies"].push_back(fmt::format("{} ({:.4g} kg)", m.bodies[b].name, m.bodies[b].mass_kg));
  }
  j["mass_kg"] = mass;
  j["gravity_mps2"] = {m.gravity_G.x(), m.gravity_G.y(), m.gravity_G.z()};
  for (const model::Joint& joint : m.joints) {
    j["joints"].push_back(fmt::format("{} ({}): {} -> {}", joint.name, joint.class_name,
                                      m.bodies[static_cast<std::size_t>(joint.parent)].name,
                                      m.bodies[static_cast<std::size_t>(joint.child)].name));
  }
  for (std::size_t k = 0; k < m.coordinates.size(); ++k) {
    const model::Coordinate& c = m.coordinates[k];
    const bool angle = c.motion == model::MotionType::rotational;
    const double scale = angle ? 1.0 / kDegree : 1.0;
    j["coordinates"].push_back(fmt::format("{} [{}] {:.4g} to {:.4g}{}", c.name, unit_of(m, static_cast<int>(k)),
                                           c.lower * scale, c.upper * scale, c.locked ? ", locked" : ""));
  }
  j["muscles"] = ordered_json::array();
  for (const model::Muscle& muscle : m.muscles) {
    j["muscles"].push_back(fmt::format(
        "{} ({}): F_max {:.4g} N, l0 {:.4g} m, tendon {:.4g} m, {} points, {} wraps", muscle.name, muscle.class_name,
        muscle.properties.max_isometric_force_n, muscle.properties.optimal_fiber_length_m,
        muscle.properties.tendon_slack_length_m, muscle.path.points.size(), muscle.path.wraps.size()));
  }
  for (const model::Marker& marker : m.markers) j["markers"].push_back(marker.name);
  j["document_version"] = m.document_version;
  for (const model::CoordinateCoupler& c : m.couplers) {
    j["couplers"].push_back(fmt::format("{}: {} follows {}", c.name,
                                        m.coordinates[static_cast<std::size_t>(c.dependent)].name,
                                        m.coordinates[static_cast<std::size_t>(c.independent)].name));
  }
  for (const model::LoopConstraint& c : m.constraints)
    j["constraints"].push_back(fmt::format("{} ({})", c.name, c.class_name));
  for (const model::CoordinateActuator& a : m.actuators) j["actuators"].push_back(a.name);
  for (const model::PointActuator& a : m.point_actuators) j["actuators"].push_back(a.name);
  for (const model::TorqueActuator& a : m.torque_actuators) j["actuators"].push_back(a.name);
  for (const model::PathActuator& a : m.path_actuators) j["actuators"].push_back(a.name);
  for (const model::PassiveForce& f : m.passive_forces)
    j["passive_forces"].push_back(fmt::format("{} ({})", f.name, f.class_name));
  if (ask.compare_compat) j["differs_from_opensim"] = differences_json(m, ask.postures, ask.seed);
  if (ask.jumps) j["jumps"] = jumps_json(m);
  j["not_supported_count"] = m.unsupported.size();
  j["not_supported"] = m.unsupported;
  j["notes"] = m.notes;
  return j;
}

}  // namespace myoid
