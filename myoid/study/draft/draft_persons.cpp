#include "myoid/study/draft/draft_persons.h"

#include <algorithm>
#include <map>
#include <regex>
#include <set>
#include <utility>

namespace myoid::study {
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

/// Returns for each recording the name of its folder if that folder is a person's: two or more of its recordings of
/// markers have the names of those in a sister folder. A folder of one trial holds one such recording.
std::vector<std::string> folders_of_persons(const std::vector<FoundRecording>& found) {
  const auto folder_of = [](const FoundRecording& f) { return fs::absolute(f.path).lexically_normal().parent_path(); };
  std::map<fs::path, std::set<std::string>> trials;
  for (const FoundRecording& f : found)
    if (f.markers.frame_count() > 0) trials[folder_of(f)].insert(f.stem);
  const auto is_person = [&](const fs::path& folder) {
    return std::ranges::any_of(trials, [&](const auto& sister) {
      if (sister.first == folder || sister.first.parent_path() != folder.parent_path()) return false;
      return std::ranges::count_if(trials[folder],
                                   [&](const std::string& trial) { return sister.second.contains(trial); }) >= 2;
    });
  };
  std::vector<std::string> persons;
  for (const FoundRecording& f : found) {
    const fs::path folder = folder_of(f);
    persons.push_back(trials.contains(folder) && is_person(folder) ? folder.filename().string() : "");
  }
  return persons;
}

}  // namespace

std::vector<std::string> person_of_each(const std::vector<FoundRecording>& found) {
  std::map<std::string, std::string> stated;
  std::map<std::string, std::set<std::string>> by_number, by_trial;
  for (const FoundRecording& f : found) {
    if (auto person = stated_person(f.path); !person.first.empty()) stated.insert(std::move(person));
    const auto [number, trial] = numbered_trial(f);
    if (number.empty()) continue;
    by_number[number].insert(trial);
    by_trial[trial].insert(number);
  }
  const auto shares_trials = [&](const std::string& number) {
    std::size_t shared = 0;
    for (const std::string& trial : by_number[number]) shared += by_trial[trial].size() > 1 ? 1 : 0;
    return shared >= 2;
  };
  std::vector<std::string> persons;
  for (const FoundRecording& f : found) {
    if (!stated.empty()) {
      const auto person = stated.find(stated_person(f.path).first);
      persons.push_back(person == stated.end() ? "" : person->second);
    } else {
      const std::string number = numbered_trial(f).first;
      persons.push_back(!number.empty() && shares_trials(number) ? number : "");
    }
  }
  const bool nobody = std::ranges::all_of(persons, [](const std::string& person) { return person.empty(); });
  return nobody ? folders_of_persons(found) : persons;
}

std::vector<std::string> persons_in(const std::vector<FoundRecording>& found) {
  const std::vector<std::string> each = person_of_each(found);
  std::map<std::string, std::string> by_label;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (each[i].empty()) continue;
    const std::string label = stated_person(found[i].path).first;
    by_label.emplace(label.empty() ? each[i] : label, each[i]);
  }
  std::vector<std::string> persons;
  for (const auto& [label, name] : by_label) persons.push_back(name);
  return persons;
}

OnePerson keep_one_person(std::vector<FoundRecording>& found) {
  OnePerson person{.all = persons_in(found)};
  if (person.all.empty()) return {};
  const std::vector<std::string> each = person_of_each(found);
  person.kept = *std::ranges::max_element(person.all, {},
                                          [&](const std::string& name) { return std::ranges::count(each, name); });
  std::vector<FoundRecording> own;
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (each[i].empty()) person.unnamed.push_back(found[i].path);
    if (each[i].empty() || each[i] == person.kept)
      own.push_back(std::move(found[i]));
    else
      person.left_out.push_back(found[i].path.filename().string());
  }
  found = std::move(own);
  if (person.all.size() < 2) person.all.clear();
  if (std::ranges::count(each, person.kept) <= std::ssize(person.unnamed)) person.unnamed.clear();
  return person;
}

}  // namespace myoid::study
