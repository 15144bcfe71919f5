#pragma once

#include <string>
#include <vector>

#include "myoid/page/report.h"
#include "myoid/results/review/second_opinion.h"

namespace myoid::results {

/// Returns what the review finds, in sentences, the gravest first.
[[nodiscard]] std::vector<std::string> review_sentences(const SecondOpinion& opinion);

/// Returns the torques by joint and trial: theirs and Myoid's.
[[nodiscard]] page::Table torque_table(const SecondOpinion& opinion);

/// Returns the review as a report: the findings, torques by joint and trial, their numbers beside the recording's, the
/// strength without EMG, bounds, and the next recording.
[[nodiscard]] page::Report review_report(const SecondOpinion& opinion);

}  // namespace myoid::results
