#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "myoid/muscle/excitation_response.h"
#include "myoid/muscle/millard.h"
#include "myoid/muscle/musculotendon.h"

namespace myoid::muscle {

/// One muscle by its muscle.toml; see docs/guide/muscle.md.
struct MuscleFile {
  std::string name;
  MusculotendonParameters<double> parameters;
  MusculotendonLaws laws;
  MillardShape millard;
  ExcitationResponse response;
};

/// Reads a muscle strictly. Throws ReadError with the line for unknown keys, wrong types and
/// impossible numbers, and InvalidInput for contradictory numbers.
[[nodiscard]] MuscleFile read_muscle_file(const std::filesystem::path& path);
[[nodiscard]] MuscleFile parse_muscle_file(std::string_view text, const std::filesystem::path& path);

/// Returns the text of a file with this muscle.
[[nodiscard]] std::string muscle_toml(const MuscleFile& file);

}  // namespace myoid::muscle
