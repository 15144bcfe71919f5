#include "myoid/results/stage_files.h"

#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/index.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/name_ids.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/recording/tables/storage_writer.h"

namespace myoid::results {
namespace {

/// Returns marker errors without gaps, which other tools do not read. A distance of 0 for a missing marker would be
/// wrong: frames without any marker are left out, then the columns of markers that are missing in a frame.
TimeSeries without_gaps(const TimeSeries& series) {
  std::vector<Eigen::Index> rows;
  for (Eigen::Index r = 0; r < series.sample_count(); ++r) {
    if (series.values().row(r).head(3).allFinite()) rows.push_back(r);
  }
  std::vector<Eigen::Index> columns;
  for (Eigen::Index c = 0; c < series.channel_count(); ++c) {
    if (series.values()(rows, c).allFinite()) columns.push_back(c);
  }
  std::vector<Channel> channels;
  for (const Eigen::Index c : columns) channels.push_back(series.channels()[at(c)]);
  return {series.time_s()(rows), std::move(channels), series.values()(rows, columns)};
}

}  // namespace

void SeriesColumns::add(std::string name, Unit unit, Eigen::VectorXd column) {
  channels.push_back({std::move(name), unit});
  values.push_back(std::move(column));
}

TimeSeries SeriesColumns::series(const Eigen::VectorXd& time_s) const {
  Eigen::MatrixXd all(time_s.size(), static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) all.col(static_cast<Eigen::Index>(i)) = values[i];
  return {time_s, channels, std::move(all)};
}

void write_motion(const body::BodyModel& model,
                  const TimeSeries& q,
                  const std::filesystem::path& path,
                  const std::vector<std::string>& comments) {
  // Only rotational coordinates are written in degrees; a coupled one stays as it is.
  std::vector<Channel> channels = q.channels();
  for (Channel& channel : channels) {
    const auto c = model.find_coordinate(channel.name);
    if (c && model.coordinates[at(*c)].motion != body::MotionType::rotational) channel.unit = Unit::meter;
  }
  recording::write_storage(path, {q.time_s(), std::move(channels), q.values()},
                           {.title = "Coordinates", .angles_in_degrees = true, .comments = comments});
}

void write_marker_errors(const body::IkResult& ik, const std::filesystem::path& path) {
  recording::write_storage(path, without_gaps(ik.errors), {.title = "Model Marker Errors from IK"});
}

void write_muscle_kinematics(const body::MuscleKinematics& muscles, const std::filesystem::path& folder) {
  recording::write_storage(folder / "MuscleAnalysis_Length.sto", muscles.length, {.title = "Length"});
  recording::write_storage(folder / "MuscleAnalysis_MuscleTendonVelocity.sto", muscles.velocity,
                           {.title = "MuscleTendonVelocity"});
  std::vector<std::string> coordinates;
  for (const auto& [coordinate, arms] : muscles.moment_arm) coordinates.push_back(coordinate);
  const NameIds ids(coordinates);
  for (const auto& [coordinate, arms] : muscles.moment_arm) {
    recording::write_storage(folder / fmt::format("MuscleAnalysis_MomentArm_{}.sto", ids.of(coordinate)), arms,
                             {.title = "MomentArm_" + coordinate});
  }
}

void write_shared_forces(const body::MuscleForces& shared, const std::filesystem::path& folder) {
  const auto with_reserves = [&](const TimeSeries& muscles) {
    std::vector<Channel> channels = muscles.channels();
    Eigen::MatrixXd values(muscles.sample_count(), muscles.channel_count() + shared.reserve.channel_count());
    values << muscles.values(), shared.reserve.values();
    for (const Channel& channel : shared.reserve.channels()) channels.push_back(channel);
    return TimeSeries(muscles.time_s(), std::move(channels), std::move(values));
  };
  recording::write_storage(folder / "StaticOptimization_force.sto", with_reserves(shared.force),
                           {.title = "Static Optimization"});
  recording::write_storage(folder / "StaticOptimization_activation.sto", shared.activation,
                           {.title = "Static Optimization"});
  std::string status = "time_s,status,kkt_residual\n";
  for (std::size_t i = 0; i < shared.status.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    status += fmt::format("{},{},{}\n", format_number(shared.force.time_s()[row]), body::name(shared.status[i]),
                          format_number(shared.kkt_residual[row]));
  }
  write_file(folder / "StaticOptimization_status.csv", status);
}

}  // namespace myoid::results
