#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/index.h"
#include "myoid/model/constraints.h"
#include "myoid/model/kinematic_tree.h"
#include "myoid/pipeline/analysis_reports.h"
#include "myoid/pipeline/opensim_files.h"
#include "myoid/recording/text_file.h"

namespace myoid::pipeline {
namespace {

constexpr const char* kWholeBody = "center_of_mass";

/// Body-fixed X-Y-Z angles.
Vec3 angles_of(const Mat3& R) {
  return {std::atan2(-R(1, 2), R(2, 2)), std::asin(std::clamp(R(0, 2), -1.0, 1.0)),
          std::atan2(-R(0, 1), R(0, 0))};
}

struct Wanted {
  std::vector<model::BodyIndex> bodies;
  bool whole_body = false;
};

Wanted wanted_bodies(AnalysisRun& run, pugi::xml_node node) {
  const model::BodyModel& model = run.model;
  Wanted wanted;
  std::vector<std::string> names = run.setup.xml().words(node, "bodies");
  if (names.empty()) names.push_back("all");
  for (const std::string& name : names) {
    if (recording::equal_ignoring_case(name, "all")) {
      wanted.bodies.clear();
      for (std::size_t b = 1; b < model.bodies.size(); ++b)
        wanted.bodies.push_back(static_cast<model::BodyIndex>(b));
      wanted.whole_body = true;
      break;
    }
    if (name == kWholeBody) {
      wanted.whole_body = true;
    } else if (const auto body = model.find_body(name)) {
      wanted.bodies.push_back(*body);
    } else {
      run.setup.xml().fail(node,
                           fmt::format("<bodies>: the model has no body '{}'; expected bodies, "
                                       "{}, or all",
                                       name, kWholeBody));
    }
  }
  return wanted;
}

}  // namespace

void report_bodies(AnalysisRun& run, pugi::xml_node node) {
  const auto& xml = run.setup.xml();
  const model::BodyModel& model = run.model;
  const bool in_degrees = xml.flag(node, "in_degrees", true);
  const bool local = xml.flag(node, "express_results_in_body_local_frame", false);
  const Wanted wanted = wanted_bodies(run, node);
  std::vector<Channel> channels;
  for (const model::BodyIndex b : wanted.bodies) {
    for (const char* part : {"_X", "_Y", "_Z"})
      channels.push_back({model.bodies[at(b)].name + part, Unit::meter});
    for (const char* part : {"_Ox", "_Oy", "_Oz"})
      channels.push_back({model.bodies[at(b)].name + part, Unit::radian});
  }
  if (wanted.whole_body) {
    for (const char* part : {"_X", "_Y", "_Z"})
      channels.push_back({std::string(kWholeBody) + part, Unit::meter});
  }
  if (channels.empty()) xml.fail(node, "BodyKinematics: there are no bodies to report");
  const Eigen::Index frames = run.motion.sample_count();
  const auto count = static_cast<Eigen::Index>(channels.size());
  Eigen::MatrixXd position(frames, count), velocity(frames, count);
  model::BodyState state = model::make_state(model);
  const bool is_coupled = !model.couplers.empty() || !model.constraints.empty();
  for (Eigen::Index i = 0; i < frames; ++i) {
    Eigen::VectorXd q = run.motion.q.values().row(i).transpose();
    if (is_coupled) q = model::assemble(model, q).q;
    model::compute_poses(model, q, state);
    model::compute_velocities(model, run.motion.qdot.values().row(i).transpose(), state);
    const auto center = [&](std::size_t b) {
      return Vec3(state.X_GB[b] * model.bodies[b].p_BBcm_B);
    };
    const auto center_velocity = [&](std::size_t b) {
      return Vec3(state.v_GB[b] + state.w_GB[b].cross(center(b) - state.X_GB[b].p));
    };
    Eigen::Index column = 0;
    for (const model::BodyIndex body : wanted.bodies) {
      const std::size_t b = at(body);
      const Mat3& R = state.X_GB[b].R;
      const Vec3 v = center_velocity(b);
      position.row(i).segment<3>(column) = center(b).transpose();
      position.row(i).segment<3>(column + 3) = angles_of(R).transpose();
      velocity.row(i).segment<3>(column) = (local ? Vec3(R.transpose() * v) : v).transpose();
      velocity.row(i).segment<3>(column + 3) =
          (local ? Vec3(R.transpose() * state.w_GB[b]) : state.w_GB[b]).transpose();
      column += 6;
    }
    if (!wanted.whole_body) continue;
    double mass = 0.0;
    Vec3 p = Vec3::Zero(), v = Vec3::Zero();
    for (std::size_t b = 1; b < model.bodies.size(); ++b) {
      mass += model.bodies[b].mass_kg;
      p += model.bodies[b].mass_kg * center(b);
      v += model.bodies[b].mass_kg * center_velocity(b);
    }
    position.row(i).segment<3>(column) = (p / mass).transpose();
    velocity.row(i).segment<3>(column) = (v / mass).transpose();
  }
  std::string name = model::OsimXml::name_of(node);
  if (name.empty()) name = node.name();
  const std::string description = fmt::format(
      "\nThis file contains the kinematics of the bodies' centers of mass and their orientations "
      "(body-fixed X-Y-Z Euler angles).\nVelocities are expressed in the {} frame.\n\nUnits are "
      "S.I. units (seconds, meters, Newtons, ...)\nAngles are in {}.\n\n",
      local ? "body's own" : "global", in_degrees ? "degrees" : "radians");
  const auto write = [&](const char* quantity, const char* title, Eigen::MatrixXd& values) {
    write_opensim_storage(claim_result(run, fmt::format("{}_{}_{}.sto", name, quantity,
                                                        local ? "bodyLocal" : "global")),
                          {run.motion.q.time_s(), channels, std::move(values)},
                          {.title = title,
                           .in_degrees = in_degrees,
                           .description = description,
                           .decimals = run.decimals});
  };
  write("pos", "Positions", position);
  write("vel", "Velocities", velocity);
  run.result.notes.push_back(
      fmt::format("{}: accelerations (_acc) are those of OpenSim's forward dynamics and are not "
                  "written",
                  name));
  run.result.frames = static_cast<int>(frames);
}

void report_point(AnalysisRun& run, pugi::xml_node node) {
  const auto& xml = run.setup.xml();
  const model::BodyModel& model = run.model;
  const auto body_of = [&](const char* property) {
    std::string name = xml.word(node, property);
    if (const auto slash = name.rfind('/'); slash != std::string::npos) name.erase(0, slash + 1);
    if (name.empty() || name == "Unassigned") name = "ground";
    const auto body = model.find_body(name);
    if (!body) xml.fail(node, fmt::format("<{}>: the model has no body '{}'", property, name));
    return at(*body);
  };
  const std::size_t body = body_of("body_name"), relative = body_of("relative_to_body_name");
  const Vec3 point = xml.vec3(node, "point", Vec3::Zero());
  std::string point_name = xml.word(node, "point_name");
  if (point_name.empty()) point_name = "NONAME";
  const Eigen::Index frames = run.motion.sample_count();
  Eigen::MatrixXd position(frames, 3), velocity(frames, 3);
  model::BodyState state = model::make_state(model);
  for (Eigen::Index i = 0; i < frames; ++i) {
    const Eigen::VectorXd q = model::assemble(model, run.motion.q.values().row(i).transpose()).q;
    model::compute_poses(model, q, state);
    model::compute_velocities(model, run.motion.qdot.values().row(i).transpose(), state);
    const Pose& X_GB = state.X_GB[body];
    const Vec3 v_G = state.v_GB[body] + state.w_GB[body].cross(X_GB.R * point);
    // Of the velocity only the axes are those of the other body.
    position.row(i) = (state.X_GB[relative].inverse() * (X_GB * point)).transpose();
    velocity.row(i) = (state.X_GB[relative].R.transpose() * v_G).transpose();
  }
  std::string name = model::OsimXml::name_of(node);
  if (name.empty()) name = node.name();
  const std::string description = fmt::format(
      "\nThis file contains the kinematics (position, velocity, or acceleration) of\npoint ({:f}, "
      "{:f}, {:f}) on the {} of model {}.\n\nUnits are S.I. units (seconds, meters, "
      "Newtons,...)\n\n",
      point[0], point[1], point[2], model.bodies[body].name, model.name);
  const auto write = [&](const char* quantity, const char* title, Unit unit,
                         Eigen::MatrixXd& values) {
    write_opensim_storage(
        claim_result(run, fmt::format("{}_{}_{}.sto", name, point_name, quantity)),
        {run.motion.q.time_s(),
         {{point_name + "_X", unit}, {point_name + "_Y", unit}, {point_name + "_Z", unit}},
         std::move(values)},
        {.title = title, .description = description, .decimals = run.decimals});
  };
  write("pos", "PointPosition", Unit::meter, position);
  write("vel", "PointVelocity", Unit::meter_per_second, velocity);
  run.result.notes.push_back(fmt::format(
      "{}: accelerations (_acc) are those of OpenSim's forward dynamics and are not written",
      name));
  run.result.frames = static_cast<int>(frames);
}

}  // namespace myoid::pipeline
