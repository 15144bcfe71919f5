#include "myoid/recording/c3d_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "myoid/ground/files/byte_source.h"
#include "myoid/recording/c3d/c3d_frames.h"
#include "myoid/recording/c3d/c3d_reader.h"
#include "myoid/recording/c3d_recording.h"

namespace myoid::recording {
namespace {

/// Takes the plates from the whole recording: their baselines need all samples.
void survey_plates(const std::filesystem::path& path, C3dSurvey& survey) {
  const C3dParameter* used = survey.file.find("FORCE_PLATFORM", "USED");
  const C3dParameter* types = survey.file.find("FORCE_PLATFORM", "TYPE");
  if (survey.file.channels.empty() || (used == nullptr && types == nullptr)) return;
  Recording recording = read_c3d_plates(path);
  survey.repairs = std::move(recording.repairs);
  for (const PlateSetup& plate : recording.plates) {
    const double largest = channel_forces(plate, recording.analog.as_written(plate.channels))
                               .rowwise()
                               .norm()
                               .maxCoeff<Eigen::PropagateNumbers>();
    survey.largest_force_n.push_back(std::isfinite(largest) ? largest : 0.0);
  }
  survey.plates = std::move(recording.plates);
}

}  // namespace

C3dSurvey survey_c3d(const std::filesystem::path& path) {
  ByteSource source(path);
  C3dHead head = read_c3d_head(source, path);
  C3dSurvey survey;
  survey.file = std::move(head.file);
  survey.frames = head.layout.frames;
  survey.repairs = survey.file.repairs;
  survey.missing_frames.assign(head.layout.points, 0);
  const auto channels = static_cast<Eigen::Index>(head.layout.channels);
  const auto ratio = static_cast<Eigen::Index>(head.layout.analog_per_frame);
  Eigen::ArrayXf low = Eigen::ArrayXf::Constant(channels, std::numeric_limits<float>::infinity());
  Eigen::ArrayXf high = -low;
  const C3dFrames frames(head.layout, survey.file.processor, head.is_unsigned);
  std::vector<float> points(4 * head.layout.points);
  C3dFile::Rows counts;
  frames.each_part(source, [&](std::int64_t, std::int64_t count, const std::byte* frame) {
    if (channels > 0 && counts.rows() < count * ratio) counts.resize(count * ratio, channels);
    for (std::int64_t k = 0; k < count; ++k, frame += head.layout.frame_bytes()) {
      frames.points(frame, points.data());
      for (std::size_t m = 0; m < head.layout.points; ++m) {
        const float* const p = &points[4 * m];
        const bool zero = p[0] == 0.0F && p[1] == 0.0F && p[2] == 0.0F;
        const bool there = p[3] >= 0.0F && !zero && std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
        survey.missing_frames[m] += there ? 0 : 1;
      }
      if (channels == 0) continue;
      frames.analog(frame, counts.row(k * ratio).data());
      for (Eigen::Index r = k * ratio; r < (k + 1) * ratio; ++r) {
        const float* const row = counts.row(r).data();
        for (Eigen::Index c = 0; c < channels; ++c) {
          low[c] = std::min(low[c], row[c]);  // a NaN leaves both unchanged
          high[c] = std::max(high[c], row[c]);
        }
      }
    }
  });
  survey.lowest.resize(channels);
  survey.highest.resize(channels);
  for (Eigen::Index c = 0; c < channels; ++c) {
    const C3dChannel& channel = survey.file.channels[static_cast<std::size_t>(c)];
    const double a = (static_cast<double>(low[c]) - channel.offset) * channel.scale;
    const double b = (static_cast<double>(high[c]) - channel.offset) * channel.scale;
    survey.lowest[c] = std::min(a, b);
    survey.highest[c] = std::max(a, b);
  }
  survey_plates(path, survey);
  return survey;
}

}  // namespace myoid::recording
