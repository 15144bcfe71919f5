#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "myoid/core/geometry.h"
#include "myoid/core/remark.h"
#include "myoid/study/study.h"

namespace myoid {

/// Checks a single recording (`read_recording`): markers, EMG in volts, force plates. The upward
/// axis is the stated one or else the file's (`recording::stand_plates`). Throws ReadError.
[[nodiscard]] std::vector<Remark> check_recording(const std::filesystem::path& path,
                                                  const std::optional<Vec3>& stated_up_L = {});

/// Reads every input of the study and checks the quality of every channel, units, rates, names, gaps, overlap of EMG
/// and motion, and the EMG's reference level. The findings come worst first. `run_study` accepts a study without an
/// error here. Errors in inputs are findings, not exceptions.
[[nodiscard]] std::vector<Remark> check_study(const Study& study);

}  // namespace myoid
