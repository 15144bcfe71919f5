#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "myoid/commands/call.h"
#include "myoid/identification/estimator_settings.h"
#include "myoid/identification/options.h"
#include "myoid/identification/study_data.h"
#include "myoid/identify_files/identify_data.h"
#include "myoid/identify_files/muscles_csv.h"
#include "myoid/study/setting.h"

namespace myoid::commands {

/// Muscle parameters straight from files. `visit` says what each option means.
struct IdentifyOptions {
  Call call;
  std::filesystem::path muscles;
  IdentifySources files;  ///< `identify` sets its `torque` and times from the other options.
  std::string method = "torque";
  std::optional<double> delay_s;
  std::string lag;  ///< Empty: the method's own.
  bool no_priors = false;
  std::vector<std::string> free_more;
  double residual_hz = identification::EstimatorOptions{}.residual_cutoff_hz.value_or(0.0);
  double max_rate_hz = identification::EstimatorOptions{}.max_rate_hz;
  std::string estimator = "least_squares";
  int posterior_draws = 0;
  std::string loss = "square";
  int bootstrap = 0;
  bool profile = false;
  bool compare_solvers = false;
  std::optional<int> starts;  ///< Empty: one, of the comparison of solvers three.
  std::string folds = "trial";
};

/// Names every option of `myoid identify` once: key, allowed values, default and meaning. The
/// command line, the check of the options and the guide's table rest on it.
void visit(IdentifyOptions& options, SettingVisitor& v);

/// Throws InvalidInput for numbers out of range and for words that name no method, loss, lag or
/// kind of folds.
void check_values(const IdentifyOptions& options);

/// Throws InvalidInput where the options ask for something that the method or the files cannot
/// give.
void refuse_impossible(const IdentifyOptions& options, const MuscleTable& table);

/// A sentence for each option that was given and changes nothing.
[[nodiscard]] std::vector<std::string> without_effect(const IdentifyOptions& options);

/// The estimator's options for data with these rules. Throws InvalidInput where two of the options
/// say how muscles follow their EMG.
[[nodiscard]] identification::EstimatorOptions estimator_options(
    const IdentifyOptions& options, const identification::StudyData& data, Remarks& remarks);

}  // namespace myoid::commands
