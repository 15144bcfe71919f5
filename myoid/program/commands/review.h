#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "myoid/program/steps/call.h"
#include "myoid/results/review/second_opinion.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// A second opinion on a calibration of another program.
struct ReviewOptions {
  Call call;
  std::string project;              ///< Folder, set-up or subject of CEINMS, CEINMS-RT or NMSM.
  std::vector<std::string> joints;  ///< Empty: those of the calibration.
  std::string folder = "review";    ///< Of the results.
};
void visit(ReviewOptions& options, study::SettingVisitor& v);

struct ReviewResult {
  results::SecondOpinion opinion;
  std::vector<Remark> remarks;
};

/// Reads the project, writes its study into the folder (study.toml, emg/), computes the project's torque by its own
/// law, and fits the study. Throws InvalidInput if the path holds no project, and for a folder of results inside it.
[[nodiscard]] ReviewResult review(const ReviewOptions& options);

/// Writes report.html, tables and figures.
void write_review(const ReviewResult& result, const std::filesystem::path& folder);

}  // namespace myoid::program
