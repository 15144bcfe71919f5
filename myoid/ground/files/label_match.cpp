#include "myoid/ground/files/label_match.h"

#include <set>

#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {

std::string plain_label(std::string_view label) {
  if (const auto colon = label.rfind(':'); colon != std::string_view::npos) label.remove_prefix(colon + 1);
  std::string plain;
  for (const char c : label) {
    if (std::string_view(" \t_-.").find(c) == std::string_view::npos) plain += small_letter(c);
  }
  return plain;
}

LabelMatch match_labels(const std::vector<std::string>& found, const std::vector<std::string>& wanted) {
  const std::set<std::string> has(found.begin(), found.end());
  const std::set<std::string> wants(wanted.begin(), wanted.end());
  std::map<std::string, std::vector<std::string>> spare;    // names of the file, by plain label
  std::map<std::string, std::vector<std::string>> missing;  // wanted names, by plain label
  for (const std::string& name : has) {
    if (!wants.contains(name)) spare[plain_label(name)].push_back(name);
  }
  for (const std::string& name : wants) {
    if (!has.contains(name)) missing[plain_label(name)].push_back(name);
  }
  LabelMatch match;
  for (const auto& [plain, names] : spare) {
    const auto other = missing.find(plain);
    if (plain.empty() || other == missing.end() || names.size() != 1 || other->second.size() != 1) continue;
    match.same[names.front()] = other->second.front();
  }
  return match;
}

}  // namespace myoid::inline ground
