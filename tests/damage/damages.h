#pragma once

#include <string>
#include <vector>

#include "tests/damage/kinds.h"

namespace myoid::damage {

struct Damaged {
  std::string what;    ///< The kind of damage: a column of the table.
  std::string detail;  ///< Where exactly.
  std::string bytes;
  bool flipped = false;  ///< One bit: it may lie inside a number or a name itself.
};

/// A good file damaged in every way that its kind allows, places and bits by a fixed seed.
[[nodiscard]] std::vector<Damaged> damaged(const Kind& kind);

}  // namespace myoid::damage
