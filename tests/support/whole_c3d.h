#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "myoid/c3d/c3d_reader.h"
#include "myoid/c3d/c3d_signals.h"
#include "myoid/core/error.h"

/// Whole C3D files in memory: the program itself converts the samples part by part.
namespace myoid::recording {

/// Reads a file whole, its samples as stored. A frame of reals is copied bit by bit.
inline C3dFile read_c3d_source(ByteSource& source, const std::filesystem::path& path) {
  C3dHead head = read_c3d_head(source, path);
  C3dFile& file = head.file;
  const C3dLayout& layout = head.layout;
  const auto ratio = static_cast<Eigen::Index>(layout.analog_per_frame);
  file.points.resize(layout.frames, static_cast<Eigen::Index>(4 * layout.points));
  file.analog.resize(layout.channels == 0 ? 0 : layout.frames * ratio, static_cast<Eigen::Index>(layout.channels));
  const C3dFrames frames = head.frames();
  frames.each_part(source, [&](std::int64_t first, std::int64_t count, const std::byte* p) {
    for (std::int64_t k = first; k < first + count; ++k, p += layout.frame_bytes()) {
      if (layout.points > 0) frames.points(p, file.points.row(k).data());
      if (layout.channels > 0) frames.analog(p, file.analog.row(k * ratio).data());
    }
  });
  return std::move(head.file);
}

inline C3dFile read_c3d(const std::filesystem::path& path) {
  ByteSource source(path);
  return read_c3d_source(source, path);
}

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
