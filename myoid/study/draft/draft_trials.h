#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "myoid/study/draft/draft_recordings.h"
#include "myoid/study/draft/draft_text.h"

namespace myoid::study {

/// The facts of a draft that all its trials share.
struct TrialSurroundings {
  std::vector<std::filesystem::path> external_loads;
  std::vector<std::filesystem::path> torques;                         ///< Tables of joint torques.
  bool own_model = false;                                             ///< The study names a model file.
  bool raw_emg = true;                                                ///< Else envelopes.
  std::string person;                                                 ///< Whom most files name.
  std::vector<std::filesystem::path> unnamed;                         ///< Files that name nobody, beside these.
  std::function<std::string(const std::filesystem::path&)> relative;  ///< A path as in the study.
};

/// Returns true for a recording from whose markers a trial starts: no joint angles are in it or in
/// a recording of its name.
[[nodiscard]] bool starts_from_markers(const FoundRecording& recording, const std::vector<FoundRecording>& found);

/// Returns true if the study takes raw EMG, false for envelopes: the kind that most of its movements have, raw EMG
/// where as many have either.
[[nodiscard]] bool takes_raw_emg(const std::vector<FoundRecording>& found);

/// Writes the [[trial]] tables of a draft and marks the recordings that it takes: joint angles or markers with the EMG
/// of the same name, its external loads and, as a remark with a question, its table of torques; then EMG alone. EMG
/// alone is a maximal contraction where its name says so, and else a remark: a movement must not define activation 1.
/// The use of a trial follows from its name.
void draft_trials(std::vector<FoundRecording>& found, const TrialSurroundings& around, DraftText& out);

}  // namespace myoid::study
