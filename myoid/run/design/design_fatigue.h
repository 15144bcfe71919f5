#pragma once

#include <optional>
#include <vector>

#include "myoid/fit/measurement/study_data.h"
#include "myoid/muscle/fatigue.h"

namespace myoid::run {

/// Mean activation of each muscle over the persons who can do a movement, per half second.
struct Effort {
  std::vector<std::vector<double>> activation;  ///< One list per muscle.
};

/// Returns the effort of a movement's performances; an empty performance belongs to a person who
/// cannot do the movement.
[[nodiscard]] Effort effort_of(const std::vector<std::optional<fit::TrialData>>& performances,
                               const std::vector<fit::MuscleSetup>& muscles,
                               double duration_s);

/// Returns the fatigued share of the most tired muscle after this movement alone, from rest.
[[nodiscard]] double fatigued_share(const Effort& effort, const muscle::FatigueRates<double>& rates);

/// A rest before a movement, and the most tired muscle's fatigued share at the movement's end.
struct PlannedRest {
  double before_s = 0.0;
  double fatigued_share = 0.0;
};

/// Plans rests between successive movements in steps of 15 s, so that no muscle is fatigued by more
/// than `budget` at the end of a movement. No rest is longer than half an hour.
[[nodiscard]] std::vector<PlannedRest> plan_rests(const std::vector<const Effort*>& efforts,
                                                  double budget,
                                                  const muscle::FatigueRates<double>& rates);

}  // namespace myoid::run
