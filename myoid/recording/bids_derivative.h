#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace myoid::recording {

/// Writes the results of a run (a folder with parameters.csv and a folder for each trial) as a BIDS
/// derivative to `out`:
///
///   dataset_description.json                                    DatasetType, GeneratedBy
///   sub-X/sub-X_desc-identified_parameters.tsv, .json           parameters.csv, explained
///   sub-X/motion/sub-X_task-TRIAL_tracksys-model_motion.tsv     coordinates of each trial:
///     with ..._motion.json and ..._channels.tsv                 JNTANG in degrees;
///                                                               *_tx, *_ty, *_tz POS in m
///
/// A dataset_description.json of another program stays (ground/files/result_record.h). `subject` and the trials' names
/// keep only letters and digits, as BIDS requires. Returns the files written. Throws ReadError if there is no
/// parameters.csv, InvalidInput if nothing remains of a name or two trials get one name.
std::vector<std::filesystem::path> write_bids_derivative(const std::filesystem::path& results,
                                                         const std::filesystem::path& out,
                                                         const std::string& subject);

}  // namespace myoid::recording
