#pragma once

#include <optional>
#include <string>
#include <vector>

#include "myoid/fit/measurement/options.h"
#include "myoid/fit/measurement/parameter_fields.h"
#include "myoid/fit/measurement/study_data.h"

namespace myoid::fit {

/// One number of a study and its decisions: free or held, value, bounds, prior. All values are in
/// the parameter's unit. Each free slot becomes an `Unknown`.
struct ParameterSlot {
  const ParameterField* field = nullptr;
  int owner = 0;
  bool free = false;
  double value = 0.0;
  /// A rule gives the start; otherwise an unknown starts at its prior's mean.
  bool start_is_given = false;
  muscle::Range usual;  ///< Bounds unless the study gives others.
  muscle::Range bounds;
  bool bounds_are_given = false;  ///< The study gives the bounds.
  std::optional<Prior> prior;
  bool prior_is_given = false;  ///< The study gives the prior, in place of the literature's.
  double common_sd = 0.0;       ///< Unknown::common_sd, unless the study gives the prior.
  std::vector<int> tied;        ///< Owners whose numbers this slot moves too; empty: none.
  bool follows = false;         ///< Another owner's unknown moves it.
};

/// Names of the owners of numbers, in order.
struct OwnerNames {
  std::vector<std::string> muscles, channels, joints;
  [[nodiscard]] const std::vector<std::string>& of(Scope scope) const;
};

/// The slots of all numbers of a study, field by field, owner by owner.
struct ParameterSlots {
  std::vector<ParameterSlot> slots;
  std::vector<double> slope_ratio;  ///< Per muscle; 0: the product is the parameter.
};

/// Decides every number by the options, the muscles' set-ups and the starting `values`.
[[nodiscard]] ParameterSlots default_slots(const StudyData& data,
                                           const EstimatorOptions& options,
                                           const ModelValues& values,
                                           const OwnerNames& names);

/// Applies the study's rules in order; later ones win. Throws InvalidInput for an owner or
/// parameter that does not exist.
void apply_rules(const std::vector<ParameterRule>& rules, const OwnerNames& names, ParameterSlots& of_study);

}  // namespace myoid::fit
