#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "myoid/results/comparison/compare_runs.h"

namespace myoid::results {

/// True if a method's numbers rest on measurements of the person. Method `paper` fits forces that the program shared
/// among the muscles itself.
[[nodiscard]] bool rests_on_measurement(fit::Method method);

/// Returns the numbers that a headline may announce: those of method torque if both sessions hold any, else those of
/// the other methods that rest on measurements.
[[nodiscard]] std::vector<const ComparedParameter*> counted_parameters(const RunComparison& comparison);

/// Returns "Biceps stronger: F_max larger by 264 N (25 %, 95 % 180 to 348 N); a change below 8 % would not have been
/// seen" of a number that both sessions tell, "Biceps, F_max: 264 N (25 %) more by the second treatment" of one
/// recording, and why a number is not compared otherwise.
[[nodiscard]] std::string change_text(const ComparedParameter& parameter);

/// Returns two digits of a share in percent, three from 100 on: "8", "-63", "105".
[[nodiscard]] std::string percent_text(double percent);

/// Returns true for a number of which a percent means something: not 0, and no angle.
[[nodiscard]] bool has_scale(const ComparedParameter& p);

/// Returns the branch of a muscle between `before` and `behind`; empty if the number is of both branches.
[[nodiscard]] std::string branch_text(fit::FitCase fit_case, std::string_view before, std::string_view behind = "");

/// Returns the sentence that says which of two readings the compared numbers are; empty if there is only one.
[[nodiscard]] std::string reading_sentence(const RunComparison& comparison);

/// Returns the sentence on what makes the sessions unlike, such as a maximal contraction in one alone; empty if nothing
/// does. `compare` and its page both print it.
[[nodiscard]] std::string unlike_sentence(const RunComparison& comparison);

/// Returns the sentences of all counted numbers that differ, "No number changed ..." if none does; of one recording
/// that differences are of its treatment. `compare` and the group's page both print it.
[[nodiscard]] std::string changes_sentence(const RunComparison& comparison);

}  // namespace myoid::results
