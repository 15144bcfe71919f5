#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::inline ground {

/// The formats of files that Myoid reads. A switch over them has no default, so that the compiler
/// reports each place that a new format concerns.
enum class FileFormat {
  c3d,
  trc,
  storage,
  text_table,
  bids_motion,
  edf,
  anc,
  mesh_vtp,
  mesh_stl,
  mesh_obj,
  model,
  set_up,
  toml
};

/// A row of the table of formats.
struct FormatEntry {
  FileFormat format;
  std::vector<std::string_view> endings;  ///< Endings of file names, in small letters.
  std::vector<std::string_view> written;  ///< The endings under which Myoid writes the format.
  std::string_view kind;                  ///< A file of the format in messages: "a model".
  std::string_view holds;                 ///< Contents, for the documentation.
  std::string_view reader;                ///< The unit that reads the format: "recording/c3d/c3d_reader".
  std::string_view writer;                ///< The unit that writes the format, or empty.
  bool markers = false;                   ///< A file may hold markers.
  bool channels = false;                  ///< A file may hold channels over time.
  bool emg = false;                       ///< `read_emg` reads EMG of the format.
};

/// Returns all formats, one row each.
[[nodiscard]] const std::vector<FormatEntry>& file_formats();

/// Returns the row of one format.
[[nodiscard]] const FormatEntry& format_entry(FileFormat format);

/// Returns the format of a file by the ending of its name, ignoring case. The longest matching
/// ending decides ("_motion.tsv" before ".tsv"). Empty for an unknown ending.
[[nodiscard]] std::optional<FileFormat> format_of(const std::filesystem::path& path);

/// Returns true if files of this format hold markers or channels over time.
[[nodiscard]] bool is_recording(FileFormat format);

/// Returns the ending of a name in small letters with its point: ".c3d".
[[nodiscard]] std::string extension_of(const std::filesystem::path& path);

/// Returns the endings of all formats that `listed` accepts, in the order of the table: ".c3d, .trc and .sto".
[[nodiscard]] std::string endings_text(bool (*listed)(const FormatEntry&));

/// Returns the endings of all formats of which EMG is read.
[[nodiscard]] std::string emg_endings_text();

/// Returns the endings of recordings that Myoid writes: ".c3d, .trc, .sto, .mot and .csv".
[[nodiscard]] std::string written_endings_text();

/// Returns true if Myoid writes recordings under this ending (in small letters).
[[nodiscard]] bool is_written_ending(std::string_view ending);

/// Throws ReadError for the ending of another program's format that Myoid does not read (.acq, .mat, .xlsx, .mvnx, .xdf
/// and others), with the way to a format that it reads. Any other name passes.
void refuse_foreign_format(const std::filesystem::path& path);

/// Returns an empty text if the name's ending belongs to one of the formats `wanted` or to no format; else "this is a
/// .trc file (markers), but EXPECTED is expected here: were two options mixed up?".
[[nodiscard]] std::string wrong_kind(const std::filesystem::path& path,
                                     const std::vector<FileFormat>& wanted,
                                     std::string_view expected);

}  // namespace myoid::inline ground
