#pragma once

#include <algorithm>
#include <vector>

#include "myoid/ground/core/stretch.h"

namespace myoid::study {

[[nodiscard]] inline bool equal_stretches(const std::vector<Stretch>& a, const std::vector<Stretch>& b) {
  return std::ranges::equal(
      a, b, [](const Stretch& x, const Stretch& y) { return x.begin_s == y.begin_s && x.end_s == y.end_s; });
}

}  // namespace myoid::study
