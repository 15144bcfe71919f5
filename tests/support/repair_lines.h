#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "myoid/recording/recording.h"

namespace myoid::test {

/// "line: message" of every repair, a line each.
inline std::string repair_lines(const std::vector<Repair>& repairs) {
  std::string text;
  for (const Repair& r : repairs) text += std::to_string(r.line) + ": " + r.message + "\n";
  return text;
}

/// The line of every repair.
inline std::vector<std::size_t> lines_of(const std::vector<Repair>& repairs) {
  std::vector<std::size_t> lines;
  for (const Repair& r : repairs) lines.push_back(r.line);
  return lines;
}

}  // namespace myoid::test
