#include "myoid/recording/c3d/make_c3d.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::recording {

namespace {

/// Returns the decimal to which all times are rounded, 0.01 to 0.0001 s; 0 for finer times.
double rounding_of(const Eigen::VectorXd& time_s) {
  for (const double unit : {1e-2, 1e-3, 1e-4}) {
    const Eigen::ArrayXd count = time_s.array() / unit;
    if ((count - count.round()).abs().maxCoeff() < 1e-4) return unit;
  }
  return 0.0;
}

/// Returns the rate of an even clock, whose times may be rounded. Throws InvalidInput for an uneven one.
double rate_of(const Eigen::VectorXd& time_s, const char* what) {
  const Eigen::Index n = time_s.size();
  if (n < 2) throw InvalidInput("{}: a C3D file needs at least two samples", what);
  const double dt = (time_s[n - 1] - time_s[0]) / static_cast<double>(n - 1);
  // Two times are rounded by half a decimal each. A lost sample puts others off by half a step.
  const double rounding = rounding_of(time_s);
  const double tolerance = std::max(0.05 * dt, std::min(1.01 * rounding, 0.45 * dt));
  for (Eigen::Index i = 1; i < n; ++i) {
    if (std::abs(time_s[i] - time_s[0] - static_cast<double>(i) * dt) > tolerance)
      throw InvalidInput(
          "{}: the samples are not evenly spaced ({} s to {} s), as a C3D file needs them; resample first", what,
          time_s[i - 1], time_s[i]);
  }
  // Rates are whole or have few decimals; the times are rounded.
  const double rate = 1.0 / dt;
  const double whole = std::round(rate);
  if (std::abs(rate - whole) * (time_s[n - 1] - time_s[0]) <= rounding * rate) return whole;
  const double rounded = std::round(rate * 100.0) / 100.0;
  return std::abs(rate - rounded) < 1e-4 * rate ? rounded : rate;
}

/// Returns the analog samples per frame. Throws InvalidInput unless their number is whole and both
/// clocks begin together.
int samples_per_frame(const Eigen::VectorXd& analog_s, const Eigen::VectorXd& frames_s, double frame_rate_hz) {
  const double ratio = rate_of(analog_s, "analog") / frame_rate_hz;
  const auto whole = static_cast<int>(std::lround(ratio));
  if (whole < 1 || std::abs(ratio - whole) > 1e-3 * ratio) {
    throw InvalidInput(
        "{} analog samples for each frame: a C3D file needs a whole number; resample the analog channels "
        "to a multiple of {} Hz",
        ratio, frame_rate_hz);
  }
  const double lag_s = analog_s[0] - frames_s[0];
  if (std::abs(lag_s) * ratio * frame_rate_hz > 0.5) {
    throw InvalidInput(
        "markers begin at {} s, analog channels at {} s; a C3D file needs one beginning: cut the longer one",
        frames_s[0], analog_s[0]);
  }
  return whole;
}

/// Adds four numbers a marker: x, y, z in millimeters and the residual, -1 in a gap.
void add_points(const MarkerSeries& markers, Eigen::Index frames, C3dFile& file) {
  file.point_unit = "mm";
  file.point_labels = markers.names;
  file.points.resize(frames, 4 * markers.marker_count());
  for (Eigen::Index k = 0; k < frames; ++k) {
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
      const bool gap = markers.missing(k, m);
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        file.points(k, 4 * m + axis) = gap ? 0.0F : static_cast<float>(1000.0 * markers.positions_m(k, 3 * m + axis));
      file.points(k, 4 * m + 3) = gap ? -1.0F : 0.0F;
    }
  }
}

/// Adds channels in SI, but moments in N mm, as in C3D files of laboratories.
void add_channels(const TimeSeries& analog, Eigen::Index samples, C3dFile& file) {
  file.analog.resize(samples, analog.channel_count());
  for (Eigen::Index c = 0; c < analog.channel_count(); ++c) {
    const Channel& channel = analog.channels()[static_cast<std::size_t>(c)];
    const bool moment = channel.unit == Unit::newton_meter;
    file.channels.push_back({channel.name,
                             moment                                ? "Nmm"
                             : channel.unit == Unit::dimensionless ? ""
                                                                   : std::string(symbol(channel.unit)),
                             0.0, 1.0});
    for (Eigen::Index i = 0; i < samples; ++i)
      file.analog(i, c) = static_cast<float>(analog.values()(i, c) * (moment ? 1000.0 : 1.0));
  }
}

}  // namespace

C3dFile make_c3d(const MarkerSeries& markers, const TimeSeries& analog) {
  const bool has_markers = markers.frame_count() > 0;
  if (!has_markers && analog.empty()) throw InvalidInput("a C3D file needs markers or analog channels");
  const Eigen::VectorXd& clock = has_markers ? markers.time_s : analog.time_s();
  C3dFile file;
  file.point_rate_hz = rate_of(clock, has_markers ? "markers" : "analog");
  file.first_frame = 1 + std::llround(clock[0] * file.point_rate_hz);
  Eigen::Index frames = clock.size();
  if (!analog.empty()) {
    file.analog_per_frame = samples_per_frame(analog.time_s(), clock, file.point_rate_hz);
    frames = std::min(frames, analog.sample_count() / file.analog_per_frame);
    if (frames == 0) throw InvalidInput("the analog channels are shorter than one frame");
  }
  add_points(markers, frames, file);
  add_channels(analog, analog.empty() ? 0 : frames * file.analog_per_frame, file);
  return file;
}

}  // namespace myoid::recording
