#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::inline ground {

/// Pairs of names in a file and wanted names. Names that merely resemble each other are no pair: `T1` and `c7` are two
/// vertebrae.
struct LabelMatch {
  /// From the file's name to the wanted name where both differ only in capitals, blanks, '_', '-',
  /// '.', or a subject's prefix "name:", and no other name fits either of them.
  std::map<std::string, std::string> same;
};

/// Pairs `found` with `wanted`; names that are equal take no part.
[[nodiscard]] LabelMatch match_labels(const std::vector<std::string>& found, const std::vector<std::string>& wanted);

/// Returns the letters and digits of a label in small letters, without the part up to the last ':'.
[[nodiscard]] std::string plain_label(std::string_view label);

}  // namespace myoid::inline ground
