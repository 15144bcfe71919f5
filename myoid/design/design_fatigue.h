#pragma once

#include <optional>
#include <vector>

#include "myoid/identification/study_data.h"
#include "myoid/muscle/fatigue.h"

namespace myoid {

/// Mean activation of each muscle over the persons who can do a movement, per half second.
struct Effort {
  std::vector<std::vector<double>> activation;  ///< Per muscle.
};

/// Of a movement's performances; nothing stands for a person who cannot do it.
[[nodiscard]] Effort effort_of(
    const std::vector<std::optional<identification::TrialData>>& performances,
    const std::vector<identification::MuscleSetup>& muscles,
    double duration_s);

/// Share of the most tired muscle that is fatigued after doing this movement alone, from rest.
[[nodiscard]] double fatigued_share(const Effort& effort,
                                    const muscle::FatigueRates<double>& rates);

/// A rest before a movement, and the share of the most tired muscle that is fatigued at its end.
struct PlannedRest {
  double before_s = 0.0;
  double fatigued_share = 0.0;
};

/// Rests before movements that are done one after the other, by steps of 15 s, so that no muscle
/// ends one with more than `budget` fatigued, or the rest has become half an hour.
[[nodiscard]] std::vector<PlannedRest> plan_rests(const std::vector<const Effort*>& efforts,
                                                  double budget,
                                                  const muscle::FatigueRates<double>& rates);

}  // namespace myoid
