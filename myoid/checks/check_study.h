#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/core/remark.h"
#include "myoid/study/study.h"

namespace myoid {

/// What a single recording shows (`read_recording`): markers, EMG in volts, force plates, with up
/// as stated, else as the file says (`recording::stand_plates`). Throws ReadError.
[[nodiscard]] std::vector<Remark> check_recording(const std::filesystem::path& path,
                                                  const std::optional<Vec3>& stated_up_L = {});

/// Reads every input of the study, looks at the quality of every channel, checks units, rates,
/// names, gaps, overlap of EMG and motion, and the level that EMG is measured against; worst first.
/// A study without an error here is not refused by `run_study`. Does not throw for what is wrong
/// with an input: that is a finding.
[[nodiscard]] std::vector<Remark> check_study(const Study& study);

}  // namespace myoid
