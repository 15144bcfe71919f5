#include "myoid/body/kinematics/orientation_fit.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/model/constraints.h"
#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/error.h"
#include "myoid/ground/core/index.h"
#include "myoid/ground/math/decompositions.h"

namespace myoid::body {
namespace {

std::string axis_name(const std::string& sensor, std::size_t axis) { return fmt::format("{}|{}", sensor, "xyz"[axis]); }

/// Returns the model with all bodies at the origin of ground, free to turn as before, and a marker
/// at the end of every axis of every sensor.
body::BodyModel turning_only(const body::BodyModel& model,
                             const recording::OrientationSeries& series,
                             const std::vector<SensorOnBody>& sensors) {
  for (const body::LoopConstraint& constraint : model.constraints) {
    if (!std::holds_alternative<body::FunctionConstraint>(constraint.law)) {
      throw ModelError(
          fmt::format("orientations are fitted without places, but constraint '{}' ({}) closes a loop of bodies; use "
                      "markers (InverseKinematicsTool), or a model without that constraint",
                      constraint.name, constraint.class_name));
    }
  }
  body::BodyModel turning = model;
  for (body::Joint& joint : turning.joints) {
    joint.X_PF.p = joint.X_BM.p = Vec3::Zero();
    joint.ellipsoid_radii_m.reset();
    joint.rod_length_m.reset();
    for (body::TransformAxis& axis : joint.translation) {
      axis.coordinate = -1;
      axis.function = body::Constant{0.0};
    }
  }
  for (body::Coordinate& coordinate : turning.coordinates)
    coordinate.locked = coordinate.locked || coordinate.motion == body::MotionType::translational;
  turning.markers.clear();
  for (const SensorOnBody& sensor : sensors) {
    for (std::size_t k = 0; k < 3; ++k) {
      turning.markers.push_back(
          {axis_name(series.names[sensor.column], k), sensor.body, sensor.R_BS.col(static_cast<Eigen::Index>(k))});
    }
  }
  return turning;
}

MarkerSeries axis_ends(const recording::OrientationSeries& series, const std::vector<SensorOnBody>& sensors) {
  MarkerSeries markers;
  markers.time_s = series.time_s;
  markers.positions_m.resize(series.time_s.size(), 9 * static_cast<Eigen::Index>(sensors.size()));
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    for (std::size_t k = 0; k < 3; ++k) markers.names.push_back(axis_name(series.names[sensors[s].column], k));
    for (Eigen::Index i = 0; i < series.time_s.size(); ++i) {
      const Mat3 R = series.rotation(i, sensors[s].column);
      markers.positions_m.block<1, 9>(i, 9 * static_cast<Eigen::Index>(s)) =
          R.reshaped().transpose();  // the first axis, the second, the third
    }
  }
  return markers;
}

/// Gauss-Newton steps on the angles of the sensors, in the free coordinates.
class AngleFit {
 public:
  AngleFit(const body::BodyModel& model,
           const recording::OrientationSeries& series,
           const std::vector<SensorOnBody>& sensors)
      : model_(model), series_(series), sensors_(sensors), state_(body::make_state(model)) {
    std::vector<bool> depends(model.coordinates.size(), false);
    for (const body::CoordinateCoupler& c : model.couplers) depends[at(c.dependent)] = true;
    for (const body::LoopConstraint& c : model.constraints)
      depends[at(std::get<body::FunctionConstraint>(c.law).dependent)] = true;
    for (std::size_t c = 0; c < depends.size(); ++c) {
      const body::Coordinate& k = model.coordinates[c];
      if (!k.locked && !k.prescribed && !depends[c]) free_.push_back(static_cast<Eigen::Index>(c));
    }
  }

  /// Moves q to the nearest minimum; false if the steps do not converge.
  [[nodiscard]] bool improve(Eigen::VectorXd& q, Eigen::Index frame) {
    double cost = linearize(q, frame);
    for (int iteration = 0; iteration < 50 && !free_.empty(); ++iteration) {
      hold_at_ends(q);
      Eigen::VectorXd step = math::shortest_solution(hessian_, pull_);
      const double longest = step.cwiseAbs().maxCoeff();
      if (longest < 1e-10) return true;
      if (longest > kFar) step *= kFar / longest;
      double share = 1.0;
      for (; share > 1e-6; share *= 0.5) {
        const Eigen::VectorXd next = moved(q, share * step);
        const double then = linearize(next, frame);
        if (!(then <= cost)) continue;
        cost = then;
        q = next;
        break;
      }
      if (share > 1e-6) continue;
      return longest < 1e-6;  // the cost has no more digits
    }
    return free_.empty();
  }

 private:
  static constexpr double kFar = 0.3;  ///< Longest step [rad].

  /// Returns the derivatives of all coordinates by the free ones.
  [[nodiscard]] Eigen::MatrixXd rates(const Eigen::VectorXd& q) const {
    Eigen::MatrixXd T = Eigen::MatrixXd::Identity(q.size(), q.size())(Eigen::all, free_);
    const std::size_t rounds = model_.couplers.size() + model_.constraints.size();
    for (std::size_t round = 0; round < rounds; ++round) {
      for (const body::CoordinateCoupler& c : model_.couplers)
        T.row(c.dependent) = evaluate(c.function, q[c.independent]).first * T.row(c.independent);
      for (const body::LoopConstraint& c : model_.constraints) {
        const auto& f = std::get<body::FunctionConstraint>(c.law);
        const Eigen::VectorXd gradient = evaluate(f.function, Eigen::VectorXd(q(f.independent))).gradient;
        const Eigen::RowVectorXd rate = gradient.transpose() * T(f.independent, Eigen::all);
        T.row(f.dependent) = rate;
      }
    }
    return T;
  }

