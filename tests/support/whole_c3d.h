#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/error.h"
#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d/c3d_signals.h"

/// Whole C3D files in memory: the program itself converts the samples part by part.
namespace myoid::recording {

inline C3dFile parse_c3d(std::span<const std::byte> bytes, const std::filesystem::path& path) {
  ByteSource source(bytes, path);
  return read_c3d_source(source, path);
}

/// Returns all markers of a file. Throws like `C3dMarkerBuilder`.
inline MarkerSeries c3d_markers(const C3dFile& file, std::vector<Repair>& repairs) {
  C3dMarkerBuilder builder(file, file.frame_count());
  builder.add(0, file.frame_count(), file.points.data());
  return builder.finish(repairs);
}

/// Returns the analog channels in SI. Throws InvalidInput if there are none.
inline TimeSeries c3d_analog(const C3dFile& file) {
  if (file.analog.size() == 0) throw InvalidInput("the C3D file holds no analog channels");
  const Eigen::Index samples = file.analog.rows();
  const double start = static_cast<double>(file.first_frame - 1) * file.analog_per_frame;
  Eigen::VectorXd time(samples);
  for (Eigen::Index i = 0; i < samples; ++i) time[i] = (start + static_cast<double>(i)) / file.analog_rate_hz();
  const C3dChannelUnits units = c3d_channel_units(file);
  Eigen::MatrixXd values(samples, file.analog.cols());
  for (Eigen::Index c = 0; c < values.cols(); ++c) {
    const CountScale& scale = units.scales[static_cast<std::size_t>(c)];
    for (Eigen::Index i = 0; i < samples; ++i)
      values(i, c) = (static_cast<double>(file.analog(i, c)) - scale.offset) * scale.scale * scale.to_si;
  }
  return {std::move(time), units.channels, std::move(values)};
}

}  // namespace myoid::recording
