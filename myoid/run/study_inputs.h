#pragma once

#include <memory>
#include <string>
#include <vector>

#include "myoid/core/provenance.h"
#include "myoid/intake/norm.h"
#include "myoid/intake/trial_input.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// A true value of a virtual recording.
struct TrueValue {
  std::string muscle, parameter;
  double value = 0.0;
};

/// A study without its trials' recordings.
struct StudySource {
  Study study;  ///< A trial that pauses is replaced by its parts.
  std::string model_text;
  /// Without held mass; read once for all trials. Never null.
  std::shared_ptr<const model::BodyModel> model = std::make_shared<const model::BodyModel>();
  std::vector<TrueValue> truth;
  std::vector<Norm> norms;
  std::vector<InputFile> files;
};

/// All inputs of a study, as values.
struct StudyInputs {
  StudySource source;
  std::vector<TrialInput> trials;  ///< In the study's order.
};

/// Reads every file of a study; its model once. Throws as `run_study`.
[[nodiscard]] StudyInputs read_inputs(const Study& study);

/// Returns the inputs of a study whose trials are not files. Throws InvalidInput unless there is
/// one input per trial, and as `load_model`.
[[nodiscard]] StudyInputs in_memory(const Study& study, std::vector<TrialInput> trials);

}  // namespace myoid
