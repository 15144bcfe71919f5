#pragma once

#include <string_view>
#include <vector>

namespace myoid::inline ground {

/// Returns the names of the files and folders that `run` and `predict` write beside the folders of trials.
[[nodiscard]] const std::vector<std::string_view>& run_result_names();

/// Returns the names of all files and folders that commands write beside the folders of trials into a folder of
/// results. No trial's folder may have one of them.
[[nodiscard]] const std::vector<std::string_view>& result_names();

}  // namespace myoid::inline ground
