#include "myoid/draft/draft_persons.h"

#include <map>
#include <regex>
#include <set>
#include <utility>

namespace myoid {
namespace {

namespace fs = std::filesystem;

/// Returns the label of the person whom the file's name or, nearest first, one of its folders states, without leading
/// zeros ("1"), and the label as it stands there ("subject_01"); both empty if none states one.
std::pair<std::string, std::string> stated_person(const fs::path& file) {
  static const std::regex kPerson(
      "^sub-0*([A-Za-z0-9]+)|(?:^|[^A-Za-z])((?:subject|subj|sub|participant|patient|person|proband)[-_ ]?0*([0-9]+))",
      std::regex::icase);
  for (fs::path path = fs::absolute(file).lexically_normal(); path.has_filename(); path = path.parent_path()) {
    const std::string name = path.filename().string();
    std::smatch match;
    if (!std::regex_search(name, match, kPerson)) continue;
    return match[1].matched ? std::pair(match.str(1), match.str(0)) : std::pair(match.str(3), match.str(2));
  }
  return {};
}

/// Returns the number that begins the trial's name, or that its folder is, and the rest of the name.
std::pair<std::string, std::string> numbered_trial(const FoundRecording& f) {
  static const std::regex kBegin("^([sp]?[0-9]+)_(.+)$"), kAlone("^[sp]?[0-9]+$", std::regex::icase);
  const std::string folder = fs::absolute(f.path).lexically_normal().parent_path().filename().string();
  std::smatch match;
  if (std::regex_match(folder, kAlone)) return {folder, f.stem};
  if (std::regex_match(f.stem, match, kBegin)) return {match[1], match[2]};
  return {};
}

}  // namespace

std::vector<std::string> persons_in(const std::vector<FoundRecording>& found) {
  std::map<std::string, std::string> stated;
  std::map<std::string, std::set<std::string>> by_number, by_trial;
  for (const FoundRecording& f : found) {
    if (auto person = stated_person(f.path); !person.first.empty()) stated.insert(std::move(person));
    const auto [number, trial] = numbered_trial(f);
    if (number.empty()) continue;
    by_number[number].insert(trial);
    by_trial[trial].insert(number);
  }
  std::vector<std::string> persons;
  for (const auto& [label, name] : stated) persons.push_back(name);
  if (!persons.empty()) return persons;
  for (const auto& [number, trials] : by_number) {
    std::size_t shared = 0;
    for (const std::string& trial : trials) shared += by_trial[trial].size() > 1 ? 1 : 0;
    if (shared >= 2) persons.push_back(number);
  }
  return persons;
}

}  // namespace myoid
