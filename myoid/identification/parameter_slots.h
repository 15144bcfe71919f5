#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/identification/options.h"
#include "myoid/identification/parameter_fields.h"
#include "myoid/identification/study_data.h"

namespace myoid::identification {

/// What is decided of one number before the unknowns are made.
struct ParameterSlot {
  const ParameterField* field = nullptr;
  int owner = 0;
  bool free = false;
  double value = 0.0;
  bool start_is_given = false;  ///< By a rule; else an unknown begins at its prior's mean.
  muscle::Range usual;          ///< Bounds unless the study gives others.
  muscle::Range bounds;
  bool bounds_are_given = false;  ///< By the study.
  std::optional<Prior> prior;
  bool prior_is_given = false;  ///< By the study: not the literature's.
  std::vector<int> tied;        ///< Owners that go with it; empty: none.
  bool follows = false;         ///< Another owner's unknown moves it.
};

/// Names of those who own numbers, in order.
struct OwnerNames {
  std::vector<std::string> muscles, channels, joints;
  [[nodiscard]] const std::vector<std::string>& of(Scope scope) const;
};

/// Of every number of a study: field by field, owner by owner.
struct ParameterSlots {
  std::vector<ParameterSlot> slots;
  std::vector<double> slope_ratio;  ///< Per muscle; 0: the product is the parameter.
};

/// What is free and expected unless the study says otherwise; `values`: before the search.
[[nodiscard]] ParameterSlots default_slots(const StudyData& data,
                                           const EstimatorOptions& options,
                                           const ModelValues& values,
                                           const OwnerNames& names);

/// The study's rules, in order: later ones win. Throws InvalidInput for names that refer to
/// nothing.
void apply_rules(const std::vector<ParameterRule>& rules,
                 const OwnerNames& owners_of,
                 ParameterSlots& of_study);

}  // namespace myoid::identification
