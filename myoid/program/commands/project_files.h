#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/opensim/projects/project.h"
#include "myoid/program/steps/call.h"
#include "myoid/results/review/project_study.h"

namespace myoid::program {

/// A project of another program with its study.
struct ProjectOfStudy {
  opensim::Project project;
  std::vector<std::string> joints;
  results::ProjectStudy study;
};

/// Reads a project and makes the study of these joints, or of those of its calibration. Throws InvalidInput if the path
/// holds no project.
[[nodiscard]] ProjectOfStudy project_of_study(const std::string& path,
                                              const std::vector<std::string>& joints,
                                              const std::filesystem::path& folder,
                                              Remarks& remarks);

/// Throws InvalidInput if the folder of results lies in the project's.
void refuse_inside(const std::filesystem::path& project, const std::filesystem::path& folder);

/// Returns the study as study.toml of this folder.
[[nodiscard]] std::string project_toml(const results::ProjectStudy& study, const std::filesystem::path& folder);

/// Writes the EMG of muscles that take several channels.
void write_mixed(const std::vector<results::ProjectStudy::MixedEmg>& mixed);

/// Writes study.toml into the folder, and the mixed EMG that the study names.
void write_project_study(const results::ProjectStudy& study, const std::filesystem::path& folder);

}  // namespace myoid::program
