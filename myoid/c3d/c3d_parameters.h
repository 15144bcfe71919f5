#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "myoid/c3d/c3d_bytes.h"
#include "myoid/c3d/c3d_file.h"

namespace myoid::recording {

/// Reads the groups and parameters whose first record begins at byte `begin`, none reaching beyond
/// `limit`. Records are linked by the distance to the next. Where the distance leads to no record
/// and the record's own length does, the length holds; bytes that are no record (a name with
/// control characters, an end behind the limit) are skipped up to the next record beyond doubt.
/// Both are noted with the byte, and every other parameter is kept. Never throws on any bytes.
[[nodiscard]] std::vector<C3dGroup> parse_c3d_parameters(std::span<const std::byte> bytes,
                                                         std::size_t begin,
                                                         std::size_t limit,
                                                         const C3dBytes& number,
                                                         std::vector<Repair>& repairs);

/// The parameter section as bytes: four bytes of head, records, zeros up to a whole number of
/// blocks. Throws InvalidInput if a name, description or record is too long for the format.
[[nodiscard]] std::vector<std::byte> format_c3d_parameters(const std::vector<C3dGroup>& groups,
                                                           const C3dBytes& number);

}  // namespace myoid::recording
