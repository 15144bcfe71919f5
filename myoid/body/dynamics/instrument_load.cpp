#include "myoid/body/dynamics/instrument_load.h"

#include <array>
#include <utility>

#include <fmt/format.h>

#include "myoid/body/model/kinematic_tree.h"
#include "myoid/ground/core/error.h"
#include "myoid/recording/signals/resample.h"

namespace myoid::body {
namespace {

constexpr std::array kForce{"Fx", "Fy", "Fz"};
constexpr std::array kMoment{"Mx", "My", "Mz"};

Eigen::MatrixX3d three(const TimeSeries& wrench, const std::array<const char*, 3>& names) {
  Eigen::MatrixX3d values(wrench.sample_count(), 3);
  for (Eigen::Index k = 0; k < 3; ++k) values.col(k) = wrench.column(names[static_cast<std::size_t>(k)]);
  return values;
}

}  // namespace

ExternalForce instrument_load(const body::BodyModel& object,
                              const TimeSeries& object_q,
                              body::BodyIndex frame,
                              const TimeSeries& wrench,
                              body::BodyIndex applied_to,
                              const std::string& name) {
  const Eigen::VectorXd& clock = object_q.time_s();
  const Eigen::Index n = clock.size();
  if (n < 4) throw InvalidInput(fmt::format("{}: {} instants are too few for a load", name, n));
  require_finite(object_q, name + ": pose of the instrument");
  const double slack = 2.0 * object_q.mean_interval_s();
  if (wrench.empty() || wrench.time_s()[0] > clock[0] + slack ||
      wrench.time_s()[wrench.sample_count() - 1] < clock[n - 1] - slack) {
    throw InvalidInput(
        fmt::format("{}: the load does not cover the time of the motion, {} to {} s", name, clock[0], clock[n - 1]));
  }
  Eigen::MatrixXd q(n, static_cast<Eigen::Index>(object.coordinates.size()));
  for (std::size_t c = 0; c < object.coordinates.size(); ++c)
    q.col(static_cast<Eigen::Index>(c)) = object_q.column(object.coordinates[c].name);

  const TimeSeries then = recording::resample(wrench, clock);
  Eigen::MatrixX3d force = three(then, kForce);
  Eigen::MatrixX3d moment = three(then, kMoment);
  Eigen::MatrixX3d point(n, 3);
  body::BodyState state = body::make_state(object);
  for (Eigen::Index i = 0; i < n; ++i) {
    body::compute_poses(object, q.row(i).transpose(), state);
    const Pose& X_GS = state.X_GB[static_cast<std::size_t>(frame)];
    force.row(i) = (X_GS.R * force.row(i).transpose()).transpose().eval();
    moment.row(i) = (X_GS.R * moment.row(i).transpose()).transpose().eval();
    point.row(i) = X_GS.p.transpose();
  }
  ExternalForce load;
  load.name = name;
  load.body = applied_to;
  const math::SplineKnots knots(clock, 3);
  load.force = LoadColumns::interpolate(knots, force);
  load.point = LoadColumns::interpolate(knots, point);
  load.torque = LoadColumns::interpolate(knots, moment);
  return load;
}

ExternalForce instrument_load(body::BodyIndex frame,
                              const TimeSeries& wrench,
                              body::BodyIndex applied_to,
                              const std::string& name) {
  require_finite(wrench, name);
  if (wrench.sample_count() < 4) throw InvalidInput(fmt::format("{}: too few samples", name));
  ExternalForce load;
  load.name = name;
  load.body = applied_to;
  load.force_frame = frame;
  load.point_frame = frame;
  const math::SplineKnots knots(wrench.time_s(), 3);
  load.force = LoadColumns::interpolate(knots, three(wrench, kForce));
  load.point = LoadColumns{};  // the origin of the frame
  load.torque = LoadColumns::interpolate(knots, three(wrench, kMoment));
  return load;
}

}  // namespace myoid::body
