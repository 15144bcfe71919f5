#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/draft/draft_persons.h"
#include "myoid/study/draft/draft_recordings.h"
#include "myoid/study/trial_up.h"

namespace myoid::study {

struct DraftOptions {
  std::vector<std::filesystem::path> from;     ///< Recordings, or folders of them.
  std::optional<std::filesystem::path> model;  ///< .osim; empty: the one in a folder, or arm4.
  std::string coordinate;                      ///< Empty: guessed.
};

/// Tables of torques, by their columns' names.
struct TorqueTables {
  std::vector<std::filesystem::path> of_joints;
  std::vector<std::string> of_no_joint;  ///< File names.
};

/// The upward axis, such as "z", and the sentence of the file that states it.
struct StatedUp {
  std::string axis, because;
};

/// The files of a draft as read: model, recordings, and what they tell together.
struct DraftSources {
  FoundBeside beside;
  std::optional<std::filesystem::path> model_file;  ///< Empty: arm4.
  std::vector<std::filesystem::path> other_models;  ///< Not chosen.
  body::BodyModel model;
  std::vector<FoundRecording> found;
  TorqueTables torques;
  OnePerson person;
  bool raw_emg = true;  ///< `takes_raw_emg`
  /// The name in the file and that in the model of markers that stand in the same place.
  std::map<std::string, std::string> renamed;
  Eigen::Index most_known = 0;         ///< Greatest number of a file's markers that the model knows.
  std::optional<UprightAxis> upright;  ///< By the markers.
  std::optional<StatedUp> stated_up;
  std::vector<Remark> remarks;  ///< On files, among them unreadable ones; each names its file.

  /// Returns true for EMG that the study does not take: raw, or envelopes.
  [[nodiscard]] bool of_other_kind(const FoundRecording& f) const { return !f.channels.empty() && f.raw != raw_emg; }
};

/// Returns a path as seen from the folder of a study.
[[nodiscard]] std::string path_from(const std::filesystem::path& folder, const std::filesystem::path& path);

/// Reads the model, or chooses it among those beside the recordings, and all recordings; of several persons it keeps
/// one. Remarks have paths as seen from `folder`. Throws as `draft_study`.
[[nodiscard]] DraftSources draft_sources(const std::filesystem::path& folder, const DraftOptions& options);

}  // namespace myoid::study
