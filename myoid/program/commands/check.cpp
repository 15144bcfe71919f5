#include "myoid/program/commands/check.h"

#include <algorithm>

#include "myoid/ground/files/file_format.h"
#include "myoid/program/commands/stage_input.h"
#include "myoid/recording/laboratory_up.h"
#include "myoid/study/checks/check_file.h"
#include "myoid/study/checks/check_study.h"
#include "myoid/study/read_study.h"

namespace myoid::program {

CheckResult check(const CheckOptions& o) {
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
    if (!o.model.empty()) model = load_model(o.model, "exact", of_model);
    result.findings = study::check_recording(o.input, recording::axis_vector(o.up), model ? &*model : nullptr);
  }
  result.errors = static_cast<std::size_t>(
      std::ranges::count_if(result.findings, [](const Remark& f) { return f.severity == Severity::error; }));
  return result;
}

}  // namespace myoid::program