  /// Returns the cost at q and computes its gradient by the free coordinates.
  double linearize(const Eigen::VectorXd& q, Eigen::Index frame) {
    body::compute_poses(model_, q, state_);
    const Eigen::MatrixXd T = rates(q);
    hessian_ = Eigen::MatrixXd::Zero(T.cols(), T.cols());
    pull_ = Eigen::VectorXd::Zero(T.cols());
    double cost = 0.0;
    for (const SensorOnBody& sensor : sensors_) {
      const Mat3 measured = series_.rotation(frame, sensor.column);
      if (!measured.allFinite()) continue;
      const Mat3 R_GS = state_.X_GB[at(sensor.body)].R * sensor.R_BS;
      const Eigen::AngleAxisd apart(Mat3(measured * R_GS.transpose()));
      const Eigen::MatrixXd J = body::angular_jacobian(model_, state_, sensor.body) * T;
      cost += 0.5 * sensor.weight * apart.angle() * apart.angle();
      hessian_ += sensor.weight * J.transpose() * J;
      pull_ += sensor.weight * apart.angle() * J.transpose() * apart.axis();
    }
    return cost;
  }

  /// Holds clamped coordinates at the end of their range that the gradient pulls outside.
  void hold_at_ends(const Eigen::VectorXd& q) {
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const body::Coordinate& c = model_.coordinates[at(free_[k])];
      const auto i = static_cast<Eigen::Index>(k);
      const bool out =
          (q[free_[k]] >= c.upper - 1e-9 && pull_[i] > 0.0) || (q[free_[k]] <= c.lower + 1e-9 && pull_[i] < 0.0);
      if (!c.clamped || !out) continue;
      pull_[i] = 0.0;
      hessian_.row(i).setZero();
      hessian_.col(i).setZero();
    }
  }

  [[nodiscard]] Eigen::VectorXd moved(Eigen::VectorXd q, const Eigen::VectorXd& step) const {
    for (std::size_t k = 0; k < free_.size(); ++k) {
      const body::Coordinate& c = model_.coordinates[at(free_[k])];
      double& value = q[free_[k]];
      const double before = value;
      value += step[static_cast<Eigen::Index>(k)];
      // A coordinate that begins outside its range by round-off may stay there.
      if (c.clamped) value = std::clamp(value, std::min(c.lower, before), std::max(c.upper, before));
    }
    return body::assemble(model_, q).q;
  }

  const body::BodyModel& model_;
  const recording::OrientationSeries& series_;
  const std::vector<SensorOnBody>& sensors_;
  std::vector<Eigen::Index> free_;
  body::BodyState state_;
  Eigen::MatrixXd hessian_;
  Eigen::VectorXd pull_;
};

Eigen::MatrixXd angles_between(const body::BodyModel& model,
                               const TimeSeries& q,
                               const recording::OrientationSeries& series,
                               const std::vector<SensorOnBody>& sensors) {
  Eigen::MatrixXd angles(q.sample_count(), static_cast<Eigen::Index>(sensors.size()));
  body::BodyState state = body::make_state(model);
  for (Eigen::Index i = 0; i < angles.rows(); ++i) {
    body::compute_poses(model, q.values().row(i).transpose(), state);
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      const Mat3 R_GS = state.X_GB[at(sensors[s].body)].R * sensors[s].R_BS;
      const Mat3 apart = R_GS.transpose() * series.rotation(i, sensors[s].column);
      angles(i, static_cast<Eigen::Index>(s)) = apart.allFinite() ? Eigen::AngleAxisd(apart).angle() : std::nan("");
    }
  }
  return angles;
}

}  // namespace

OrientationFit fit_orientations(const body::BodyModel& model,
                                const recording::OrientationSeries& series,
                                const std::vector<SensorOnBody>& sensors,
                                const Progress& progress) {
  if (sensors.empty()) throw InvalidInput("no orientation belongs to a frame of the model");
  const body::BodyModel turning = turning_only(model, series, sensors);
  IkOptions options{.progress = progress};
  std::vector<Channel> channels;
  for (const SensorOnBody& sensor : sensors) {
    const std::string& name = series.names[sensor.column];
    for (std::size_t k = 0; k < 3; ++k) options.marker_weights[axis_name(name, k)] = sensor.weight;
    channels.push_back({name, Unit::radian});
  }
  IkResult solved = inverse_kinematics(turning, axis_ends(series, sensors), options);
  OrientationFit fit;
  fit.status = std::move(solved.status);
  AngleFit angles(turning, series, sensors);
  Eigen::MatrixXd postures = solved.q.values();
  for (Eigen::Index i = 0; i < postures.rows(); ++i) {
    progress.check();
    FrameStatus& status = fit.status[at(i)];
    if (status == FrameStatus::no_markers) {
      if (i > 0) postures.row(i) = postures.row(i - 1).eval();
      continue;
    }
    Eigen::VectorXd q = postures.row(i).transpose();
    status = angles.improve(q, i) ? FrameStatus::converged : FrameStatus::not_converged;
    if (status == FrameStatus::not_converged) ++fit.frames_not_converged;
    postures.row(i) = q.transpose();
  }
  fit.q = TimeSeries(series.time_s, solved.q.channels(), std::move(postures));
  fit.errors_rad = TimeSeries(series.time_s, std::move(channels), angles_between(turning, fit.q, series, sensors));
  fit.frames_without_sensors = solved.frames_without_markers;
  fit.open_coordinates = std::move(solved.open_coordinates);
  return fit;
}

}  // namespace myoid::body
