#pragma once

#include <optional>
#include <vector>

#include "myoid/ground/core/remark.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Returns true if the study says which forces act on the person in this trial beside gravity: external_loads,
/// force_plates, load_cell, external_torque, or held_mass_kg, also 0.
[[nodiscard]] bool states_loads(const TrialSpec& trial);

/// Returns a warning that names the trials with a torque that is fitted or predicted whose loads are not stated.
[[nodiscard]] std::optional<Remark> unstated_loads(const std::vector<TrialSpec>& trials);

}  // namespace myoid::study
