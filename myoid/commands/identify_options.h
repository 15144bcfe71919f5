#pragma once

#include <string>
#include <vector>

#include "myoid/commands/identify.h"
#include "myoid/identify_files/muscles_csv.h"

namespace myoid::commands {

/// Throws InvalidInput for a word that names no method, loss, lag or kind of folds.
void check_words(const IdentifyOptions& options);

/// Throws InvalidInput where the options ask for something that the method or the files cannot
/// give.
void refuse_impossible(const IdentifyOptions& options, const MuscleTable& table);

/// A sentence for each option that was given and changes nothing.
[[nodiscard]] std::vector<std::string> without_effect(const IdentifyOptions& options);

/// The estimator's options for data with these rules. Throws InvalidInput where two of the options
/// say how muscles follow their EMG.
[[nodiscard]] identification::EstimatorOptions estimator_options(
    const IdentifyOptions& options, const identification::StudyData& data, Remarks& remarks);

}  // namespace myoid::commands
