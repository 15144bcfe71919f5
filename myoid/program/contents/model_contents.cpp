#include "myoid/program/contents/model_contents.h"

#include <string>

#include "myoid/body/model/path_survey.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/core/json_array.h"
#include "myoid/ground/core/units.h"

namespace myoid::program {

using nlohmann::ordered_json;

namespace {

/// Muscles whose exact paths differ from OpenSim's, and by how much.
ordered_json differences_json(const body::BodyModel& m, int postures, std::uint64_t seed) {
  return array_of(body::compare_with_opensim(m, postures, seed), [&](const body::PathDifference& d) {
    return ordered_json{{"name", m.muscles[at(d.muscle)].name},
                        {"greatest_length_m", d.length_m},
                        {"rms_length_m", d.typical_length_m},
                        {"greatest_moment_arm_m", d.moment_arm_m},
                        {"postures", postures},
                        {"postures_above_1mm", d.postures_above_1mm}};
  });
}

/// Places at which a muscle's length or moment arm jumps, and by how much.
ordered_json jumps_json(const body::BodyModel& m) {
  return array_of(body::find_jumps(m), [&](const body::PathJump& jump) {
    const body::Coordinate& c = m.coordinates[at(jump.coordinate)];
    const bool angle = c.motion == body::MotionType::rotational;
    return ordered_json{{"name", m.muscles[at(jump.muscle)].name},
                        {"coordinate", c.name},
                        {angle ? "at_deg" : "at_m", angle ? jump.at / kDegree : jump.at},
                        {"length_m", jump.length_m},
                        {"moment_arm_m", jump.moment_arm_m}};
  });
}

/// Returns the unit of a coordinate's values in files. A coordinate that turns a body by another law than its own
/// angle, or that follows an angle, is in radians there, whatever OpenSim calls its motion.
std::string unit_of(const body::BodyModel& m, int index) {
  const body::Coordinate& c = m.coordinates[at(index)];
  if (c.motion == body::MotionType::rotational) return "deg";
  for (const body::TransformAxis& axis : m.joints[at(c.joint)].rotation)
    if (axis.coordinate == index) return "rad";
  for (const body::CoordinateCoupler& coupler : m.couplers) {
    const auto leader = at(coupler.independent);
    if (coupler.dependent == index && m.coordinates[leader].motion == body::MotionType::rotational) return "rad";
  }
  return c.motion == body::MotionType::translational ? "m" : "coupled";
}

}  // namespace

ordered_json model_contents(const body::BodyModel& m, const ModelQuestions& ask) {
  ordered_json j{{"kind", "OpenSim model"}, {"name", m.name}};
  double mass = 0.0;
  for (std::size_t b = 1; b < m.bodies.size(); ++b) {
    mass += m.bodies[b].mass_kg;
    j["bodies"].push_back({{"name", m.bodies[b].name}, {"mass_kg", m.bodies[b].mass_kg}});
  }
  j["mass_kg"] = mass;
  j["gravity_mps2"] = {m.gravity_G.x(), m.gravity_G.y(), m.gravity_G.z()};
  for (const body::Joint& joint : m.joints)
    j["joints"].push_back({{"name", joint.name},
                           {"class", joint.class_name},
                           {"parent", m.bodies[at(joint.parent)].name},
                           {"child", m.bodies[at(joint.child)].name}});
  for (std::size_t k = 0; k < m.coordinates.size(); ++k) {
    const body::Coordinate& c = m.coordinates[k];
    const double scale = c.motion == body::MotionType::rotational ? 1.0 / kDegree : 1.0;
    j["coordinates"].push_back({{"name", c.name},
                                {"unit", unit_of(m, static_cast<int>(k))},
                                {"lower", c.lower * scale},
                                {"upper", c.upper * scale},
                                {"locked", c.locked}});
  }
  j["muscles"] = array_of(m.muscles, [](const body::Muscle& muscle) {
    return ordered_json{{"name", muscle.name},
                        {"class", muscle.class_name},
                        {"max_isometric_force_n", muscle.properties.max_isometric_force_n},
                        {"optimal_fiber_length_m", muscle.properties.optimal_fiber_length_m},
                        {"tendon_slack_length_m", muscle.properties.tendon_slack_length_m},
                        {"points", muscle.path.points.size()},
                        {"wraps", muscle.path.wraps.size()}};
  });
  const auto add_names = [&j](const char* key, const auto& parts) {
    for (const auto& part : parts) j[key].push_back(part.name);
  };
  const auto add_classes = [&j](const char* key, const auto& parts) {
    for (const auto& part : parts) j[key].push_back({{"name", part.name}, {"class", part.class_name}});
  };
  add_names("markers", m.markers);
  j["document_version"] = m.document_version;
  for (const body::CoordinateCoupler& c : m.couplers)
    j["couplers"].push_back({{"name", c.name},
                             {"dependent", m.coordinates[at(c.dependent)].name},
                             {"independent", m.coordinates[at(c.independent)].name}});
  add_classes("constraints", m.constraints);
  add_names("actuators", m.actuators);
  add_names("actuators", m.point_actuators);
  add_names("actuators", m.torque_actuators);
  add_names("actuators", m.path_actuators);
  add_classes("passive_forces", m.passive_forces);
  if (ask.compare_compat) j["differs_from_opensim"] = differences_json(m, ask.postures, ask.seed);
  if (ask.jumps) j["jumps"] = jumps_json(m);
  j["not_supported_count"] = m.unsupported.size();
  j["not_supported"] = m.unsupported;
  j["notes"] = sentences(m.notes);
  return j;
}

}  // namespace myoid::program
