#pragma once

#include <string>

#include "myoid/page/report.h"

namespace myoid::page {

/// Returns both sessions of every number as an HTML table with one drawn bar per number. A bar's scale is the change
/// from the first session over the smallest change that the recordings detect, from -3 to 3: grey from -1 to 1, a blue
/// disc with its interval the first session, an orange diamond the second. Ends beyond the scale become arrows. The
/// table's cells hold the numbers as text. Empty without rows.
[[nodiscard]] std::string change_forest_html(const ChangeForest& forest);

}  // namespace myoid::page
