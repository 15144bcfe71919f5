#include "myoid/recording/trc_writer.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/tables/text_rows.h"

namespace myoid::recording {
namespace {

/// Writes millimeters with 15 digits if these read back to the same meters, otherwise with the fewest that do.
char* put_millimeters(char* at, double meters) {
  const double exact = 1000.0 * meters;
  char* const end = put_number(at, exact);
  const auto digits = std::count_if(at, end, [](char c) { return c >= '0' && c <= '9'; });
  if (digits <= 15) return end;
  char text[NumberText::kRoom];
  const char* const stop = std::to_chars(text, text + sizeof text, exact, std::chars_format::general, 15).ptr;
  double back = 0.0;
  std::from_chars(text, stop, back);
  return back * 1e-3 == meters ? put_number(at, back) : end;
}

std::string trc_header(const MarkerSeries& markers, const std::string& file_name) {
  const Eigen::Index frames = markers.frame_count();
  const double rate =
      frames > 1 ? static_cast<double>(frames - 1) / (markers.time_s[frames - 1] - markers.time_s[0]) : 0.0;
  const std::string rate_text = fmt::format("{:.6g}", rate);
  std::string text = fmt::format("PathFileType\t4\t(X/Y/Z)\t{}\n", file_name);
  text +=
      "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNu"
      "mFrames\n";
  text += fmt::format("{0}\t{0}\t{1}\t{2}\tmm\t{0}\t1\t{1}\n", rate_text, frames, markers.names.size());
  std::string axes = "\t";
  text += "Frame#\tTime";
  for (std::size_t m = 0; m < markers.names.size(); ++m) {
    if (markers.names[m].find_first_of(" \t\n\r") != std::string::npos || markers.names[m].empty()) {
      throw InvalidInput(fmt::format("marker name '{}': a .trc file cannot hold blanks in names", markers.names[m]));
    }
    text += (m == 0 ? "\t" : "\t\t\t") + markers.names[m];
    axes += fmt::format("\tX{0}\tY{0}\tZ{0}", m + 1);
  }
  text += "\t\t\n" + axes + "\n\n";
  return text;
}

void put_trc(const MarkerSeries& markers, const std::string& file_name, const TextSink& sink) {
  if (markers.frame_count() == 0 || markers.names.empty())
    throw InvalidInput("a .trc file needs at least one frame and one marker");
  sink(trc_header(markers, file_name));
  const RowText text = [&](Eigen::Index first, Eigen::Index count, NumberText&, char* at) {
    for (Eigen::Index frame = first; frame < first + count; ++frame) {
      at = std::to_chars(at, at + NumberText::kRoom, frame + 1).ptr;
      *at++ = '\t';
      at = put_number(at, markers.time_s[frame]);
      for (Eigen::Index m = 0; m < markers.marker_count(); ++m) {
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
          *at++ = '\t';
          if (!markers.missing(frame, m)) at = put_millimeters(at, markers.positions_m(frame, 3 * m + axis));
        }
      }
      *at++ = '\n';
    }
    return at;
  };
  write_rows(markers.frame_count(), 2 + 3 * markers.marker_count(), text, sink);
}

}  // namespace

std::string format_trc(const MarkerSeries& markers, const std::string& file_name) {
  std::string text;
  put_trc(markers, file_name, [&](std::string_view part) { text += part; });
  return text;
}

void write_trc(const std::filesystem::path& path, const MarkerSeries& markers) {
  FileInParts file(path);
  put_trc(markers, path.filename().string(), [&](std::string_view part) { file.append(part); });
  file.finish();
}

}  // namespace myoid::recording
