#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/measurement/options.h"
#include "myoid/program/steps/call.h"
#include "myoid/results/exports/law_differences.h"
#include "myoid/run/identify_files/identify_sources.h"
#include "myoid/run/identify_files/muscles_csv.h"
#include "myoid/study/setting.h"

namespace myoid::program {

/// Options of the identification of muscle parameters from files. `visit` explains each option.
struct IdentifyOptions {
  Call call;
  std::string from;    ///< Project of another program, in place of muscles.csv and all files.
  std::string folder;  ///< Of the results.
  std::filesystem::path muscles;
  run::IdentifySources files;
  fit::Method method = fit::Method::torque;
  std::optional<double> delay_s;
  std::optional<fit::LagChoice> lag;  ///< Empty: the method's own.
  std::vector<std::string> free_more, hold;
  std::optional<std::filesystem::path> beliefs;  ///< Table [beliefs] of a study file.
  int posterior_draws = 0;
  bool compare_solvers = false;
  std::optional<int> starts;  ///< Method `paper`; empty: one, and three for the comparison of solvers.
  std::optional<fit::FoldKind> folds = fit::FoldKind::trial;  ///< Empty: none.
  std::vector<results::ExportFormat> exports;                 ///< Forms for other programs.
  bool own_scales = false;  ///< Muscles that share an electrode have scales of their own.
  std::string mat;          ///< File of the results for MATLAB; empty: not written.
};

/// Visits every option of `myoid identify` once: key, allowed values, default and meaning. The
/// command line, the check of the options and the guide's table use this list.
void visit(IdentifyOptions& options, study::SettingVisitor& v);

/// Throws InvalidInput if the options ask for a result that the method or the files cannot give.
void refuse_impossible(const IdentifyOptions& options, const run::MuscleTable& table);

/// Returns a sentence for each given option that has no effect.
[[nodiscard]] std::vector<std::string> without_effect(const IdentifyOptions& options);

}  // namespace myoid::program
