#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/opensim/projects/project.h"

namespace myoid::opensim {

/// Whose unknown the number of a muscle is.
enum class Sharing { single, groups, all };

/// A quantity that a calibration varies.
struct PlannedQuantity {
  MuscleQuantity quantity = MuscleQuantity::c1;
  Sharing sharing = Sharing::single;
  std::vector<std::vector<std::string>> groups = {};  ///< Of muscles, where groups share.
  std::optional<CalibrationBounds> bounds = {};       ///< Empty: not known.
  bool is_relative = false;                           ///< The bounds are factors of the start.
};

/// Gives the numbers of these muscles their unknowns and bounds. The bounds of a number that an earlier plan varied
/// too are those that both can reach: relative ranges multiply, of absolute ranges the last holds. A relative range
/// needs a start; without it, the bounds stay empty.
void plan(Project& project, const PlannedQuantity& planned, const std::vector<std::string>& muscles);

/// Gives the numbers of the project the starts of another subject's muscles.
void set_starts(Project& project, const std::vector<ProjectMuscle>& start);

/// Counts each number that differs from its start as calibrated, without bounds. Muscles whose factors are equal have
/// one unknown; lengths, angles and forces are each muscle's own.
void plan_changed_numbers(Project& project);

}  // namespace myoid::opensim
