#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "myoid/muscle/activation.h"
#include "myoid/muscle/millard.h"
#include "myoid/muscle/musculotendon.h"

namespace myoid::muscle {

/// One muscle by its muscle.toml; see docs/guide/muscle.md.
struct MuscleFile {
  std::string name;
  MusculotendonParameters<double> parameters;
  MusculotendonLaws laws;
  MillardShape millard;
  ActivationDynamics<double> activation;
};

/// Reads a muscle strictly. Throws ReadError with the line for unknown keys, wrong types and
/// impossible numbers, and InvalidInput for contradictory numbers.
[[nodiscard]] MuscleFile read_muscle_file(const std::filesystem::path& path);
[[nodiscard]] MuscleFile parse_muscle_file(std::string_view text, const std::filesystem::path& path);

}  // namespace myoid::muscle
