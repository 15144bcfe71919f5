#pragma once

#include <map>
#include <string>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/checks/person_size.h"
#include "myoid/study/checks/same_recording.h"
#include "myoid/study/checks/trial_plausibility.h"
#include "myoid/study/checks/unlike_trials.h"
#include "myoid/study/intake/emg_cover.h"
#include "myoid/study/intake/trial_input.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Checks the trials of a study one by one, then all of them together. `check` reports the
/// findings; `run` stops at errors and reports warnings.
class StudyPlausibility {
 public:
  /// The study and the model must outlive this.
  StudyPlausibility(const Study& study, const body::BodyModel& model);

  void look_at(const TrialSpec& trial, const TrialInput& input);
  /// Returns the findings on the trials so far, one by one and together. A finding about several
  /// trials stands with the first, and names the others.
  [[nodiscard]] std::vector<Remark> findings() const;
  /// Returns the times of foreign contacts in the last trial that was looked at.
  [[nodiscard]] const std::vector<Stretch>& foreign_times() const { return foreign_times_; }

 private:
  void remember_extremes(const TrialSpec& trial, const TrialInput& input);

  const Study* study_;
  const body::BodyModel* model_;
  Capacities capacities_;
  std::vector<Remark> of_trials_;
  std::vector<Stretch> foreign_times_;
  std::vector<TrialPrint> prints_;
  std::vector<TrialLengths> lengths_;
  std::vector<TrialSize> sizes_;
  std::map<std::string, double> torque_peaks_nm_;  ///< Of `external_torque` over all efforts, by coordinate.
  AnglesOfStudy angles_;                           ///< Of `motion`.
  double largest_emg_ = 0.0;                       ///< Over all trials.
};

/// Runs all these checks: throws InvalidInput for the first error and adds the warnings to the trials'. Where a trial
/// excludes foreign contacts, their times become windows of its `exclude`.
void require_plausible(Study& study, const body::BodyModel& model, std::vector<TrialInput>& inputs);

}  // namespace myoid::study
