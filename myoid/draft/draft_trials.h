#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "myoid/draft/draft_recordings.h"
#include "myoid/draft/draft_text.h"

namespace myoid {

/// The [[trial]] tables of a draft: joint angles or markers with the EMG of the same name, then EMG
/// alone: a maximal contraction if it is called one, else in remarks, for activation 1 must not be
/// what some movement reached. What each is for is guessed from its name. `external_loads` of a
/// trial's name go with it. `relative` gives a path as the study writes it. Marks what was taken.
void draft_trials(std::vector<FoundRecording>& found,
                  const std::vector<std::filesystem::path>& external_loads,
                  const std::function<std::string(const std::filesystem::path&)>& relative,
                  bool own_model,
                  DraftText& out);

}  // namespace myoid
