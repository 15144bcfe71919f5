// Problem: a trial was recorded with markers in one file and raw EMG in another. How much is in
// them, and where and how strong is it?
//
//   read_a_recording MARKERS EMG
#include <cmath>
#include <cstdio>
#include <exception>

#include "myoid/recording/recording.h"

namespace {

// A reader returns SI units whatever the file has: this .trc file has millimeters.
void tell_markers(const myoid::MarkerSeries& markers) {
  const Eigen::Index frames = markers.frame_count();
  const double duration_s = markers.time_s(frames - 1) - markers.time_s(0);
  const myoid::Vec3 first_m = markers.position(0, 0);
  std::printf("markers: %ld\n", static_cast<long>(markers.marker_count()));
  std::printf("frames: %ld\n", static_cast<long>(frames));
  std::printf("duration: %.6g s\n", duration_s);
  std::printf("frame rate: %.6g Hz\n", static_cast<double>(frames - 1) / duration_s);
  std::printf("height of %s in the first frame: %.6g m\n", markers.names[0].c_str(), first_m.y());
}

// Rows of a series are samples, columns are channels.
void tell_emg(const myoid::TimeSeries& emg) {
  std::printf("EMG rate: %.6g Hz\n", emg.mean_rate_hz());
  for (const myoid::Channel& channel : emg.channels()) {
    const Eigen::VectorXd volts = emg.column(channel.name);
    const double rms = std::sqrt(volts.squaredNorm() / static_cast<double>(volts.size()));
    std::printf("EMG of %s: %.6g uV rms\n", channel.name.c_str(), 1e6 * rms);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return std::fputs("read_a_recording MARKERS EMG\n", stderr), 2;
  try {
    tell_markers(myoid::recording::read_recording(argv[1]).markers);
    tell_emg(myoid::recording::read_recording(argv[2]).analog.series());
  } catch (const std::exception& error) {
    return std::fprintf(stderr, "%s\n", error.what()), 3;
  }
}
