#pragma once

#include <filesystem>
#include <string>

#include "myoid/twin/synthetic_recording.h"

namespace myoid::twin {

/// Which files hold markers and EMG of a trial.
enum class RecordingFormat {
  text,  ///< TRIAL.trc and TRIAL_emg.sto
  c3d,   ///< TRIAL.c3d holds both; 32-bit reals.
};

/// The study file that `myoid run` takes, with comments for a reader.
[[nodiscard]] std::string study_toml(const VirtualRecording& recording,
                                     RecordingFormat format = RecordingFormat::text);

/// The true values: muscle, parameter, unit, value; the delay of the EMG has muscle "subject".
/// Parameters that other curves than the paper's do not have are left out.
[[nodiscard]] std::string truth_csv(const VirtualRecording& recording);

/// The same in one line, for tables of many persons: seed, persons drawn, delay, and the parameters
/// of BIC, BRA, BRD and TRI; and the names of its columns.
[[nodiscard]] std::string truth_row(const VirtualRecording& recording);
[[nodiscard]] std::string truth_header();

/// Everything else about the person and the instruments: of, quantity, unit, value.
[[nodiscard]] std::string person_csv(const VirtualRecording& recording);

struct WriteOptions {
  bool overwrite = false;
  RecordingFormat format = RecordingFormat::text;
};

/// Writes model.osim, study.toml, truth.csv, per trial its markers and EMG and, where a dynamometer
/// took part, TRIAL_torque.sto, and under truth/ what really happened. Creates the folder. Files
/// are written whole or not at all; study.toml comes last, so that a folder with one is complete.
/// Throws InvalidInput if the folder holds files and not `overwrite`, or cannot be written; if C3D
/// is asked for and the EMG's rate is no whole multiple of the cameras'.
void write_virtual_recording(const VirtualRecording& recording,
                             const std::filesystem::path& directory,
                             const WriteOptions& options = {});

}  // namespace myoid::twin
