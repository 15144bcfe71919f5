#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::recording {

/// How the names of a file belong to those that are wanted.
struct LabelMatch {
  /// From the file's name to the wanted one, where they differ in nothing but capitals, blanks,
  /// '_', '-', '.', or a subject's prefix "name:", and both ways only one fits.
  std::map<std::string, std::string> same;
  /// From a name of the file that is not wanted to the wanted name, missing in the file, that it
  /// resembles (`nearest_word`): to be asked, not to be taken.
  std::map<std::string, std::string> similar;
};

/// Names that the file already has as wanted take no part.
[[nodiscard]] LabelMatch match_labels(const std::vector<std::string>& found,
                                      const std::vector<std::string>& wanted);

/// The letters and digits alone, small, without what precedes the last ':'.
[[nodiscard]] std::string plain_label(std::string_view label);

}  // namespace myoid::recording
