#pragma once

#include <optional>
#include <string>

#include "myoid/commands/muscle_options.h"
#include "myoid/muscle/isolated_muscle.h"
#include "myoid/muscle/muscle_file.h"

namespace myoid::commands {

/// One column of a table or storage file over time.
struct Column {
  Eigen::VectorXd time_s, values;
  std::string name;
};

/// The only column of a file, or the one of this name. Throws ReadError where it is not there, is
/// one of several, or has gaps.
[[nodiscard]] Column read_column(const std::string& path,
                                 const std::string& wanted,
                                 Remarks& remarks);

/// A number of the command line; empty where the text is no number.
[[nodiscard]] std::optional<double> as_number(const std::string& text);

/// The experiment of the length file `index`, over the call's time. Throws InvalidInput for lengths
/// that are not positive, or below 0.3 or above 3 times fiber and tendon at rest.
[[nodiscard]] muscle::IsolatedMuscleInput read_experiment(const MuscleOptions& options,
                                                          std::size_t index,
                                                          const muscle::MuscleFile& file,
                                                          Remarks& remarks);

/// Share of the maximal force: the guess of half of it errs by no more, for every force between 0
/// and the maximum.
inline constexpr double kErrorOfAGuess = 0.5;

}  // namespace myoid::commands
