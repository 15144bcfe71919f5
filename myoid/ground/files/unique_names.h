#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {

/// Gives each name of a list its own: the second "a" becomes "a_2", the third "a_3". A name of the list itself is given
/// to no other. The number of trials grows with the number of names, however many are equal.
class UniqueNames {
 public:
  explicit UniqueNames(const std::vector<std::string>& names) : reserved_(names.begin(), names.end()) {}

  /// Returns the name, or, if it is taken, NAME_2, NAME_3, ..., and keeps it.
  [[nodiscard]] std::string take(const std::string& name);
  /// Returns true if the list has the name.
  [[nodiscard]] bool lists(const std::string& name) const { return reserved_.contains(name); }
  /// Returns how many names were tried.
  [[nodiscard]] std::size_t trials() const { return trials_; }

 private:
  std::set<std::string> reserved_, taken_;
  std::map<std::string, int> next_;  ///< For each name the next number.
  std::size_t trials_ = 0;
};

/// Takes the subject off names of markers ("subject:marker"), provided that they stay unique, and notes what it does
/// for the line `line` of the file (0: the whole file).
void leave_out_subject(std::vector<std::string>& names, std::size_t line, std::vector<Repair>& repairs);

}  // namespace myoid::inline ground
