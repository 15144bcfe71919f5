#pragma once

#include <string>

namespace myoid::inline ground {

/// Returns the SHA-256 of the program or library that holds this code, read once; the version if the system does not
/// show the file. Builds that compute differently differ in this hash, even if their version is the same.
[[nodiscard]] const std::string& build_identity();

}  // namespace myoid::inline ground
