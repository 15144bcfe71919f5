#include "myoid/ground/files/file_format.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {
namespace {

std::string listed(const std::vector<std::string_view>& endings) {
  if (endings.size() < 2) return fmt::format("{}", fmt::join(endings, ""));
  return fmt::format("{} and {}", fmt::join(endings.begin(), endings.end() - 1, ", "), endings.back());
}

std::vector<std::string_view> written_endings() {
  std::vector<std::string_view> endings;
  for (const FormatEntry& entry : file_formats()) {
    if (is_recording(entry.format)) endings.insert(endings.end(), entry.written.begin(), entry.written.end());
  }
  return endings;
}

/// The longest ending of a name that the table has, with its row; without one the row is null.
struct NamedEnding {
  const FormatEntry* entry = nullptr;
  std::string_view ending;
};

NamedEnding named_ending(const std::filesystem::path& path) {
  const std::string name = small_letters(path.filename().string());
  const std::string extension = extension_of(path);
  NamedEnding best;
  for (const FormatEntry& entry : file_formats()) {
    for (const std::string_view ending : entry.endings) {
      const bool fits = ending.starts_with('.') ? extension == ending : name.ends_with(ending);
      if (fits && ending.size() > best.ending.size()) best = {&entry, ending};
    }
  }
  return best;
}

FormatEntry mesh(FileFormat format, std::string_view ending) {
  return {.format = format,
          .endings = {ending},
          .kind = "a mesh",
          .holds = "the surface of a bone",
          .reader = "recording/mesh_reader"};
}

}  // namespace

const std::vector<FormatEntry>& file_formats() {
  using F = FileFormat;
  static const std::vector<FormatEntry> table{
      {.format = F::c3d,
       .endings = {".c3d"},
       .written = {".c3d"},
       .kind = "a recording",
       .holds = "markers, analog channels, force plates, events",
       .reader = "recording/c3d/c3d_reader",
       .writer = "recording/c3d/c3d_writer",
       .markers = true,
       .channels = true,
       .emg = true},
      {.format = F::trc,
       .endings = {".trc"},
       .written = {".trc"},
       .kind = "markers",
       .holds = "markers",
       .reader = "recording/trc_reader",
       .writer = "recording/trc_writer",
       .markers = true},
      {.format = F::storage,
       .endings = {".sto", ".mot"},
       .written = {".sto", ".mot"},
       .kind = "a time series",
       .holds = "angles, torques, EMG, activations: anything over time",
       .reader = "recording/tables/storage_reader",
       .writer = "recording/tables/storage_writer",
       .channels = true,
       .emg = true},
      {.format = F::text_table,
       .endings = {".csv", ".tsv", ".txt", ".emt"},
       .written = {".csv"},
       .kind = "a table",
       .holds = "channels or markers over time, as programs export them; tables without a clock",
       .reader = "recording/tables/text_table",
       .writer = "recording/tables/storage_writer",
       .markers = true,
       .channels = true,
       .emg = true},
      {.format = F::bids_motion,
       .endings = {"_motion.tsv"},
       .kind = "a motion of BIDS",
       .holds = "markers, joint angles",
       .reader = "recording/bids",
       .markers = true,
       .channels = true},
      {.format = F::edf,
       .endings = {".edf", ".bdf"},
       .kind = "a recording",
       .holds = "EMG, events",
       .reader = "recording/edf_reader",
       .channels = true,
       .emg = true},
      {.format = F::anc,
       .endings = {".anc"},
       .kind = "analog channels",
       .holds = "analog channels",
       .reader = "recording/anc_reader",
       .channels = true,
       .emg = true},
      mesh(F::mesh_vtp, ".vtp"),
      mesh(F::mesh_stl, ".stl"),
      mesh(F::mesh_obj, ".obj"),
      {.format = F::model,
       .endings = {".osim"},
       .written = {".osim"},
       .kind = "a model",
       .holds = "bodies, joints, muscles, markers",
       .reader = "body/osim/osim_reader",
       .writer = "body/osim/osim_writer"},
      {.format = F::set_up,
       .endings = {".xml"},
       .kind = "a set-up",
       .holds = "the set-up of a tool of OpenSim, external loads",
       .reader = "opensim/opensim_setup"},
      {.format = F::toml,
       .endings = {".toml"},
       .written = {".toml"},
       .kind = "a study",
       .holds = "a study, the protocol of a virtual recording, an isolated muscle",
       .reader = "ground/files/toml_table",
       .writer = "ground/files/quoted_text"},
  };
  return table;
}

const FormatEntry& format_entry(FileFormat format) {
  const auto& table = file_formats();
  return *std::find_if(table.begin(), table.end(), [&](const FormatEntry& entry) { return entry.format == format; });
}

std::optional<FileFormat> format_of(const std::filesystem::path& path) {
  const FormatEntry* entry = named_ending(path).entry;
  return entry == nullptr ? std::nullopt : std::optional(entry->format);
}

