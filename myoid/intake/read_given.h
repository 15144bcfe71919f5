#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "myoid/intake/trial_clock.h"
#include "myoid/intake/trial_input.h"
#include "myoid/model/body_model.h"
#include "myoid/study/study.h"

namespace myoid {

/// Reads the stages that the files of a trial give, within the times of the trial, into `input.given`. Velocities that
/// no file gives are the rates of the quintic spline through the lengths. The lengths keep the times that all files and
/// the motion cover, because nothing is extrapolated; without a motion they become a motion without columns.
/// `remember` receives every file. Throws ReadError for a missing column, another unit, a value that is no number and
/// fewer than 10 samples; also as `check_clock`.
void read_given_stages(const Study& study,
                       const TrialSpec& trial,
                       const model::BodyModel& model,
                       const Remember& remember,
                       TrialInput& input);

/// A given stage with its file, for messages.
struct GivenFile {
  std::filesystem::path file;
  std::string_view holds;  ///< "lengths"
  const TimeSeries* series = nullptr;
};

/// Returns the files of the stages in `input.given`; velocities by a spline have none.
[[nodiscard]] std::vector<GivenFile> given_files(const TrialSpec& trial, const TrialInput& input);

}  // namespace myoid
