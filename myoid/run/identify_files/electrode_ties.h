#pragma once

#include <string>
#include <vector>

#include "myoid/fit/measurement/study_data.h"

namespace myoid::run {

/// Rules for muscles that share an electrode: their ratios to the starting values are one unknown for each parameter of
/// the law. One electrode shows one effort, so that nothing but small differences of lengths and moment arms could tell
/// such muscles apart. A muscle whose parameter is held, bounded or has a prior of its own keeps it to itself.
struct ElectrodeTies {
  std::vector<fit::ParameterRule> rules;
  std::string says;  ///< Which muscles share; empty: none.
};
[[nodiscard]] ElectrodeTies electrode_ties(const std::vector<fit::MuscleSetup>& muscles);

}  // namespace myoid::run
