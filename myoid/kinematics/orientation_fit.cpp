#include "myoid/kinematics/orientation_fit.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/core/index.h"
#include "myoid/model/kinematic_tree.h"

namespace myoid::kinematics {
namespace {

std::string axis_name(const std::string& sensor, std::size_t axis) {
  return fmt::format("{}|{}", sensor, "xyz"[axis]);
}

/// The model with all bodies at the origin of ground, turning as before, and a marker at the end of
/// every axis of every sensor.
model::BodyModel turning_only(const model::BodyModel& model,
                              const recording::OrientationSeries& series,
                              const std::vector<SensorOnBody>& sensors) {
  for (const model::LoopConstraint& constraint : model.constraints) {
    if (!std::holds_alternative<model::FunctionConstraint>(constraint.law)) {
      throw ModelError(
          fmt::format("orientations are fitted without places, but constraint '{}' ({}) closes a "
                      "loop of bodies; "
                      "use markers (InverseKinematicsTool), or a model without that constraint",
                      constraint.name, constraint.class_name));
    }
  }
  model::BodyModel turning = model;
  for (model::Joint& joint : turning.joints) {
    joint.X_PF.p = joint.X_BM.p = Vec3::Zero();
    joint.ellipsoid_radii_m.reset();
    joint.rod_length_m.reset();
    for (model::TransformAxis& axis : joint.translation) {
      axis.coordinate = -1;
      axis.function = model::Constant{0.0};
    }
  }
  for (model::Coordinate& coordinate : turning.coordinates)
    coordinate.locked = coordinate.locked || coordinate.motion == model::MotionType::translational;
  turning.markers.clear();
  for (const SensorOnBody& sensor : sensors) {
    for (std::size_t k = 0; k < 3; ++k) {
      turning.markers.push_back({axis_name(series.names[sensor.column], k), sensor.body,
                                 sensor.R_BS.col(static_cast<Eigen::Index>(k))});
    }
  }
  return turning;
}

recording::MarkerSeries axis_ends(const recording::OrientationSeries& series,
                                  const std::vector<SensorOnBody>& sensors) {
  recording::MarkerSeries markers;
  markers.time_s = series.time_s;
  markers.positions_m.resize(series.time_s.size(), 9 * static_cast<Eigen::Index>(sensors.size()));
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    for (std::size_t k = 0; k < 3; ++k)
      markers.names.push_back(axis_name(series.names[sensors[s].column], k));
    for (Eigen::Index i = 0; i < series.time_s.size(); ++i) {
      const Mat3 R = series.rotation(i, sensors[s].column);
      markers.positions_m.block<1, 9>(i, 9 * static_cast<Eigen::Index>(s)) =
          R.reshaped().transpose();  // the first axis, the second, the third
    }
  }
  return markers;
}

Eigen::MatrixXd angles_between(const model::BodyModel& model,
                               const TimeSeries& q,
                               const recording::OrientationSeries& series,
                               const std::vector<SensorOnBody>& sensors) {
  Eigen::MatrixXd angles(q.sample_count(), static_cast<Eigen::Index>(sensors.size()));
  model::BodyState state = model::make_state(model);
  for (Eigen::Index i = 0; i < angles.rows(); ++i) {
    model::compute_poses(model, q.values().row(i).transpose(), state);
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      const Mat3 R_GS = state.X_GB[at(sensors[s].body)].R * sensors[s].R_BS;
      const Mat3 apart = R_GS.transpose() * series.rotation(i, sensors[s].column);
      angles(i, static_cast<Eigen::Index>(s)) =
          apart.allFinite() ? Eigen::AngleAxisd(apart).angle() : std::nan("");
    }
  }
  return angles;
}

}  // namespace

OrientationFit fit_orientations(const model::BodyModel& model,
                                const recording::OrientationSeries& series,
                                const std::vector<SensorOnBody>& sensors,
                                const Progress& progress) {
  if (sensors.empty()) throw InvalidInput("no orientation belongs to a frame of the model");
  const model::BodyModel turning = turning_only(model, series, sensors);
  IkOptions options{.progress = progress};
  std::vector<Channel> channels;
  for (const SensorOnBody& sensor : sensors) {
    const std::string& name = series.names[sensor.column];
    for (std::size_t k = 0; k < 3; ++k) options.marker_weights[axis_name(name, k)] = sensor.weight;
    channels.push_back({name, Unit::radian});
  }
  IkResult solved = inverse_kinematics(turning, axis_ends(series, sensors), options);
  OrientationFit fit;
  fit.errors_rad = TimeSeries(series.time_s, std::move(channels),
                              angles_between(turning, solved.q, series, sensors));
  fit.q = std::move(solved.q);
  fit.status = std::move(solved.status);
  fit.frames_not_converged = solved.frames_not_converged;
  fit.frames_without_sensors = solved.frames_without_markers;
  fit.undetermined = std::move(solved.undetermined);
  return fit;
}

}  // namespace myoid::kinematics
