#pragma once

#include <cstddef>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

#include "myoid/recording/tables/storage_reader.h"

namespace myoid::recording {

/// The lines of a .mot or .sto file up to `endheader`.
struct StorageHeader {
  Storage file;              ///< Without its data.
  std::size_t elements = 1;  ///< Numbers per cell, by DataType: 3 for Vec3.
  std::size_t end = 0;       ///< Index of the line `endheader`.

  /// Returns the number of the first of these keys that the header has, ignoring case.
  [[nodiscard]] std::optional<double> count(std::initializer_list<const char*> names) const;
};

/// Throws ReadError if there is no `endheader` or `inDegrees` is neither yes nor no.
[[nodiscard]] StorageHeader read_storage_header(const std::vector<std::string_view>& lines,
                                                const std::filesystem::path& path);

}  // namespace myoid::recording
