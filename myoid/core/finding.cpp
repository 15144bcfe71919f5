#include "myoid/core/finding.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace myoid {

std::string_view name(Finding::Level level) {
  switch (level) {
    case Finding::Level::error:
      return "error";
    case Finding::Level::warning:
      return "warning";
    case Finding::Level::note:
      return "note";
  }
  return "?";
}

Finding finding(std::string where, Fault fault) {
  Finding result{fault.grave ? Finding::Level::warning : Finding::Level::note, std::move(where),
                 sentence(fault)};
  result.fault = std::move(fault);
  return result;
}

std::vector<Finding> grouped(const std::vector<Finding>& findings) {
  constexpr std::size_t kNamed = 4;
  std::vector<Finding> kept;
  std::vector<std::vector<std::string>> others;
  for (const Finding& f : findings) {
    const auto same = std::find_if(kept.begin(), kept.end(), [&](const Finding& k) {
      return !f.kind.empty() && k.kind == f.kind && k.level == f.level;
    });
    if (same != kept.end()) {
      others[static_cast<std::size_t>(same - kept.begin())].push_back(f.where);
      continue;
    }
    kept.push_back(f);
    others.emplace_back();
  }
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const std::size_t named = std::min(kNamed, others[i].size());
    if (named == 0) continue;
    kept[i].message += fmt::format(
        " (likewise in {}{})",
        fmt::join(others[i].begin(), others[i].begin() + static_cast<std::ptrdiff_t>(named), ", "),
        named < others[i].size() ? fmt::format(" and {} more", others[i].size() - named) : "");
  }
  return kept;
}

}  // namespace myoid
