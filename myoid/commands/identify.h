#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/commands/call.h"
#include "myoid/commands/solver_contests.h"
#include "myoid/core/provenance.h"
#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/identify_files/identify_data.h"
#include "myoid/intervals/result.h"
#include "myoid/methods/cross_validation.h"
#include "myoid/results/parameter_files.h"

namespace myoid::commands {

/// Muscle parameters straight from files.
struct IdentifyOptions {
  Call call;
  std::string muscles;            ///< muscles.csv: starting values, SI.
  IdentifySources files;          ///< Its `torque`, `motion_cutoff_hz` and times follow from below.
  double motion_cutoff_hz = 0.0;  ///< The angles of the motion files are smoothed; 0: not at all.
  std::string method = "torque";  ///< paper, force or torque.
  std::optional<double> delay_s;  ///< EMG delay that is held [s]; empty: estimated.
  std::string lag;                ///< automatic, delay or shared; empty: the method's own.
  bool no_priors = false;         ///< The data alone, plain least squares.
  std::vector<std::string> free_more;  ///< Further parameters to identify.
  /// Both sides of the residual are low-passed here [Hz]; 0: not at all.
  double residual_hz = identification::EstimatorOptions{}.residual_cutoff_hz.value_or(0.0);
  double max_rate_hz = identification::EstimatorOptions{}.max_rate_hz;  ///< Samples are thinned.
  std::string loss = "square";  ///< square, huber or cauchy.
  int bootstrap = 0;            ///< Replicates.
  bool profile = false;         ///< Profile likelihood of every parameter.
  bool compare_solvers = false;
  int starts = 0;               ///< Of the search; 0: one, of the comparison of solvers three.
  std::string folds = "trial";  ///< What is left out and predicted: trial, block or none.
};

struct IdentifyResult {
  identification::IdentificationResult fit;
  identification::StudyData data;  ///< As it was fitted.
  std::vector<identification::Fold> folds;
  std::string why_no_folds;  ///< Empty where there are some, or none were asked for.
  std::vector<NamedContest> contests;
  bool speed_may_be_free = false;  ///< muscles.csv leaves open whether v_max is known.
  ParameterContext told;
  Provenance provenance;
  std::vector<Remark> remarks;
};

/// Reads the files, fits by the method, predicts what is left out, and compares solvers where that
/// is asked for. Throws InvalidInput for options that the method or the files cannot fulfil.
[[nodiscard]] IdentifyResult identify(const IdentifyOptions& options);

/// parameters.json
[[nodiscard]] std::string identify_json(const IdentifyResult& result);

/// Writes parameters.json, parameters.csv, and where there are such results fold_parameters.csv and
/// solvers.csv.
void write_identify(const IdentifyResult& result, const std::filesystem::path& folder);

}  // namespace myoid::commands
