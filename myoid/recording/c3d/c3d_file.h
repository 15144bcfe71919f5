#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/event.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::recording {

/// The processor a C3D file was written for: it decides byte order and kind of real.
enum class C3dProcessor : std::uint8_t { intel = 84, dec = 85, sgi = 86 };

/// The four kinds of parameter with their code in the file. The code's size is the bytes per element.
enum class C3dType : std::int8_t { text = -1, byte = 1, integer = 2, real = 4 };

/// A parameter as stored; a single value has no `dimensions`.
struct C3dParameter {
  std::string name;
  std::string description;
  bool locked = false;
  C3dType type = C3dType::integer;
  std::vector<std::uint8_t> dimensions;
  std::string text;             ///< For kind text: all bytes, the first dimension running fastest.
  std::vector<double> numbers;  ///< For the other kinds; a double holds each of them exactly.

  friend bool operator==(const C3dParameter&, const C3dParameter&) = default;
};

struct C3dGroup {
  int id = 0;  ///< 1 to 127.
  std::string name;
  std::string description;
  bool locked = false;
  std::vector<C3dParameter> parameters;

  friend bool operator==(const C3dGroup&, const C3dGroup&) = default;
};

/// An analog channel. A sample is (count - offset) * scale, in `unit_text`.
struct C3dChannel {
  std::string name;       ///< Unique, UTF-8; as written, without blanks at its end.
  std::string unit_text;  ///< As written: "V", "Nmm", "nt"; may be empty or no unit.
  double offset = 0.0;
  double scale = 1.0;  ///< SCALE * GEN_SCALE.

  friend bool operator==(const C3dChannel&, const C3dChannel&) = default;
};

/// A C3D file with the numbers in the file's own 32 bits and every parameter.
struct C3dFile {
  using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  C3dProcessor processor = C3dProcessor::intel;
  bool integer = false;      ///< The samples are 16-bit integers in the file; `points` are scaled.
  float point_scale = 0.1F;  ///< Step of integer coordinates and of residuals [point_unit].
  std::vector<C3dGroup> groups;

  double point_rate_hz = 0.0;
  /// Frame of the first sample, at (first_frame - 1) / point_rate_hz.
  std::int64_t first_frame = 1;
  std::vector<std::string> point_labels;  ///< Unique, UTF-8.
  std::string point_unit;                 ///< As written: "mm".
  Rows points;                            ///< Frames x (4 points): x, y, z [point_unit] and a fourth word, -1 for "not
                ///< measured", else 256 * cameras + residual / scale. Has a row for each frame even
                ///< without points.

  int analog_per_frame = 1;  ///< Analog samples per frame.
  std::vector<C3dChannel> channels;
  Rows analog;  ///< (frames * analog_per_frame) x channels: counts as stored.

  std::vector<Event> events;
  std::vector<Repair> repairs;

  [[nodiscard]] Eigen::Index frame_count() const { return points.rows(); }
  [[nodiscard]] double start_s() const { return static_cast<double>(first_frame - 1) / point_rate_hz; }
  [[nodiscard]] double analog_rate_hz() const { return point_rate_hz * analog_per_frame; }

  /// Finds the parameter of this group and name, ignoring case and known misspellings of old
  /// programs (FORCE_PLATEFORM, OFFSETS); nullptr if there is none.
  [[nodiscard]] const C3dParameter* find(std::string_view group, std::string_view name) const;

  /// Returns true if ANALOG:FORMAT says that the samples have no sign.
  [[nodiscard]] bool says_unsigned() const;
};

/// Returns NAME, NAME2, NAME3, ...: a list of more than 255 elements is split over parameters of these names.
[[nodiscard]] std::string block_name(std::string_view name, int block);

/// Splits a text parameter into its texts, as UTF-8 and without blanks and zero bytes at their ends.
[[nodiscard]] std::vector<std::string> texts(const C3dParameter& parameter);

/// Joins the texts, or the numbers, of NAME, NAME2, NAME3, ... in the order of the blocks.
[[nodiscard]] std::vector<std::string> all_texts(const C3dFile& file, std::string_view group, std::string_view name);
[[nodiscard]] std::vector<double> all_numbers(const C3dFile& file, std::string_view group, std::string_view name);

/// Returns the number at `index` if the parameter exists and this number is finite.
[[nodiscard]] std::optional<double> number_at(const C3dParameter* parameter, std::size_t index);

}  // namespace myoid::recording
