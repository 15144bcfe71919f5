#include "myoid/recording/trc_writer.h"

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/recording/atomic_file.h"
#include "myoid/recording/text_file.h"

namespace myoid::recording {
namespace {

/// In millimeters, with the fewest digits that read back to the same meters: 15 where these do.
std::string millimeters(double meters) {
  const std::string text = fmt::format("{:.15g}", 1000.0 * meters);
  const auto back = parse_number(text);
  return back && *back * 1e-3 == meters ? format_number(*back) : format_number(1000.0 * meters);
}

}  // namespace

std::string format_trc(const MarkerSeries& markers, const std::string& file_name) {
  const Eigen::Index frames = markers.frame_count();
  if (frames == 0 || markers.names.empty())
    throw InvalidInput("a .trc file needs at least one frame and one marker");
  const double rate = frames > 1 ? static_cast<double>(frames - 1) /
                                       (markers.time_s[frames - 1] - markers.time_s[0])
                                 : 0.0;
  const std::string rate_text = fmt::format("{:.6g}", rate);
  std::string text = fmt::format("PathFileType\t4\t(X/Y/Z)\t{}\n", file_name);
  text +=
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNu"
      "mFrames\n";
  text +=
      fmt::format("{0}\t{0}\t{1}\t{2}\tmm\t{0}\t1\t{1}\n", rate_text, frames, markers.names.size());
  std::string axes = "\t";
  text += "Frame#\tTime";
  for (std::size_t m = 0; m < markers.names.size(); ++m) {
    if (markers.names[m].find_first_of(" \t\n\r") != std::string::npos ||
        markers.names[m].empty()) {
      throw InvalidInput(fmt::format("marker name '{}': a .trc file cannot hold blanks in names",
                                     markers.names[m]));
    }
    text += (m == 0 ? "\t" : "\t\t\t") + markers.names[m];
    axes += fmt::format("\tX{0}\tY{0}\tZ{0}", m + 1);
  }
  text += "\t\t\n" + axes + "\n\n";
  for (Eigen::Index frame = 0; frame < frames; ++frame) {
    text += fmt::format("{}\t{}", frame + 1, format_number(markers.time_s[frame]));
    for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        text += '\t';
        if (!markers.missing(frame, m))
          text += millimeters(markers.positions_m(frame, 3 * m + axis));
      }
    }
    text += '\n';
  }
  return text;
}

void write_trc(const std::filesystem::path& path, const MarkerSeries& markers) {
  write_file(path, format_trc(markers, path.filename().string()));
}

}  // namespace myoid::recording
