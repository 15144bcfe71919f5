#pragma once

#include <string>
#include <string_view>

#include "myoid/ground/files/name_ids.h"
#include "myoid/study/setting.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Returns the ids of the study's trials: names of their folders of results, and parts of the ids of their figures.
/// None is the name of another result.
[[nodiscard]] NameIds trial_ids(const Study& study);

/// Returns the name of the file of the model with identified numbers.
[[nodiscard]] std::string identified_model_name(const Study& study);

/// Refuses a text that cannot be a name, at the line of `key`.
void must_be_name(SettingVisitor& v, std::string_view key, const std::string& name);

}  // namespace myoid::study
