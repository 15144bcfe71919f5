#pragma once

#include <string>
#include <vector>

#include "myoid/page/report.h"

namespace myoid::page {

/// Returns the forest plot as an HTML table with one drawn bar per number. A bar's scale is (x -
/// prior mean) / prior standard deviation, from -4 to 4: grey the prior's 95 %, a line the
/// interval, a mark the estimate. Color and shape of the mark show the verdict. Ends beyond the
/// scale become arrows. The table's cells hold the numbers as text. Empty without rows.
[[nodiscard]] std::string forest_html(const std::vector<ForestRow>& rows);

/// Returns a sentence on numbers of the person that lie outside their intervals given geometry and sensors; empty
/// without a name.
[[nodiscard]] std::string outside_given_sentence(const std::vector<std::string>& names);

}  // namespace myoid::page
