#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myoid::recording {

/// The results of a run (a folder with parameters.csv and a folder for each trial) as a BIDS
/// derivative in `out`:
///
///   dataset_description.json                                    DatasetType, GeneratedBy
///   sub-X/sub-X_desc-identified_parameters.tsv, .json           parameters.csv, explained
///   sub-X/motion/sub-X_task-TRIAL_tracksys-model_motion.tsv     coordinates of each trial:
///     with ..._motion.json and ..._channels.tsv                 JNTANG in degrees;
///                                                               *_tx, *_ty, *_tz POS in m
///
/// `subject` and the trials' names keep their letters and digits, as BIDS wants it. Returns the
/// files written. Throws ReadError if there is no parameters.csv, InvalidInput if nothing is left
/// of a name or two trials become one.
std::vector<std::filesystem::path> write_bids_derivative(const std::filesystem::path& results,
                                                         const std::filesystem::path& out,
                                                         const std::string& subject);

}  // namespace myoid::recording
