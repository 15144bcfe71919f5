#include "myoid/program/commands/check.h"

#include <algorithm>
#include <system_error>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/program/steps/check_options.h"
#include "myoid/program/steps/stage_input.h"
#include "myoid/program/steps/stage_options.h"
#include "myoid/recording/laboratory_up.h"
#include "myoid/study/checks/check_file.h"
#include "myoid/study/checks/check_study.h"
#include "myoid/study/read_study.h"
#include "myoid/study/run_record.h"

namespace myoid::program {

void visit(CheckOptions& o, study::SettingVisitor& v) {
  static const std::string kInputs = "study.toml, a model (.osim), or a single recording: " +
                                     endings_text([](const FormatEntry& entry) { return is_recording(entry.format); });
  v.path("study", o.input, {.says = kInputs, .option = {.by_place = true}});
  v.path("model", o.model,
         {.says = "Model of a motion (.mot, .sto), whose columns are its coordinates: a file (.osim), or arm4."});
  visit_up(
      o.up, v,
      {.says = "Vertical of a single recording's laboratory, for its force plates.", .otherwise = "as the file says"});
}

CheckResult check(const CheckOptions& o) {
  check_options(o);
  CheckResult result;
  result.of_study = format_of(o.input) == FileFormat::toml;
  if (result.of_study) {
    study::Study study = study::read_study(o.input);
    study::restrict_trials(study, o.call.start_s, o.call.end_s);
    result.findings = study::check_study(study);
    result.trials = study.trials.size();
    result.muscles = study.muscles.size();
  } else if (format_of(o.input) == FileFormat::model) {
    result.findings = study::check_model_file(o.input);
  } else {
    std::optional<body::BodyModel> model;
    Remarks of_model(Call{});  // `check MODEL` tells them
    if (!o.model.empty()) model = load_model(o.model, body::Compatibility::exact, of_model);
    result.findings = study::check_recording(o.input, recording::axis_vector(o.up), model ? &*model : nullptr);
  }
  result.errors = static_cast<std::size_t>(
      std::ranges::count_if(result.findings, [](const Remark& f) { return f.severity == Severity::error; }));
  return result;
}

namespace {

namespace fs = std::filesystem;

/// Returns true for the results of a run of this study.
bool holds_run_of(const fs::path& folder, const fs::path& study) {
  try {
    std::error_code ignored;
    return fs::equivalent(study::read_run_record(folder).study, study, ignored);
  } catch (const ReadError&) {
    return false;
  }
}

}  // namespace

ResultsPlace place_for_results(const fs::path& study) {
  for (int i = 1;; ++i) {
    const fs::path folder = study.parent_path() / (i == 1 ? "results" : fmt::format("results-{}", i));
    std::error_code ignored;
    if (!fs::exists(folder, ignored) || (fs::is_directory(folder, ignored) && fs::is_empty(folder, ignored)))
      return {folder};
    if (holds_run_of(folder, study)) return {folder, true};
  }
}

}  // namespace myoid::program
