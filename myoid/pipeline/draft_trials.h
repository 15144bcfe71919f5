#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "myoid/pipeline/draft_recordings.h"
#include "myoid/pipeline/draft_text.h"

namespace myoid::pipeline {

/// The [[trial]] tables of a draft: joint angles or markers with the EMG of the same name, then EMG
/// alone as maximal contractions; what each is for is guessed from its name. `relative` gives a
/// path as the study writes it. Marks what was taken.
void draft_trials(std::vector<FoundRecording>& found,
                  const std::function<std::string(const std::filesystem::path&)>& relative,
                  bool own_model,
                  DraftText& out);

}  // namespace myoid::pipeline
