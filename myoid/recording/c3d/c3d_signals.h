#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/analog_channels.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/c3d/c3d_file.h"

namespace myoid::recording {

/// Returns the indices of the points that are markers, in the order of the file. Points that
/// POINT:ANGLES, FORCES, MOMENTS, POWERS or SCALARS name are results of another program.
[[nodiscard]] std::vector<Eigen::Index> marker_columns(const C3dFile& file);

/// Converts the points of a file to markers in meters, some frames at a time. A point that is not measured, no number,
/// exactly 0 0 0, or nines alone (`may_stand_for_missing`) in all three coordinates is NaN. A subject's prefix
/// ("name:") is removed if the names stay unique.
class C3dMarkerBuilder {
 public:
  /// Throws InvalidInput if there is no marker or frame, or if the unit is no length.
  C3dMarkerBuilder(const C3dFile& file, Eigen::Index frames);

  /// Adds the frames [first, first + count), each a row of four numbers for every point, as in `C3dFile::points`.
  void add(Eigen::Index first, Eigen::Index count, const float* rows);

  /// Returns the markers and adds notes to `repairs`.
  [[nodiscard]] MarkerSeries finish(std::vector<Repair>& repairs);

 private:
  /// Positions that are missing, although the file does not say so.
  struct Unmarked {
    Eigen::Index count = 0, first = 0;
    void add(Eigen::Index frame) {
      if (count++ == 0 || frame < first) first = frame;
    }
  };

  MarkerSeries markers_;
  std::vector<Repair> repairs_;
  std::vector<Eigen::Index> columns_;
  double to_m_ = 1.0;
  std::size_t points_ = 0;
  std::int64_t first_frame_ = 1;
  Unmarked zeros_, nines_;
};

/// The factors to SI of the channels; a channel of unknown unit keeps its numbers and is dimensionless.
struct C3dChannelUnits {
  std::vector<Channel> channels;
  std::vector<CountScale> scales;
};
[[nodiscard]] C3dChannelUnits c3d_channel_units(const C3dFile& file);

}  // namespace myoid::recording
