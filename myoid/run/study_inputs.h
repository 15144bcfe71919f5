#pragma once

#include <memory>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/provenance.h"
#include "myoid/study/intake/norm.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::run {

/// A true value of a virtual recording.
struct TrueValue {
  std::string muscle, parameter;
  double value = 0.0;
};

/// A study without its trials' recordings.
struct StudySource {
  study::Study study;  ///< A trial that pauses is replaced by its parts.
  std::string model_text;
  /// Without held mass; read once for all trials. Never null.
  std::shared_ptr<const body::BodyModel> model = std::make_shared<const body::BodyModel>();
  std::vector<TrueValue> truth;
  std::vector<study::Norm> norms;
  std::vector<InputFile> files;
  std::optional<Remark> unanswered;  ///< Questions of `init` that the study leaves open.
};

/// All inputs of a study, as values.
struct StudyInputs {
  StudySource source;
  std::vector<study::TrialInput> trials;  ///< In the study's order.
};

/// Reads every file of a study; its model once. Throws as `run_study`.
[[nodiscard]] StudyInputs read_inputs(const study::Study& study);

/// Returns the inputs of a study whose trials are not files. Throws InvalidInput unless there is
/// one input per trial, and as `load_model`.
[[nodiscard]] StudyInputs in_memory(const study::Study& study, std::vector<study::TrialInput> trials);

}  // namespace myoid::run
