#include "myoid/kinematics/joint_motion.h"

#include <optional>
#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/math/spline.h"

namespace myoid::kinematics {

Unit coordinate_unit(const model::Coordinate& coordinate, int order) {
  const bool meters = coordinate.motion == model::MotionType::translational;
  switch (order) {
    case 0:
      return meters ? Unit::meter : Unit::radian;
    case 1:
      return meters ? Unit::meter_per_second : Unit::radian_per_second;
    default:
      return meters ? Unit::meter_per_second2 : Unit::radian_per_second2;
  }
}

MotionResult joint_motion(const model::BodyModel& model, const TimeSeries& q, const MotionOptions& options) {
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
    const model::Coordinate& coordinate = model.coordinates[static_cast<std::size_t>(c)];
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
          fmt::format("column '{}' of the motion is no coordinate of the model; ignored", channel.name));
    }
  }
  result.motion = {TimeSeries(time, channels[0], std::move(value)), TimeSeries(time, channels[1], std::move(first)),
                   TimeSeries(time, channels[2], std::move(second))};
  return result;
}

}  // namespace myoid::kinematics
