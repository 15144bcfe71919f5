#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/study/draft/draft_sources.h"

namespace myoid::study {

/// A study.toml to start from.
struct StudyDraft {
  std::string toml;
  std::vector<std::string> todo;  ///< The questions of its TODO lines.
  std::vector<Remark> remarks;    ///< On files, among them unreadable ones; each names its file.
};

/// Reads all recordings that are named or in the folders (with their folders, for BIDS), tells
/// markers, joint angles and EMG apart, pairs them by their names into trials, the channels with
/// the model's muscles by their names, and finds the vertical of the laboratory by laying
/// the model's markers on the first complete frame. Open questions stand in lines with TODO.
/// Paths are written relative to `folder`. Throws ReadError or ModelError if the model cannot be
/// read, InvalidInput if there is no recording.
[[nodiscard]] StudyDraft draft_study(const std::filesystem::path& folder, const DraftOptions& options);

}  // namespace myoid::study
