#include "myoid/contents/model_contents.h"

#include <string>

#include <fmt/format.h>

#include "myoid/core/index.h"
#include "myoid/core/json_array.h"
#include "myoid/core/units.h"
#include "myoid/model/path_survey.h"

namespace myoid {

using nlohmann::ordered_json;

namespace {

/// Muscles whose exact paths differ from OpenSim's, and by how much.
ordered_json differences_json(const model::BodyModel& m, int postures, std::uint64_t seed) {
  return array_of(model::compare_with_opensim(m, postures, seed), [&](const model::PathDifference& d) {
    return fmt::format(
        "{}: length by up to {:.3g} mm (rms {:.3g} mm, above 1 mm in {} of {} postures), moment arm by up to {:.3g} mm",
        m.muscles[at(d.muscle)].name, 1e3 * d.length_m, 1e3 * d.typical_length_m, d.postures_above_1mm, postures,
        1e3 * d.moment_arm_m);
  });
}

/// Returns the unit of a coordinate's values in files. A coordinate that turns a body by another law than its own
/// angle, or that follows an angle, is in radians there, whatever OpenSim calls its motion.
std::string unit_of(const model::BodyModel& m, int index) {
  const model::Coordinate& c = m.coordinates[at(index)];
  if (c.motion == model::MotionType::rotational) return "deg";
  for (const model::TransformAxis& axis : m.joints[at(c.joint)].rotation)
    if (axis.coordinate == index) return "rad";
  for (const model::CoordinateCoupler& coupler : m.couplers) {
    const auto leader = at(coupler.independent);
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
                                      m.bodies[at(joint.parent)].name, m.bodies[at(joint.child)].name));
  }
  for (std::size_t k = 0; k < m.coordinates.size(); ++k) {
    const model::Coordinate& c = m.coordinates[k];
    const bool angle = c.motion == model::MotionType::rotational;
    const double scale = angle ? 1.0 / kDegree : 1.0;
    j["coordinates"].push_back(fmt::format("{} [{}] {:.4g} to {:.4g}{}", c.name, unit_of(m, static_cast<int>(k)),
                                           c.lower * scale, c.upper * scale, c.locked ? ", locked" : ""));
  }
  j["muscles"] = array_of(m.muscles, [](const model::Muscle& muscle) {
    return fmt::format("{} ({}): F_max {:.4g} N, l0 {:.4g} m, tendon {:.4g} m, {} points, {} wraps", muscle.name,
                       muscle.class_name, muscle.properties.max_isometric_force_n,
                       muscle.properties.optimal_fiber_length_m, muscle.properties.tendon_slack_length_m,
                       muscle.path.points.size(), muscle.path.wraps.size());
  });
  const auto add_names = [&j](const char* key, const auto& parts) {
    for (const auto& part : parts) j[key].push_back(part.name);
  };
  add_names("markers", m.markers);
  j["document_version"] = m.document_version;
  for (const model::CoordinateCoupler& c : m.couplers) {
    j["couplers"].push_back(fmt::format("{}: {} follows {}", c.name, m.coordinates[at(c.dependent)].name,
                                        m.coordinates[at(c.independent)].name));
  }
  for (const model::LoopConstraint& c : m.constraints)
    j["constraints"].push_back(fmt::format("{} ({})", c.name, c.class_name));
  add_names("actuators", m.actuators);
  add_names("actuators", m.point_actuators);
  add_names("actuators", m.torque_actuators);
  add_names("actuators", m.path_actuators);
  for (const model::PassiveForce& f : m.passive_forces)
    j["passive_forces"].push_back(fmt::format("{} ({})", f.name, f.class_name));
  if (ask.compare_compat) j["differs_from_opensim"] = differences_json(m, ask.postures, ask.seed);
  if (ask.jumps)
    j["jumps"] = array_of(model::find_jumps(m), [&](const auto& jump) { return model::describe(m, jump); });
  j["not_supported_count"] = m.unsupported.size();
  j["not_supported"] = m.unsupported;
  j["notes"] = m.notes;
  return j;
}

}  // namespace myoid
