#pragma once

#include <array>
#include <string_view>

namespace myoid::fuzz {

/// The endings that `info` knows. An input of fuzz_info begins with 'a' plus the number of its ending.
inline constexpr std::array<std::string_view, 12> kInfoKinds{".c3d",  ".edf", ".trc", ".sto", ".csv", ".anc",
                                                             ".osim", ".mot", ".tsv", ".txt", ".emt", ".bdf"};

}  // namespace myoid::fuzz
