#include "myoid/body/kinematics/joint_motion.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/core/units.h"
#include "myoid/ground/math/spline.h"

namespace myoid::body {

Unit coordinate_unit(const body::Coordinate& coordinate, int order) {
  const bool meters = coordinate.motion == body::MotionType::translational;
  switch (order) {
    case 0:
      return meters ? Unit::meter : Unit::radian;
    case 1:
      return meters ? Unit::meter_per_second : Unit::radian_per_second;
    default:
      return meters ? Unit::meter_per_second2 : Unit::radian_per_second2;
  }
}

namespace {

/// Returns the value of a locked or prescribed coordinate at a time.
body::FunctionValue held_value(const body::Coordinate& coordinate, double time_s) {
  body::FunctionValue value{};
  if (!coordinate.locked && coordinate.prescribed) return evaluate(*coordinate.prescribed, time_s);
  value.value = coordinate.default_value;
  return value;
}

}  // namespace

bool is_held(const body::Coordinate& coordinate) { return coordinate.locked || coordinate.prescribed; }

Eigen::VectorXd held_values(const body::Coordinate& coordinate, const Eigen::VectorXd& times_s) {
  Eigen::VectorXd values(times_s.size());
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = held_value(coordinate, times_s[i]).value;
  return values;
}

std::vector<Remark> held_notes(const body::BodyModel& model, const TimeSeries& q, HeldValues held) {
  constexpr double kRounding = 1e-4;  // [rad, m]: files round angles to a few digits
  std::vector<Remark> notes;
  for (const body::Coordinate& coordinate : model.coordinates) {
    const auto column = is_held(coordinate) ? q.find(coordinate.name) : std::nullopt;
    if (!column || q.sample_count() == 0) continue;
    const Eigen::VectorXd own = held_values(coordinate, q.time_s());
    const auto recorded = q.values().col(*column);
    if (!((recorded - own).cwiseAbs().maxCoeff() > kRounding)) continue;
    const bool meters = coordinate.motion == body::MotionType::translational;
    const double unit = meters ? 1.0 : kDegree;
    const char* name = meters ? "m" : "degrees";
    const auto range = [&](const auto& values) {
      const double low = values.minCoeff() / unit, high = values.maxCoeff() / unit;
      return high - low > 1e-9 ? fmt::format("from {:.4g} to {:.4g} {}", low, high, name)
                               : fmt::format("at {:.4g} {}", low, name);
    };
    notes.push_back(
        {.severity = Severity::note,
         .says = fmt::format("coordinate '{}' is {} {} by the model, and the motion has it {}; {}", coordinate.name,
                             coordinate.locked ? "locked" : "prescribed", range(own), range(recorded),
                             held == HeldValues::of_model
                                 ? "the model's values count, as in OpenSim's analyses"
                                 : "the motion's values count, as in OpenSim's inverse dynamics")});
  }
  return notes;
}

JointMotion with_held_values(const body::BodyModel& model, JointMotion motion, bool rates_too) {
  Eigen::MatrixXd q = motion.q.values(), qdot = motion.qdot.values(), qddot = motion.qddot.values();
  bool any = false;
  for (std::size_t c = 0; c < model.coordinates.size(); ++c) {
    const body::Coordinate& coordinate = model.coordinates[c];
    if (!is_held(coordinate)) continue;
    any = true;
    const auto column = static_cast<Eigen::Index>(c);
    for (Eigen::Index i = 0; i < q.rows(); ++i) {
      const body::FunctionValue own = held_value(coordinate, motion.q.time_s()[i]);
      q(i, column) = own.value;
      if (rates_too) qdot(i, column) = own.first;
      qddot(i, column) = own.second;
    }
  }
  if (!any) return motion;
  const Eigen::VectorXd time = motion.q.time_s();
  return {TimeSeries(time, motion.q.channels(), std::move(q)),
          TimeSeries(time, motion.qdot.channels(), std::move(qdot)),
          TimeSeries(time, motion.qddot.channels(), std::move(qddot))};
}

MotionResult joint_motion(const body::BodyModel& model, const TimeSeries& q, const MotionOptions& options) {
  MotionResult result;
  const auto count = static_cast<Eigen::Index>(model.coordinates.size());
  const Eigen::VectorXd time = options.time_s.value_or(q.time_s());
  Eigen::MatrixXd value(time.size(), count);
  Eigen::MatrixXd first = Eigen::MatrixXd::Zero(time.size(), count);
  Eigen::MatrixXd second = Eigen::MatrixXd::Zero(time.size(), count);
  std::vector<Channel> channels[3];
  int found = 0;
  std::optional<math::SplineKnots> knots;  // shared by all columns
  if (!options.cutoff_hz) knots.emplace(q.time_s());
  for (Eigen::Index c = 0; c < count; ++c) {
    const body::Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(c)];
    for (int order = 0; order < 3; ++order)
      channels[order].push_back({coordinate.name, coordinate_unit(coordinate, order)});
    const auto column = q.find(coordinate.name);
    if (!column) {
      value.col(c).setConstant(coordinate.default_value);
      continue;
    }
    ++found;
    const Eigen::VectorXd samples = q.values().col(*column);
    const math::Spline spline = options.cutoff_hz
                                    ? math::Spline::smooth(q.time_s(), samples, {.cutoff_hz = options.cutoff_hz})
                                    : knots->interpolate(samples);
    const math::SplineValues values = spline.evaluate(time);
    value.col(c) = values.value;
    first.col(c) = values.first;
    second.col(c) = values.second;
  }
  if (found == 0) {
    throw InvalidInput(fmt::format(
        "no column of the motion ({}) is a coordinate of the model '{}'; rename the columns to the model's coordinates",
        channel_names(q), model.name));
  }
  for (const Channel& channel : q.channels()) {
    if (!model.find_coordinate(channel.name)) {
      result.notes.push_back(
          {.severity = Severity::note,
           .says = fmt::format("column '{}' of the motion is no coordinate of the model; ignored", channel.name)});
    }
  }
  result.motion = {TimeSeries(time, channels[0], std::move(value)), TimeSeries(time, channels[1], std::move(first)),
                   TimeSeries(time, channels[2], std::move(second))};
  for (Remark& note : held_notes(model, q, options.held)) result.notes.push_back(std::move(note));
  if (options.held == HeldValues::of_model) result.motion = with_held_values(model, std::move(result.motion), true);
  return result;
}

}  // namespace myoid::body
