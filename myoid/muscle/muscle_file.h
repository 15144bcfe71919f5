#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "myoid/muscle/activation.h"
#include "myoid/muscle/millard.h"
#include "myoid/muscle/musculotendon.h"

namespace myoid::muscle {

/// One muscle as a muscle.toml describes it; see docs/guide/muscle.md.
struct MuscleFile {
  std::string name;
  muscle::MusculotendonParameters<double> parameters;
  muscle::MusculotendonLaws laws;
  muscle::MillardShape millard;
  muscle::ActivationDynamics<double> activation;
};

/// Reads it strictly: unknown keys, wrong types and numbers that make no muscle are ReadError with
/// the line; numbers that contradict each other InvalidInput.
[[nodiscard]] MuscleFile read_muscle_file(const std::filesystem::path& path);
[[nodiscard]] MuscleFile parse_muscle_file(std::string_view text,
                                           const std::filesystem::path& path);

}  // namespace myoid::muscle
