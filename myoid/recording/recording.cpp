#include "myoid/recording/recording.h"

#include <utility>

#include <fmt/format.h>

#include "myoid/core/error.h"
#include "myoid/recording/anc_reader.h"
#include "myoid/recording/bids.h"
#include "myoid/recording/c3d_recording.h"
#include "myoid/recording/edf_reader.h"
#include "myoid/tables/emg_table.h"
#include "myoid/tables/marker_table.h"
#include "myoid/tables/nexus_section.h"
#include "myoid/tables/storage_reader.h"
#include "myoid/tables/trc_reader.h"

namespace myoid::recording {

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return extension;
}

std::string to_string(const Repair& repair) {
  return repair.line > 0 ? fmt::format("line {}: {}", repair.line, repair.message) : repair.message;
}

std::string to_string(const std::filesystem::path& path, const Repair& repair) {
  return repair.line > 0 ? fmt::format("{}:{}: {}", path.string(), repair.line, repair.message)
                         : fmt::format("{}: {}", path.string(), repair.message);
}

namespace {

bool is_table(std::string_view extension) {
  return extension == ".csv" || extension == ".tsv" || extension == ".txt" || extension == ".emt";
}

}  // namespace

MarkerFile read_markers(const std::filesystem::path& path) {
  const std::string extension = extension_of(path);
  if (extension == ".trc") {
    TrcFile file = read_trc(path);
    return {std::move(file.markers), std::move(file.unit), std::move(file.repairs), {}};
  }
  if (is_bids_motion(path)) {
    BidsMotion motion = read_bids_motion(path);
    if (motion.markers.frame_count() == 0)
      throw ReadError(path, 0, "there are no positions (POS) among the channels, so no markers");
    return {std::move(motion.markers), "m", std::move(motion.repairs), {}};
  }
  if (is_table(extension)) return parse_marker_table(read_text_file(path), path);
  if (extension != ".c3d") {
    throw ReadError(path, 0,
                    fmt::format("markers are read from .trc, .c3d, tables (.tsv, .csv, .txt, .emt) "
                                "and BIDS _motion.tsv, not from '{}'; export the recording as one "
                                "of these",
                                extension));
  }
  MarkerFile result;
  Recording file = read_c3d_markers(path, result.unit);
  if (file.markers.frame_count() == 0) throw ReadError(path, 0, "the C3D file holds no markers");
  result.markers = std::move(file.markers);
  result.repairs = std::move(file.repairs);
  result.screen_up_L = file.screen_up_L;
  return result;
}

std::vector<const AnalogChannels*> Recording::clocks() const {
  std::vector<const AnalogChannels*> list{&analog};
  for (const AnalogChannels& other : other_clocks) list.push_back(&other);
  return list;
}

ForcePlate Recording::force_plate(const PlateSetup& plate) const {
  return recording::force_plate(plate, analog.time_s(), analog.as_written(plate.channels));
}

std::vector<ForcePlate> Recording::force_plates() const {
  std::vector<ForcePlate> list;
  for (const PlateSetup& plate : plates) list.push_back(force_plate(plate));
  return list;
}

Recording read_recording(const std::filesystem::path& path) {
  if (std::error_code ignored; std::filesystem::is_directory(path, ignored)) {
    throw ReadError(path, 0,
                    std::filesystem::exists(path / "study.toml", ignored)
                        ? "this is a folder; did you mean the study.toml in it?"
                        : "this is a folder; name a file inside it");
  }
  const std::string extension = extension_of(path);
  Recording recording;
  if (extension == ".trc") {
    TrcFile file = read_trc(path);
    recording.markers = std::move(file.markers);
    recording.repairs = std::move(file.repairs);
  } else if (is_bids_motion(path)) {
    BidsMotion motion = read_bids_motion(path);
    recording.markers = std::move(motion.markers);
    recording.analog = std::move(motion.angles);
    recording.repairs = std::move(motion.repairs);
  } else if (extension == ".c3d") {
    recording = read_c3d_recording(path);
  } else if (extension == ".edf" || extension == ".bdf") {
    EdfFile file = read_edf(path);
    recording.analog = std::move(file.data);
    recording.events = std::move(file.events);
    recording.repairs = std::move(file.repairs);
  } else if (extension == ".anc") {
    AncFile file = read_anc(path);
    recording.analog = std::move(file.data);
    recording.repairs = std::move(file.repairs);
  } else if (is_table(extension)) {
    const std::string text = read_text_file(path);
    const bool markers = is_marker_table(text);
    if (markers) {
      MarkerFile file = parse_marker_table(text, path);
      recording.markers = std::move(file.markers);
      recording.repairs = std::move(file.repairs);
    }
    // Nexus writes its devices and the markers into one file.
    if (!markers || nexus_section(TableText(text), "Devices", path)) {
      CsvSeries file = parse_emg_table(text, path);
      recording.analog = std::move(file.data);
      for (ClockedChannels& group : file.other_clocks)
        recording.other_clocks.emplace_back(std::move(group.data));
      recording.events = std::move(file.events);
      recording.repairs.insert(recording.repairs.end(), file.repairs.begin(), file.repairs.end());
    }
  } else if (extension == ".sto" || extension == ".mot") {
    Storage file = read_storage(path);
    recording.analog = std::move(file.data);
    recording.repairs = std::move(file.repairs);
  } else {
    throw ReadError(
        path, 0,
        fmt::format("recordings of kind '{}' are not known; known are .c3d, .trc, .edf, "
                    ".bdf, .anc, .csv, .tsv, .txt, .emt, .sto and .mot",
                    extension));
  }
  return recording;
}

}  // namespace myoid::recording
