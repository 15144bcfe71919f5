#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/program/steps/call.h"
#include "myoid/results/review/project_study.h"
#include "myoid/study/draft/study_draft.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Options of the draft of a study.toml.
struct InitOptions {
  Call call;
  std::string folder;  ///< Folder of study.toml: paths are relative to it. A name with .toml is the file itself.
  std::string study;   ///< The file; empty: study.toml in the folder.
  /// Recordings, or their folders, or the project of another program; empty: the folder itself.
  std::vector<std::string> from;
  std::string model;       ///< .osim; empty: the only one in the folders, else arm4.
  std::string coordinate;  ///< The joint; empty: guessed.
};
void visit(InitOptions& options, study::SettingVisitor& v);

/// Returns the study file that the options name.
[[nodiscard]] std::filesystem::path study_file(const InitOptions& options);

struct InitResult {
  study::StudyDraft draft;
  std::vector<results::ProjectStudy::MixedEmg> mixed;  ///< EMG of a project's muscles that take several channels.
  std::vector<Remark> remarks;
};

[[nodiscard]] InitResult init(const InitOptions& options);

/// Writes the study file.
void write_init(const InitResult& result, const std::filesystem::path& path, const Call& call);

}  // namespace myoid::program
