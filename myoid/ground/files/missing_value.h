#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {

/// Returns true for a number that programs write where nothing was measured: nines alone, 999, -9999, 999.9.
[[nodiscard]] bool may_stand_for_missing(double number);

/// Replaces numbers that may stand for a missing value by NaN where they are more than 3 times as large as every other
/// number of the column. Each such column is noted by its name. Returns the number of each column that was replaced
/// most often; empty: none.
[[nodiscard]] std::vector<std::optional<double>> take_out_missing(Eigen::MatrixXd& values,
                                                                  const std::vector<std::string>& names,
                                                                  std::vector<Repair>& repairs);

}  // namespace myoid::inline ground
