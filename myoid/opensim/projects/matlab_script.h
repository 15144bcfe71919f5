#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace myoid::opensim {

/// The value that a script of MATLAB assigns to a name, as far as it can be known without running it: rows of texts or
/// of numbers. A text or a number alone is one row of one.
struct MatlabValue {
  std::vector<std::vector<std::string>> texts = {};
  std::vector<std::vector<double>> numbers = {};
  bool is_computed = false;  ///< By what is not read here: the rows are empty.
  std::size_t line = 0;      ///< Of the assignment, counted from 1.

  /// Returns the texts of all rows.
  [[nodiscard]] std::vector<std::string> all_texts() const;
};

/// Reads the assignments `name = value` of a script, the last one of each name ("Misc.IKfile"). Values are texts,
/// numbers, lists of them in brackets or braces, names assigned before, `pwd` (".": the folder of the script), and
/// `fullfile` of them, whose parts are joined by '/'. Comments, blocks of comments and continued lines are passed over.
/// Any other value is computed, and so is a name of which a part is assigned ("time(i,:) = ..."). What loops and
/// conditions repeat or pass over counts once. Never throws: a text that is no script has no assignments.
[[nodiscard]] std::map<std::string, MatlabValue> matlab_assignments(std::string_view script);

}  // namespace myoid::opensim
