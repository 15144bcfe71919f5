#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "myoid/recording/c3d/c3d_bytes.h"
#include "myoid/recording/c3d/c3d_file.h"

namespace myoid::recording {

/// Reads the groups and parameters whose first record begins at byte `begin`; none reaches beyond `limit`. Each record
/// states the distance to the next. If the distance leads to no record but the record's own length does, the length
/// counts. Bytes that are no record (a name with control characters, an end behind the limit) are skipped up to the
/// next record beyond doubt. Both repairs are noted with the byte. Never throws, whatever the bytes.
[[nodiscard]] std::vector<C3dGroup> parse_c3d_parameters(std::span<const std::byte> bytes,
                                                         std::size_t begin,
                                                         std::size_t limit,
                                                         const C3dBytes& number,
                                                         std::vector<Repair>& repairs);

/// Returns the parameter section as bytes: four bytes of head, records, zeros up to a whole block.
/// Throws InvalidInput if a name, description or record is too long for the format.
[[nodiscard]] std::vector<std::byte> format_c3d_parameters(const std::vector<C3dGroup>& groups, const C3dBytes& number);

}  // namespace myoid::recording
