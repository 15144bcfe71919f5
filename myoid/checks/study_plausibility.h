#pragma once

#include <string>
#include <vector>

#include "myoid/checks/same_recording.h"
#include "myoid/checks/trial_plausibility.h"
#include "myoid/core/remark.h"
#include "myoid/intake/emg_cover.h"
#include "myoid/intake/trial_input.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// Looks at the trials of a study one by one, then at all of them together. `check` says what it
/// finds; `run` refuses its errors and says its warnings.
class StudyPlausibility {
 public:
  /// The study and the model must outlive this.
  StudyPlausibility(const Study& study, const model::BodyModel& model);

  void look_at(const TrialSpec& trial, const TrialInput& input);
  /// What is wrong with the trials seen so far, one by one and together; what several have alike is
  /// said of the first, and the others are named.
  [[nodiscard]] std::vector<Remark> findings() const;

 private:
  const Study* study_;
  const model::BodyModel* model_;
  Capacities capacities_;
  std::vector<Remark> of_trials_;
  std::vector<TrialPrint> prints_;
  std::vector<TrialLengths> lengths_;
  double largest_emg_ = 0.0;  ///< Of all trials.
};

/// All of it: throws InvalidInput for the first error, adds the warnings to the trials'.
void require_plausible(const Study& study,
                       const model::BodyModel& model,
                       std::vector<TrialInput>& inputs);

}  // namespace myoid
