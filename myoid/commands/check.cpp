#include "myoid/commands/check.h"

#include <algorithm>

#include "myoid/checks/check_file.h"
#include "myoid/checks/check_study.h"
#include "myoid/commands/stage_input.h"
#include "myoid/files/file_format.h"
#include "myoid/recording/laboratory_up.h"
#include "myoid/study/read_study.h"

namespace myoid::commands {

CheckResult check(const CheckOptions& o) {
  CheckResult result;
  result.of_study = recording::format_of(o.input) == recording::FileFormat::toml;
  if (result.of_study) {
    Study study = read_study(o.input);
    restrict_trials(study, o.call.start_s, o.call.end_s);
    result.findings = check_study(study);
    result.trials = study.trials.size();
    result.muscles = study.muscles.size();
  } else if (recording::format_of(o.input) == recording::FileFormat::model) {
    result.findings = check_model_file(o.input);
  } else {
    std::optional<model::BodyModel> model;
    Remarks of_model(Call{});  // `check MODEL` tells them
    if (!o.model.empty()) model = load_model(o.model, "exact", of_model);
    result.findings = check_recording(o.input, recording::axis_vector(o.up), model ? &*model : nullptr);
  }
  result.errors = static_cast<std::size_t>(
      std::ranges::count_if(result.findings, [](const Remark& f) { return f.severity == Severity::error; }));
  return result;
}

}  // namespace myoid::commands
