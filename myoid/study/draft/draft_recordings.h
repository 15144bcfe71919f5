#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/time_series.h"
#include "myoid/ground/files/marker_series.h"
#include "myoid/recording/c3d_recording.h"
#include "myoid/recording/force_plate.h"
#include "myoid/study/draft/draft_loads.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// The content of a file that a study can use.
struct FoundRecording {
  std::filesystem::path path;
  std::string stem;                   ///< Small letters, words like "emg" and "markers" at its end removed.
  MarkerSeries markers;               ///< Empty: none.
  std::vector<std::string> angles;    ///< Coordinates of the model.
  TimeSeries motion;                  ///< Their values.
  std::vector<std::string> channels;  ///< EMG.
  bool has_unit = true;               ///< The EMG has a unit.
  bool raw = true;
  int plates = 0;
  LoadHints loads{};
  recording::StatedBody body;  ///< Body mass and height that the file states.
  bool motion_taken = false;
  bool emg_taken = false;
};

/// The other files in the folders of the recordings.
struct FoundBeside {
  std::vector<std::filesystem::path> models;          ///< .osim
  std::vector<std::filesystem::path> external_loads;  ///< .xml with <ExternalLoads>.
  std::vector<std::filesystem::path> results;         ///< Folders of this program's results; no recordings.
};

/// Finds the recordings among the files and in the folders and their folders, by name. Models and
/// loads are added to `beside`. A folder that its list names the result of an identification, or the truth of a virtual
/// recording, is left out and added there, too.
[[nodiscard]] std::vector<std::filesystem::path> recordings_in(const std::vector<std::filesystem::path>& from,
                                                               FoundBeside& beside);

/// Returns the data file that an ExternalLoads file names; empty if it names none.
[[nodiscard]] std::filesystem::path loads_data_file(const std::filesystem::path& external_loads);

/// Returns the name of the trial that a file belongs to: small letters, without words for the kind
/// of file at its begin and end ("flex_2kg" of "Flex_2kg_emg_raw.sto", "walk" of "grf_walk.xml"). A file whose name
/// says nothing but the kind belongs to the trial that its folder names ("walk36" of "walk36/ik.sto").
[[nodiscard]] std::string trial_stem(const std::filesystem::path& path);

/// Returns the use that the trial's name suggests: "mvc", "static", "passive", else "calibration".
[[nodiscard]] Use guessed_use(const std::string& stem);

/// Adds the channels of a file that may be EMG (`recording::emg_channels`), or all channels of a file with EMG in its
/// name. Raw EMG crosses its median more than 30 times a second, an envelope does not.
void find_emg(const std::filesystem::path& path,
              const TimeSeries& analog,
              const std::vector<recording::PlateSetup>& plates,
              FoundRecording& found);

}  // namespace myoid::study
