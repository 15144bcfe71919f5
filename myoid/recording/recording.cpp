#include "myoid/recording/recording.h"

#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/recording/anc_reader.h"
#include "myoid/recording/bids.h"
#include "myoid/recording/c3d_recording.h"
#include "myoid/recording/edf_reader.h"
#include "myoid/recording/makers/emg_table.h"
#include "myoid/recording/makers/marker_table.h"
#include "myoid/recording/makers/nexus_section.h"
#include "myoid/recording/tables/storage_reader.h"
#include "myoid/recording/trc_reader.h"

namespace myoid::recording {

std::string to_string(const Repair& repair) {
  return repair.line > 0 ? fmt::format("line {}: {}", repair.line, repair.message) : repair.message;
}

std::string to_string(const std::filesystem::path& path, const Repair& repair) {
  return repair.line > 0 ? fmt::format("{}:{}: {}", path.string(), repair.line, repair.message)
                         : fmt::format("{}: {}", path.string(), repair.message);
}

Remark remark_of(const Repair& repair, std::string says) {
  Remark remark{.code = RemarkCode::reading, .severity = Severity::note, .says = std::move(says)};
  if (!repair.lost) return remark;
  remark.severity = Severity::warning;
  remark.remedy = "the end of the recording is absent: copy or export the file again";
  return remark;
}

namespace {

/// The first study and the first recording of a folder and its subfolders, by name, and the number of recordings.
struct FolderContent {
  std::filesystem::path study, recording;
  std::size_t recordings = 0;
};

FolderContent content_of(const std::filesystem::path& folder) {
  constexpr std::size_t kMost = 20'000;  // entries: a home directory has millions
  namespace fs = std::filesystem;
  FolderContent found;
  std::error_code error;
  // A table may hold anything.
  const auto rank = [](const fs::path& path) { return std::pair(format_of(path) == FileFormat::text_table, path); };
  const auto first = [&](fs::path& least, const fs::path& path) {
    if (least.empty() || rank(path) < rank(least)) least = path;
  };
  std::size_t seen = 0;
  for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
       !error && at != end && seen < kMost; at.increment(error), ++seen) {
    std::error_code ignored;
    if (!at->is_regular_file(ignored)) continue;
    const auto format = format_of(at->path());
    if (at->path().filename() == "study.toml") first(found.study, at->path());
    if (!format || !is_recording(*format)) continue;
    first(found.recording, at->path());
    ++found.recordings;
  }
  return found;
}

}  // namespace

void refuse_folder(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return;
  const FolderContent found = content_of(path);
  const auto check = [](const std::filesystem::path& file) {
    return fmt::format("myoid check {}", shell_word(file.string()));
  };
  if (!found.study.empty()) throw ReadError(path, 0, "this is a folder; its study: {}", check(found.study));
  if (found.recordings > 0)
    throw ReadError(path, 0,
                    "this is a folder without a study.toml; one recording of {}: {}; a study of all: myoid init STUDY "
                    "--from {}",
                    found.recordings, check(found.recording), shell_word(path.string()));
  throw ReadError(path, 0, "this is a folder without a study.toml and without a recording ({})",
                  endings_text([](const FormatEntry& entry) { return is_recording(entry.format); }));
}

namespace {

/// Nexus writes devices and markers into one file: both are read.
Recording read_text_table(const std::filesystem::path& path) {
  Recording recording;
  const std::string text = read_text_file(path);
  const bool markers = is_marker_table(text);
  if (markers) {
    MarkerFile file = parse_marker_table(text, path);
    recording.markers = std::move(file.markers);
    recording.repairs = std::move(file.repairs);
  }
  if (!markers || nexus_section(TableText(text), "Devices", path)) {
    CsvSeries file = parse_emg_table(text, path);
    recording.analog = std::move(file.data);
    for (ClockedChannels& group : file.other_clocks) recording.other_clocks.emplace_back(std::move(group.data));
    recording.events = std::move(file.events);
    recording.repairs.insert(recording.repairs.end(), file.repairs.begin(), file.repairs.end());
  }
  return recording;
}

MarkerFile markers_of_bids(const std::filesystem::path& path) {
  BidsMotion motion = read_bids_motion(path);
  if (motion.markers.frame_count() == 0)
    throw ReadError(path, 0, "there are no positions (POS) among the channels, so no markers");
  return {std::move(motion.markers), "m", std::move(motion.repairs)};
}

MarkerFile markers_of_c3d(const std::filesystem::path& path) {
  MarkerFile result;
  Recording file = read_c3d_markers(path, result.unit);
  if (file.markers.frame_count() == 0) throw ReadError(path, 0, "the C3D file holds no markers");
  result.markers = std::move(file.markers);
  result.repairs = std::move(file.repairs);
  return result;
}

/// Takes the channels, events and repairs of a file without markers.
template <typename File>
Recording of_channels(File file) {
  Recording recording;
  recording.analog = std::move(file.data);
  if constexpr (requires { file.other_clocks; })
    for (auto& other : file.other_clocks) recording.other_clocks.push_back(std::move(other.data));
  if constexpr (requires { file.events; }) recording.events = std::move(file.events);
  recording.repairs = std::move(file.repairs);
  return recording;
}

}  // namespace

MarkerFile read_markers(const std::filesystem::path& path) {
  if (const auto format = format_of(path)) {
    switch (*format) {
      case FileFormat::trc:
        return read_trc(path);
      case FileFormat::bids_motion:
        return markers_of_bids(path);
      case FileFormat::text_table:
        return parse_marker_table(read_text_file(path), path);
      case FileFormat::c3d:
        return markers_of_c3d(path);
      case FileFormat::storage:
      case FileFormat::edf:
      case FileFormat::anc:
      case FileFormat::mesh_vtp:
      case FileFormat::mesh_stl:
      case FileFormat::mesh_obj:
      case FileFormat::model:
      case FileFormat::set_up:
      case FileFormat::toml:
        break;
    }
  }
  refuse_foreign_format(path);
  throw ReadError(path, 0, "markers are read from {}, not from '{}'; export the recording as one of these",
                  endings_text([](const FormatEntry& entry) { return entry.markers; }), extension_of(path));
}

Recording read_recording(const std::filesystem::path& path) {
  refuse_folder(path);
  if (const auto format = format_of(path)) {
    switch (*format) {
      case FileFormat::c3d:
        return read_c3d_recording(path);
      case FileFormat::trc: {
        MarkerFile file = read_trc(path);
        Recording recording;
        recording.markers = std::move(file.markers);
        recording.repairs = std::move(file.repairs);
        return recording;
      }
      case FileFormat::storage:
        return of_channels(read_storage(path));
      case FileFormat::text_table:
        return read_text_table(path);
      case FileFormat::bids_motion: {
        BidsMotion motion = read_bids_motion(path);
        Recording recording;
        recording.markers = std::move(motion.markers);
        recording.analog = std::move(motion.angles);
        recording.repairs = std::move(motion.repairs);
        return recording;
      }
      case FileFormat::edf:
        return of_channels(read_edf(path));
      case FileFormat::anc:
        return of_channels(read_anc(path));
      case FileFormat::mesh_vtp:
      case FileFormat::mesh_stl:
      case FileFormat::mesh_obj:
      case FileFormat::model:
      case FileFormat::set_up:
      case FileFormat::toml:
        break;
    }
  }
  refuse_foreign_format(path);
  throw ReadError(path, 0, "recordings of kind '{}' are not known; known are {}", extension_of(path),
                  endings_text([](const FormatEntry& entry) { return is_recording(entry.format); }));
}

}  // namespace myoid::recording
