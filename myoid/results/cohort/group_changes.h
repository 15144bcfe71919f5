#pragma once

#include <string>
#include <vector>

#include "myoid/page/report.h"
#include "myoid/results/comparison/compare_runs.h"

namespace myoid::results {

/// The two sessions of one person.
struct PersonChange {
  std::string person;
  std::string page;  ///< Report of the second session, relative to the group's; empty: none.
  RunComparison comparison;
};

/// Returns the persons' changes from the first session to the second in the counted numbers
/// (`counted_parameters`). Strip plots show each parameter's difference with the person's smallest detectable change to
/// either side, and a table lists all persons. From three persons on, the table has the group's smallest detectable
/// change, 1.96 times the standard deviation of the differences between persons. For persons who did not change, this
/// deviation contains all errors of a repetition.
[[nodiscard]] page::Section change_section(const std::vector<PersonChange>& changes);

}  // namespace myoid::results