bool is_recording(FileFormat format) {
  const FormatEntry& entry = format_entry(format);
  return entry.markers || entry.channels;
}

std::string extension_of(const std::filesystem::path& path) { return small_letters(path.extension().string()); }

std::string endings_text(bool (*accepts)(const FormatEntry&)) {
  std::vector<std::string_view> endings;
  for (const FormatEntry& entry : file_formats()) {
    if (accepts(entry)) endings.insert(endings.end(), entry.endings.begin(), entry.endings.end());
  }
  return listed(endings);
}

std::string emg_endings_text() {
  return endings_text([](const FormatEntry& entry) { return entry.emg; });
}

std::string written_endings_text() { return listed(written_endings()); }

bool is_written_ending(std::string_view ending) {
  const auto endings = written_endings();
  return std::find(endings.begin(), endings.end(), ending) != endings.end();
}

void refuse_foreign_format(const std::filesystem::path& path) {
  struct Foreign {
    std::string_view ending, program, next;
  };
  static constexpr std::array kForeign{
      Foreign{".acq", "AcqKnowledge (BIOPAC)", "save it there as text (.txt, with header and channel units)"},
      Foreign{".adicht", "LabChart", "export it there as text (.txt, with times and block headers)"},
      Foreign{".mat", "MATLAB", "write its numbers there with writetable as .csv, a column 'time' first"},
      Foreign{".xlsx", "Excel", "save the sheet there as 'CSV UTF-8' (.csv)"},
      Foreign{".xls", "Excel", "save the sheet there as 'CSV UTF-8' (.csv)"},
      Foreign{".ods", "LibreOffice", "save the sheet there as .csv"},
      Foreign{".mvnx", "Xsens MVN", "export the recording there as .c3d"},
      Foreign{".mvn", "Xsens MVN", "export the recording there as .c3d"},
      Foreign{".xdf", "LabStreamingLayer",
              "load it with pyxdf in Python and write each stream as .csv, with a column 'time'"},
      Foreign{".hpf", "EMGworks (Delsys)", "export it there as .csv"},
      Foreign{".shpf", "Trigno Discover (Delsys)", "export it there as .csv or .c3d"},
      Foreign{".qtm", "Qualisys Track Manager", "export it there as .c3d"},
      Foreign{".tak", "Motive (OptiTrack)", "export it there as .c3d or .csv"},
      Foreign{".x1d", "Vicon Nexus", "export the trial there as .c3d"},
      Foreign{".x2d", "Vicon Nexus", "export the trial there as .c3d"},
      Foreign{".bvh", "motion capture for animation", "export the markers as .c3d or .trc"},
      Foreign{".fbx", "motion capture for animation", "export the markers as .c3d or .trc"},
      Foreign{".h5", "HDF5", "write its numbers as .csv, with a column 'time'"},
      Foreign{".hdf5", "HDF5", "write its numbers as .csv, with a column 'time'"},
      Foreign{".vhdr", "BrainVision", "export it as .edf"},
      Foreign{".slk", "Noraxon (SYLK)", "export the record there as .csv or .c3d"},
      Foreign{".forces", "Motion Analysis", "export the trial there as .c3d, or rename the file to end in .txt"},
      Foreign{".anb", "Motion Analysis", "export the trial there as .c3d or .anc"},
      Foreign{".trb", "Motion Analysis", "export the trial there as .c3d or .trc"},
      Foreign{".tdf", "BTS", "export the tracks there as .emt or .c3d"},
      Foreign{".lvm", "LabVIEW", "it is a table: rename it to .txt"},
      Foreign{".smr", "Spike2", "export it there as spreadsheet text (.txt), with a column of times"},
      Foreign{".smrx", "Spike2", "export it there as spreadsheet text (.txt), with a column of times"},
      Foreign{".parquet", "Parquet", "write its numbers as .csv, with a column 'time'"},
      Foreign{".poly5", "TMSi", "export it as .edf"},
      Foreign{".otb+", "OT BioLab", "export it there as .edf or .csv"},
      Foreign{".zip", "an archive", "unpack it"},
      Foreign{".gz", "an archive", "unpack it"}};
  const std::string ending = extension_of(path);
  const auto found = std::ranges::find(kForeign, ending, &Foreign::ending);
  if (found != kForeign.end())
    throw ReadError(path, 0, "files of {} ({}) are not read; {}", found->program, ending, found->next);
}

std::string wrong_kind(const std::filesystem::path& path,
                       const std::vector<FileFormat>& wanted,
                       std::string_view expected) {
  const auto [entry, ending] = named_ending(path);
  if (entry == nullptr || std::find(wanted.begin(), wanted.end(), entry->format) != wanted.end()) return {};
  return fmt::format("this is a {} file ({}), but {} is expected here: were two options mixed up?", ending, entry->kind,
                     expected);
}

}  // namespace myoid::inline ground
