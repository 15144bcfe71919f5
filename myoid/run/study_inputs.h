#pragma once

#include <string>
#include <vector>

#include "myoid/core/provenance.h"
#include "myoid/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid {

/// A true value of a virtual recording.
struct TrueValue {
  std::string muscle, parameter;
  double value = 0.0;
};

/// What a study is computed from, as values.
struct StudyInputs {
  std::vector<TrialInput> trials;  ///< In the study's order.
  std::vector<TrueValue> truth;
  std::vector<InputFile> files;
};

/// Reads every file of a study; a trial that cannot be taken as one piece is replaced by its parts,
/// in the study too. Throws as `run_study`.
[[nodiscard]] StudyInputs read_inputs(Study& study);

}  // namespace myoid
