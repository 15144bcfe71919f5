#include "myoid/ground/files/unique_names.h"

#include <fmt/format.h>

namespace myoid::inline ground {

std::string UniqueNames::take(const std::string& name) {
  ++trials_;
  if (taken_.insert(name).second) return name;
  int& number = next_.try_emplace(name, 2).first->second;
  for (;; ++number) {
    ++trials_;
    std::string other = fmt::format("{}_{}", name, number);
    if (!reserved_.contains(other) && taken_.insert(other).second) return other;
  }
}

}  // namespace myoid::inline ground
