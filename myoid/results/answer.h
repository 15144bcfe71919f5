#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// Columns of an answer on a terminal, at most.
inline constexpr std::size_t kAnswerColumns = 110;

/// A number for people, with plain names and units.
struct AnswerRow {
  std::string number;          ///< "Biceps, voluntary torque"
  std::string value;           ///< "43.8 N m at 92°"
  std::string of_person;       ///< "40.3 to 47.7"
  std::string given;           ///< "41.9 to 45.6"; empty: the fit has one reading.
  std::string verdict;         ///< "identified"
  bool outside_given = false;  ///< The person's number lies outside its interval given geometry and sensors.
};

/// Returns the numbers that the recording tells, at most `most`: first the greatest voluntary torques, then the others
/// by verdict and relative width of the interval. Numbers of electrodes and joints are left out.
[[nodiscard]] std::vector<AnswerRow> answer_rows(const fit::IdentificationResult& method,
                                                 std::size_t muscle_count,
                                                 std::size_t most);

/// Returns how many parameters the method identifies and how well it predicts the trials left out, in sentences.
/// `with_names` lists the identified ones.
[[nodiscard]] std::string fit_sentences(const run::StudyResult& result, bool with_names);

/// Returns the movements to record next and their gain; empty without a plan. A gate that failed is mended first.
[[nodiscard]] std::string next_sentence(const run::StudyResult& result, const std::vector<page::Gate>& gates);

/// Returns "Trials with warnings: press (EMG clipped: BIC), lift (predicted worse than the others)." with at most
/// `most` trials by name, the worst first.
[[nodiscard]] std::string trials_sentence(const run::StudyResult& result, std::size_t most = 4);

/// Returns the answer of a run for a terminal, at most 24 lines of at most `width` columns: may the numbers be
/// believed and why not, the numbers with both readings, the fit in sentences, trials with warnings, the next
/// recording.
[[nodiscard]] std::string answer_text(const run::StudyResult& result,
                                      const std::vector<page::Gate>& gates,
                                      std::size_t width);

}  // namespace myoid::results
