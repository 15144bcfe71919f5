#include "myoid/ground/files/unique_names.h"

#include <fmt/format.h>

namespace myoid::inline ground {
namespace {

/// Returns the index behind a subject's prefix in a name, 0 if there is none.
std::size_t bare_begin(const std::string& name) {
  const std::size_t colon = name.rfind(':');
  return colon != std::string::npos && colon > 0 && colon + 1 < name.size() ? colon + 1 : 0;
}

}  // namespace

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

void leave_out_subject(std::vector<std::string>& names, std::size_t line, std::vector<Repair>& repairs) {
  std::set<std::string> bare;
  bool prefixed = false;
  for (const std::string& name : names) {
    prefixed = prefixed || bare_begin(name) > 0;
    bare.insert(name.substr(bare_begin(name)));
  }
  if (!prefixed) return;
  if (bare.size() < names.size()) {
    repairs.push_back({line, "names keep their subject's prefix, since without it some would be the same"});
    return;
  }
  for (std::string& name : names) name.erase(0, bare_begin(name));
  repairs.push_back({line, "the subject's prefix ('subject:marker') is left out of the names"});
}

}  // namespace myoid::inline ground
