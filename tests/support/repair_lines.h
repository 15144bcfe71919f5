#pragma once

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

}  // namespace myoid::test
