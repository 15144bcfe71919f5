#pragma once

#include <filesystem>
#include <vector>

#include "myoid/ground/files/text_file.h"
#include "myoid/results/mat/mat_file.h"

namespace myoid::results {

/// Returns the results in a folder that `run` or `identify` wrote as variables of MATLAB, read from the files, or those
/// of one file, parameters.csv or a storage file (variable `series`):
///
///   parameters  the columns of parameters.csv; the column `case` is called `fit_case`
///   trials      name, use, failure, series; a series has names, units, time [s], values,
///   in_degrees
///               and title, and is called as its file
///   remarks     trial (empty: the whole study), code, level, channel, begin_s, end_s, text
///   draws       of posterior.csv: names, units, values (draws x names), weights
///   run         program, version, command and study of run.json
///
/// Variables whose files are not there are left out. `repairs` gets those of a storage file. Throws ReadError for a
/// damaged file.
[[nodiscard]] MatStruct matlab_results(const std::filesystem::path& results, std::vector<Repair>* repairs = nullptr);

/// Throws InvalidInput, before anything is computed, if `file` does not end in .mat, or as `require_matio`.
void check_mat_file(const std::filesystem::path& file);
/// Writes the results in a folder, or of one file, as a MATLAB file; returns the repairs of a storage file.
std::vector<Repair> write_results_mat(const std::filesystem::path& results, const std::filesystem::path& file);

}  // namespace myoid::results
