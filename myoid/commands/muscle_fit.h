#pragma once

#include "myoid/commands/muscle.h"
#include "myoid/muscle/muscle_file.h"

namespace myoid::commands {

/// Fits the parameters to all recordings and to all but each one, and compares the two. Throws
/// InvalidInput for forces that the muscle cannot make.
[[nodiscard]] MuscleFit fit_muscle(const MuscleOptions& options,
                                   const muscle::MuscleFile& file,
                                   Remarks& remarks);

}  // namespace myoid::commands
