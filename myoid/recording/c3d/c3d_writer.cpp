#include "myoid/recording/c3d/c3d_writer.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/recording/c3d/c3d_bytes.h"
#include "myoid/recording/c3d/c3d_description.h"
#include "myoid/recording/c3d/c3d_parameters.h"

namespace myoid::recording {
namespace {

/// Returns the 16 bits of a whole number.
std::uint16_t whole(double value, bool is_unsigned, const std::string& what) {
  const double low = is_unsigned ? 0.0 : -32768.0;
  const double high = is_unsigned ? 65535.0 : 32767.0;
  if (!(value >= low && value <= high) || value != std::nearbyint(value)) {
    throw InvalidInput("{}: {} is not a whole number from {} to {}; write reals instead", what, value, low, high);
  }
  return static_cast<std::uint16_t>(static_cast<int>(value));
}

/// Writes the data of a frame in sequence.
class SampleWriter {
 public:
  SampleWriter(std::byte* at, const C3dFile& file, const C3dFormat& format, bool is_unsigned)
      : at_(at),
        number_{format.processor},
        integer_(format.integer),
        is_unsigned_(is_unsigned),
        scale_(static_cast<double>(file.point_scale)) {}

  void point(const float* p) {
    const bool measured = std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]);
    const float fourth = !measured || std::isnan(p[3]) ? -1.0F : p[3];
    for (int axis = 0; axis < 3; ++axis) {
      const float value = measured ? p[axis] : 0.0F;
      put(value, std::nearbyint(static_cast<double>(value) / scale_), false, "C3D coordinate");
    }
    put(fourth, static_cast<double>(fourth), false, "C3D residual");
  }

  void sample(float value) { put(value, static_cast<double>(value), is_unsigned_, "C3D analog sample"); }

 private:
  /// Writes `count` in a file of integers, else `value`.
  void put(float value, double count, bool is_unsigned, const char* what) {
    if (integer_) {
      number_.put_u16(at_, whole(count, is_unsigned, what));
    } else if (!number_.put_real(at_, value)) {
      throw InvalidInput("{}: {} cannot be written as a DEC number", what, value);
    }
    at_ += integer_ ? 2 : 4;
  }

  std::byte* at_;
  C3dBytes number_;
  bool integer_;
  bool is_unsigned_;
  double scale_;
};

/// Fills the first 512 bytes.
void put_header(const C3dFile& file,
                double scale,
                std::size_t analog,
                std::size_t data_block,
                const C3dBytes& number,
                std::byte* out) {
  const auto word = [&](std::size_t n, std::size_t value) {
    number.put_u16(&out[2 * (n - 1)], static_cast<std::uint16_t>(value));
  };
  const auto real = [&](std::size_t n, double value) {
    if (!number.put_real(&out[2 * (n - 1)], static_cast<float>(value)))
      throw InvalidInput("C3D header: {} cannot be written", value);
  };
  out[0] = std::byte{2};
  out[1] = std::byte{0x50};
  word(2, file.point_labels.size());
  word(3, analog);
  const std::int64_t last = file.first_frame + file.frame_count() - 1;
  word(4, static_cast<std::size_t>(std::clamp<std::int64_t>(file.first_frame, 0, 65535)));
  word(5, static_cast<std::size_t>(std::clamp<std::int64_t>(last, 0, 65535)));
  word(6, 10);
  real(7, scale);
  word(9, data_block);
  word(10, static_cast<std::size_t>(file.channels.empty() ? 1 : file.analog_per_frame));
  real(11, file.point_rate_hz);
  word(150, 12345);
}

/// Returns true if integer samples are written without sign.
bool writes_unsigned(const C3dFile& file) {
  if (file.says_unsigned())
    return std::none_of(file.channels.begin(), file.channels.end(), [](const C3dChannel& c) { return c.offset < 0.0; });
  return std::any_of(file.channels.begin(), file.channels.end(), [](const C3dChannel& c) { return c.offset > 32767; });
}

}  // namespace

std::vector<std::byte> format_c3d(const C3dFile& file, const C3dFormat& format) {
  const std::size_t points = file.point_labels.size();
  const std::size_t analog = file.channels.size() * static_cast<std::size_t>(file.analog_per_frame);
  const auto frames = static_cast<std::size_t>(file.frame_count());
  if (points > 65535 || analog > 65535)
    throw InvalidInput("{} points and {} analog samples a frame; a C3D file holds at most 65535", points, analog);
  if (frames == 0 || points + analog == 0)
    throw InvalidInput("a C3D file needs at least one frame of points or analog samples");
  const double scale = static_cast<double>(file.point_scale) * (format.integer ? 1.0 : -1.0);
  const C3dBytes number{format.processor};

  // The parameters are formatted twice: first for their length, then with the block at which the data begin.
  std::vector<C3dGroup> groups = c3d_description(file, scale);
  std::vector<std::byte> section = format_c3d_parameters(groups, number);
  const std::size_t data_block = 2 + section.size() / kC3dBlock;
  set_data_start(groups, data_block);
  section = format_c3d_parameters(groups, number);

  const std::size_t data = (data_block - 1) * kC3dBlock;
  const std::size_t frame_bytes = (4 * points + analog) * (format.integer ? 2 : 4);
  const std::size_t size = data + frames * frame_bytes;
  std::vector<std::byte> out((size + kC3dBlock - 1) / kC3dBlock * kC3dBlock);

  put_header(file, scale, analog, data_block, number, out.data());
  std::copy(section.begin(), section.end(), out.begin() + kC3dBlock);

  SampleWriter writer(&out[data], file, format, writes_unsigned(file));
  for (Eigen::Index k = 0; k < file.frame_count(); ++k) {
    for (Eigen::Index p = 0; p < static_cast<Eigen::Index>(points); ++p) writer.point(&file.points(k, 4 * p));
    for (Eigen::Index i = 0; i < (file.channels.empty() ? 0 : file.analog_per_frame); ++i) {
      for (Eigen::Index c = 0; c < file.analog.cols(); ++c)
        writer.sample(file.analog(k * file.analog_per_frame + i, c));
    }
  }
  return out;
}

void write_c3d(const std::filesystem::path& path, const C3dFile& file, const C3dFormat& format) {
  const std::vector<std::byte> bytes = format_c3d(file, format);
  write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace myoid::recording
