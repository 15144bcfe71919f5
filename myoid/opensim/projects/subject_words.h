#pragma once

#include <vector>

#include "myoid/opensim/projects/project.h"

namespace myoid::opensim {

/// The element of one number of a muscle.
struct NumberWord {
  const char* element;
  MuscleQuantity quantity;
  bool is_positive = false;  ///< Required, and above 0.
};

/// The names of the elements of a dialect's subject.
struct SubjectWords {
  Dialect dialect;
  const char *defaults, *curve, *muscles, *muscle, *dofs, *dof, *dof_muscles;
  std::vector<NumberWord> numbers;
  double angle_unit;  ///< [rad]
};

/// Returns the words of CEINMS or CEINMS-RT, the dialects that have a subject file.
[[nodiscard]] const SubjectWords& subject_words(Dialect dialect);

}  // namespace myoid::opensim
