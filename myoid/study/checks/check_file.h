#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "myoid/body/model/body_model.h"
#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/remark.h"

namespace myoid::study {

/// Checks a single recording (`read_recording`): markers, EMG in volts, force plates, and joint angles of a storage
/// file (`check_motion_file`). The upward axis is the stated one or else the file's (`recording::stand_plates`). The
/// findings come worst first. Throws ReadError.
[[nodiscard]] std::vector<Remark> check_recording(const std::filesystem::path& path,
                                                  const std::optional<Vec3>& stated_up_L = {},
                                                  const body::BodyModel* model = nullptr);

/// Checks the motion in a storage file: clock, unit of its angles, speeds, jumps and, with a model, the coordinates
/// that it lacks. Without a model the columns are angles if the header says inDegrees=yes, but for names as
/// "pelvis_tx", and nothing is known of others. Empty for a file of forces or EMG.
[[nodiscard]] std::vector<Remark> check_motion_file(const std::filesystem::path& path, const body::BodyModel* model);

/// Checks a model file: elements that are not supported, and numbers that no body has (body::implausible). Throws
/// ReadError and ModelError.
[[nodiscard]] std::vector<Remark> check_model_file(const std::filesystem::path& path);

}  // namespace myoid::study
