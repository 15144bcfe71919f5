#pragma once

#include <string>
#include <vector>

#include "myoid/report/report.h"
#include "myoid/results/compare_runs.h"

namespace myoid {

/// The two sessions of one person.
struct PersonChange {
  std::string person;
  std::string page;  ///< Report of the second session, relative to the group's; empty: none.
  RunComparison comparison;
};

/// The persons' changes from the first session to the second, of method torque (of the first method
/// where torque was not asked for): strip plots of each parameter's difference with the smallest
/// detectable change of that person to either side, and a table over the persons. From three
/// persons on, the table has the group's own smallest detectable change, 1.96 times the standard
/// deviation of the differences between persons: of persons who did not change, it holds all errors
/// of a repetition.
[[nodiscard]] report::Section change_section(const std::vector<PersonChange>& changes);

}  // namespace myoid
