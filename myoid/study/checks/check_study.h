#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "myoid/ground/core/geometry.h"
#include "myoid/ground/core/remark.h"
#include "myoid/study/study.h"

namespace myoid::study {

/// Reads every input of the study and checks the quality of every channel, units, rates, names, gaps, overlap of EMG
/// and motion, and the EMG's reference level. The findings come worst first. `run_study` accepts a study without an
/// error here. Errors in inputs are findings, not exceptions.
[[nodiscard]] std::vector<Remark> check_study(const Study& study);

}  // namespace myoid::study
