#pragma once

#include <optional>
#include <string>

#include "myoid/ground/core/units.h"
#include "myoid/muscle/muscle_file.h"
#include "myoid/program/steps/muscle.h"

namespace myoid::program {

/// One column of a table or storage file over time.
struct Column {
  Eigen::VectorXd time_s, values;
  std::string name;
};

/// Samples without a number: none may be, or a remark counts them and they are left out.
enum class Gaps { refused, left_out };

/// The column that an option names; an empty name is the file's only column. A table may write another unit of the same
/// kind, which is converted.
struct ColumnChoice {
  std::string option, name;
  Unit unit = Unit::dimensionless;  ///< Dimensionless: any.
  Gaps gaps = Gaps::refused;
};

/// Returns the only column of a file, or the one of this name. Throws ReadError if the column is missing, is one of
/// several, is in a unit of another kind, has gaps that are refused, or no number at all.
[[nodiscard]] Column read_column(const std::string& path, const ColumnChoice& choice, Remarks& remarks);

/// Reads the experiment of the length file `index`, over the call's time. Throws InvalidInput for
/// lengths that are not positive, or below 0.3 or above 3 times fiber and tendon at rest.
[[nodiscard]] muscle::IsolatedMuscleInput read_experiment(const MuscleOptions& options,
                                                          std::size_t index,
                                                          const muscle::MuscleFile& file,
                                                          Remarks& remarks);

/// Largest error of a guess, as a share of the maximal force: half of this force is at most this
/// far from any force between 0 and the maximum.
inline constexpr double kErrorOfAGuess = 0.5;

}  // namespace myoid::program
