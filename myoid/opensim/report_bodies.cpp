#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/index.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/opensim/analysis_reports.h"
#include "myoid/opensim/moving_bodies.h"

namespace myoid::opensim {
namespace {

constexpr const char* kWholeBody = "center_of_mass";

/// Returns the body-fixed X-Y-Z angles [rad].
Vec3 angles_of(const Mat3& R) {
  return {std::atan2(-R(1, 2), R(2, 2)), std::asin(std::clamp(R(0, 2), -1.0, 1.0)), std::atan2(-R(0, 1), R(0, 0))};
}

struct Wanted {
  std::vector<body::BodyIndex> bodies;
  bool whole_body = false;
};

Wanted wanted_bodies(AnalysisRun& run, pugi::xml_node node) {
  const body::BodyModel& model = run.model;
  Wanted wanted;
  std::vector<std::string> names = run.setup.xml().words(node, "bodies");
  if (names.empty()) names.push_back("all");
  for (const std::string& name : names) {
    if (equal_ignoring_case(name, "all")) {
      wanted.bodies.clear();
      for (std::size_t b = 1; b < model.bodies.size(); ++b) wanted.bodies.push_back(static_cast<body::BodyIndex>(b));
      wanted.whole_body = true;
      break;
    }
    if (name == kWholeBody) {
      wanted.whole_body = true;
    } else if (const auto body = model.find_body(name)) {
      wanted.bodies.push_back(*body);
    } else {
      run.setup.xml().fail(node, "<bodies>: the model has no body '{}'; expected bodies, {}, or all", name, kWholeBody);
    }
  }
  return wanted;
}

std::vector<Channel> body_channels(const body::BodyModel& model, const Wanted& wanted) {
  std::vector<Channel> channels;
  const auto place = [&](const std::string& name) {
    for (const char* part : {"_X", "_Y", "_Z"}) channels.push_back({name + part, Unit::meter});
  };
  for (const body::BodyIndex b : wanted.bodies) {
    const std::string& name = model.bodies[at(b)].name;
    place(name);
    for (const char* part : {"_Ox", "_Oy", "_Oz"}) channels.push_back({name + part, Unit::radian});
  }
  if (wanted.whole_body) place(kWholeBody);
  return channels;
}

/// Tables of positions, velocities and accelerations, frames x columns.
using MotionTables = std::array<Eigen::MatrixXd, 3>;

/// Computes the tables. With `local` the velocities and accelerations of bodies are in their own axes.
MotionTables body_tables(
    MovingBodies& moving, const Wanted& wanted, bool local, Eigen::Index frames, Eigen::Index columns) {
  MotionTables tables;
  tables.fill(Eigen::MatrixXd(frames, columns));
  auto& [position, velocity, acceleration] = tables;
  for (Eigen::Index i = 0; i < frames; ++i) {
    moving.set(i);
    Eigen::Index column = 0;
    const auto fill = [&](Eigen::MatrixXd& table, Eigen::Index at_column, const Vec3& value) {
      table.row(i).segment<3>(at_column) = value.transpose();
    };
    for (const body::BodyIndex body : wanted.bodies) {
      const std::size_t b = at(body);
      const Mat3 axes = local ? Mat3(moving.pose(b).R.transpose()) : Mat3(Mat3::Identity());
      const body::PointMotion center = moving.center(b);
      fill(position, column, center.p);
      fill(velocity, column, axes * center.v);
      fill(acceleration, column, axes * center.a);
      fill(position, column + 3, angles_of(moving.pose(b).R));
      fill(velocity, column + 3, axes * moving.angular_velocity(b));
      fill(acceleration, column + 3, axes * moving.angular_acceleration(b));
      column += 6;
    }
    if (!wanted.whole_body) continue;
    const body::PointMotion center = moving.center_of_all();
    fill(position, column, center.p);
    fill(velocity, column, center.v);
    fill(acceleration, column, center.a);
  }
  return tables;
}

}  // namespace

void report_bodies(AnalysisRun& run, pugi::xml_node node) {
  const auto& xml = run.setup.xml();
  const bool in_degrees = xml.flag(node, "in_degrees", true);
  const bool local = xml.flag(node, "express_results_in_body_local_frame", false);
  const Wanted wanted = wanted_bodies(run, node);
  const std::vector<Channel> channels = body_channels(run.model, wanted);
  if (channels.empty()) xml.fail(node, "BodyKinematics: there are no bodies to report");
  const Eigen::MatrixXd* qddot = accelerations_of(run);
  MovingBodies moving(run.model, run.moved, qddot);
  MotionTables tables =
      body_tables(moving, wanted, local, run.motion.sample_count(), static_cast<Eigen::Index>(channels.size()));
  const std::string name = analysis_name(node);
  const std::string description = fmt::format(
      "\nThis file contains the kinematics of the bodies' centers of mass and their orientations "
      "(body-fixed X-Y-Z Euler angles).\nVelocities and accelerations are expressed in the {} "
      "frame.\n\nUnits are S.I. units (seconds, meters, Newtons, ...)\nAngles are in {}.\n\n",
      local ? "body's own" : "global", in_degrees ? "degrees" : "radians");
  const auto write = [&](const std::string& quantity, const char* title, Eigen::MatrixXd& values) {
    write_result(run, name + quantity + ".sto", {run.motion.q.time_s(), channels, std::move(values)},
                 {.title = title, .in_degrees = in_degrees, .description = description});
  };
  const std::string frame = local ? "_bodyLocal" : "_global";
  write("_pos_global", "Positions", tables[0]);  // places stay in ground
  write("_vel" + frame, "Velocities", tables[1]);
  if (qddot != nullptr) write("_acc" + frame, "Accelerations", tables[2]);
}

void report_point(AnalysisRun& run, pugi::xml_node node) {
  const auto& xml = run.setup.xml();
  const body::BodyModel& model = run.model;
  const auto body_of = [&](const char* property) {
    std::string name = xml.word(node, property);
    if (const auto slash = name.rfind('/'); slash != std::string::npos) name.erase(0, slash + 1);
    if (name.empty() || name == "Unassigned") name = "ground";
    const auto body = model.find_body(name);
    if (!body) xml.fail(node, "<{}>: the model has no body '{}'", property, name);
    return at(*body);
  };
  const std::size_t body = body_of("body_name"), relative = body_of("relative_to_body_name");
  const Vec3 point = xml.vec3(node, "point", Vec3::Zero());
  std::string point_name = xml.word(node, "point_name");
  if (point_name.empty()) point_name = "NONAME";
  const Eigen::Index frames = run.motion.sample_count();
  Eigen::MatrixXd position(frames, 3), velocity(frames, 3), acceleration(frames, 3);
  const Eigen::MatrixXd* qddot = accelerations_of(run);
  MovingBodies moving(run.model, run.moved, qddot);
  for (Eigen::Index i = 0; i < frames; ++i) {
    moving.set(i);
    const body::PointMotion motion = moving.point(body, point);
    const Pose& X_GR = moving.pose(relative);
    // The other body gives velocity and acceleration its axes only.
    position.row(i) = (X_GR.inverse() * motion.p).transpose();
    velocity.row(i) = (X_GR.R.transpose() * motion.v).transpose();
    acceleration.row(i) = (X_GR.R.transpose() * motion.a).transpose();
  }
  const std::string name = analysis_name(node);
  const std::string description = fmt::format(
      "\nThis file contains the kinematics (position, velocity, or acceleration) of\npoint ({:f}, "
      "{:f}, {:f}) on the {} of model {}.\n\nUnits are S.I. units (seconds, meters, "
      "Newtons,...)\n\n",
      point[0], point[1], point[2], model.bodies[body].name, model.name);
  const auto write = [&](const char* quantity, const char* title, Unit unit, Eigen::MatrixXd& values) {
    write_result(run, fmt::format("{}_{}_{}.sto", name, point_name, quantity),
                 {run.motion.q.time_s(),
                  {{point_name + "_X", unit}, {point_name + "_Y", unit}, {point_name + "_Z", unit}},
                  std::move(values)},
                 {.title = title, .description = description});
  };
  write("pos", "PointPosition", Unit::meter, position);
  write("vel", "PointVelocity", Unit::meter_per_second, velocity);
  if (qddot != nullptr) write("acc", "PointAcceleration", Unit::meter_per_second2, acceleration);
}

}  // namespace myoid::opensim
