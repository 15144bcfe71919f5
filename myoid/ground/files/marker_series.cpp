#include "myoid/ground/files/marker_series.h"

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::inline ground {

MarkerSeries rotated(MarkerSeries markers, const Mat3& R) {
  for (Eigen::Index frame = 0; frame < markers.frame_count(); ++frame) {
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
      markers.positions_m.block<1, 3>(frame, 3 * m) = (R * markers.position(frame, m)).transpose();
    }
  }
  return markers;
}

Mat3 rotation_to_y_up(char up) {
  Mat3 R = Mat3::Identity();
  if (up == 'z') {
    R << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  } else if (up == 'x') {
    R << 0, -1, 0, 1, 0, 0, 0, 0, 1;
  } else if (up != 'y') {
    throw InvalidInput("vertical axis: found '{}', expected x, y or z", up);
  }
  return R;
}

}  // namespace myoid::inline ground
