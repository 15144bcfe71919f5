#pragma once

#include <string>

namespace myoid {

/// SHA-256 of the program or library that this code is in, as built: two builds that compute
/// differently differ in it, where their version may not. Read once. The version where the system
/// does not show the file.
[[nodiscard]] const std::string& build_identity();

}  // namespace myoid
