#pragma once

#include <filesystem>
#include <string>

#include "myoid/ground/files/name_ids.h"
#include "myoid/lab/twin/synthetic_recording.h"

namespace myoid::lab {

/// The files that hold markers and EMG of a trial.
enum class RecordingFormat {
  text,  ///< TRIAL.trc and TRIAL_emg.sto
  c3d,   ///< TRIAL.c3d holds both; 32-bit reals.
};
inline constexpr std::string_view kRecordingFormatNames[] = {"trc", "c3d"};
constexpr ChoiceNames choice_names(RecordingFormat) { return kRecordingFormatNames; }

/// Returns the beginning of the names of each trial's files (TRIAL).
[[nodiscard]] NameIds file_stems(const VirtualRecording& recording);

/// Returns the study file for `myoid run`, with comments for a reader.
[[nodiscard]] std::string study_toml(const VirtualRecording& recording, RecordingFormat format = RecordingFormat::text);

/// Returns the true values: muscle, parameter, unit, value; the delay of the EMG has muscle "subject". Omits parameters
/// that exist only in the paper's curves if the person has other curves.
[[nodiscard]] std::string truth_csv(const VirtualRecording& recording);

/// Returns the true values in one line, for tables of many persons: seed, persons drawn, delay, and
/// the parameters of BIC, BRA, BRD and TRI. `truth_header` returns the names of the columns.
[[nodiscard]] std::string truth_row(const VirtualRecording& recording);
[[nodiscard]] std::string truth_header();

/// Returns all further values of the person and the instruments: of, quantity, unit, value.
[[nodiscard]] std::string person_csv(const VirtualRecording& recording);

struct WriteOptions {
  bool overwrite = false;
  RecordingFormat format = RecordingFormat::text;
};

/// Writes model.osim, study.toml, truth.csv, for each trial its markers and EMG and, with a dynamometer,
/// TRIAL_torque.sto, and under truth/ the true course. Creates the folder. Files are written whole or not at all;
/// study.toml comes last, so that a folder with one is complete. Throws InvalidInput if the folder holds files and not
/// `overwrite`, or cannot be written; also if the EMG's rate is no whole multiple of the cameras' for C3D.
void write_virtual_recording(const VirtualRecording& recording,
                             const std::filesystem::path& directory,
                             const WriteOptions& options = {});

}  // namespace myoid::lab
