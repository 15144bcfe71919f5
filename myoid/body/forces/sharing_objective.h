#pragma once

#include <string_view>

#include "myoid/ground/core/choice.h"

namespace myoid::body {

/// The quantity whose sum of powers p over the muscles force sharing makes least: each muscle's
/// activation counts with a weight w, relative to its mean over the muscles.
enum class SharingObjective {
  activation,  ///< w = 1.
  force,       ///< w = F_opt^p
  stress,      ///< w = (F_opt / F_max)^p
};
inline constexpr std::string_view kSharingObjectiveNames[] = {"activation", "force", "stress"};
constexpr ChoiceNames choice_names(SharingObjective) { return kSharingObjectiveNames; }

}  // namespace myoid::body
