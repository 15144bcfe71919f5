#pragma once

#include <string>
#include <vector>

#include "myoid/fit/intervals/result.h"
#include "myoid/page/report.h"
#include "myoid/run/study_result.h"

namespace myoid::results {

/// A greatest voluntary torque for people.
struct VoluntaryLine {
  const fit::VoluntaryCurve* curve = nullptr;
  const fit::ParameterEstimate* torque = nullptr;
  const fit::ParameterEstimate* angle = nullptr;  ///< Null: no angle.
  std::string name;   ///< "Biceps", "Biceps at the knee angle", "elbow flexion, Biceps + Brachialis"
  std::string place;  ///< "85°", "110° or beyond"; empty: no angle.
};

/// Returns the lines in the order of IdentificationResult::voluntary. A joint's torque that one muscle makes is that
/// muscle's line, and has none of its own. Muscles have their plain names (page/muscle_names.h). The place is "110° or
/// beyond" where the torque is greatest at the end of the recorded range.
[[nodiscard]] std::vector<VoluntaryLine> voluntary_lines(const fit::IdentificationResult& method);

/// Returns "Biceps", or "elbow flexion together" of a joint's muscles.
[[nodiscard]] std::string short_name(const fit::VoluntaryCurve& curve);

/// Returns true if the recording tells the number for the person, or for sessions of the person.
[[nodiscard]] bool is_told(const fit::ParameterEstimate& e);

/// Returns the torques that the recording tells, as the report's first sentence with a blank behind it; empty: none.
///
///   Greatest voluntary torque (95 % interval, identified): Biceps 43 N m (36 to 50) at 92°; Triceps 52 N m (47 to 58).
///
/// Each number has a verdict of its own where they differ.
[[nodiscard]] std::string voluntary_headline(const fit::IdentificationResult& method);

/// Returns the section of the greatest voluntary torques: a table, and the torque over the angle.
[[nodiscard]] page::Section voluntary_section(const run::StudyResult& result, const fit::IdentificationResult& method);

/// Returns the curves, one row per owner and place, with the columns of docs/guide/run.md.
[[nodiscard]] std::string voluntary_csv(const fit::IdentificationResult& method);

}  // namespace myoid::results
