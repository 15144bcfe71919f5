#include "myoid/recording/c3d_survey.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "myoid/c3d/c3d_frames.h"
#include "myoid/c3d/c3d_reader.h"
#include "myoid/files/byte_source.h"

namespace myoid::recording {
namespace {

/// Returns the largest force in rows of counts as stored.
double largest_force_n(const PlateSetup& plate, const C3dFile& file, const C3dFile::Rows& counts, Eigen::Index rows) {
  Eigen::MatrixXd values(rows, static_cast<Eigen::Index>(plate.channels.size()));
  for (std::size_t c = 0; c < plate.channels.size(); ++c) {
    const C3dChannel& channel = file.channels[static_cast<std::size_t>(plate.channels[c])];
    values.col(static_cast<Eigen::Index>(c)) =
        channel.scale * (counts.col(plate.channels[c]).head(rows).cast<double>().array() - channel.offset);
  }
  const double largest = channel_forces(plate, std::move(values)).rowwise().norm().maxCoeff<Eigen::PropagateNumbers>();
  return std::isfinite(largest) ? largest : 0.0;
}

}  // namespace

C3dSurvey survey_c3d(const std::filesystem::path& path) {
  ByteSource source(path);
  C3dHead head = read_c3d_head(source, path);
  C3dSurvey survey;
  survey.file = std::move(head.file);
  survey.frames = head.layout.frames;
  survey.repairs = survey.file.repairs;
  survey.plates = plate_setups(survey.file, survey.repairs);
  survey.largest_force_n.assign(survey.plates.size(), 0.0);
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
    for (std::size_t p = 0; p < survey.plates.size(); ++p)
      survey.largest_force_n[p] =
          std::max(survey.largest_force_n[p], largest_force_n(survey.plates[p], survey.file, counts, count * ratio));
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
  return survey;
}

}  // namespace myoid::recording
