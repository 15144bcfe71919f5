#include "myoid/results/stage_files.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/files/atomic_file.h"
#include "myoid/files/text_file.h"
#include "myoid/tables/storage_writer.h"

namespace myoid {
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
    bool complete = true;
    for (const Eigen::Index r : rows) complete = complete && std::isfinite(series.values()(r, c));
    if (complete) columns.push_back(c);
  }
  Eigen::VectorXd time(static_cast<Eigen::Index>(rows.size()));
  Eigen::MatrixXd values(time.size(), static_cast<Eigen::Index>(columns.size()));
  std::vector<Channel> channels;
  for (const Eigen::Index c : columns) channels.push_back(series.channels()[static_cast<std::size_t>(c)]);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    time[static_cast<Eigen::Index>(i)] = series.time_s()[rows[i]];
    for (std::size_t k = 0; k < columns.size(); ++k)
      values(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k)) = series.values()(rows[i], columns[k]);
  }
  return {std::move(time), std::move(channels), std::move(values)};
}

}  // namespace

void write_motion(const model::BodyModel& model,
                  const TimeSeries& q,
                  const std::filesystem::path& path,
                  const std::vector<std::string>& comments) {
  // Only rotational coordinates are written in degrees; a coupled one stays as it is.
  std::vector<Channel> channels = q.channels();
  for (Channel& channel : channels) {
    const auto c = model.find_coordinate(channel.name);
    if (c && model.coordinates[static_cast<std::size_t>(*c)].motion != model::MotionType::rotational)
      channel.unit = Unit::meter;
  }
  recording::write_storage(path, {q.time_s(), std::move(channels), q.values()},
                           {.title = "Coordinates", .angles_in_degrees = true, .comments = comments});
}

void write_marker_errors(const kinematics::IkResult& ik, const std::filesystem::path& path) {
  recording::write_storage(path, without_gaps(ik.errors), {.title = "Model Marker Errors from IK"});
}

void write_muscle_kinematics(const kinematics::MuscleKinematics& muscles, const std::filesystem::path& folder) {
  recording::write_storage(folder / "MuscleAnalysis_Length.sto", muscles.length, {.title = "Length"});
  recording::write_storage(folder / "MuscleAnalysis_MuscleTendonVelocity.sto", muscles.velocity,
                           {.title = "MuscleTendonVelocity"});
  for (const auto& [coordinate, arms] : muscles.moment_arm) {
    recording::write_storage(folder / ("MuscleAnalysis_MomentArm_" + coordinate + ".sto"), arms,
                             {.title = "MomentArm_" + coordinate});
  }
}

void write_shared_forces(const forces::MuscleForces& shared, const std::filesystem::path& folder) {
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
    status += fmt::format("{},{},{}\n", recording::format_number(shared.force.time_s()[row]),
                          forces::name(shared.status[i]), recording::format_number(shared.kkt_residual[row]));
  }
  recording::write_file(folder / "StaticOptimization_status.csv", status);
}

}  // namespace myoid
