#include "myoid/ground/files/name_ids.h"

#include <algorithm>
#include <array>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "myoid/ground/core/provenance.h"
#include "myoid/ground/files/text_file.h"
#include "myoid/ground/files/utf8.h"

namespace myoid::inline ground {
namespace {

constexpr std::size_t kHashDigits = 8;

/// The form of the ids of one place.
struct IdForm {
  std::string_view marks;   ///< Allowed beside letters and digits.
  std::string_view joiner;  ///< For a run of other characters.
  std::string_view before;  ///< Between an id and the digits of a hash.
  std::size_t most;
};

const IdForm& form_of(IdFor place) {
  static constexpr std::array<IdForm, 3> kForms{{{"_-.", "_", "-", 60}, {"", "", "", 60}, {"_", "_", "_", 63}}};
  return kForms[static_cast<std::size_t>(place)];
}

bool is_ascii_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

bool may_stand(char c, const IdForm& form) {
  return is_ascii_letter(c) || (c >= '0' && c <= '9') || form.marks.find(c) != std::string_view::npos;
}

bool may_begin(char c, IdFor place) { return place == IdFor::variable ? is_ascii_letter(c) : c != '.' && c != '-'; }

/// Returns true for "con", "COM1", "nul.txt", whatever the ending: Windows opens a device in place of a file.
bool is_device(std::string_view id) {
  const std::string stem = small_letters(std::string(id.substr(0, id.find('.'))));
  const bool numbered =
      stem.size() == 4 && (stem.starts_with("com") || stem.starts_with("lpt")) && stem[3] >= '0' && stem[3] <= '9';
  return numbered || stem == "con" || stem == "prn" || stem == "aux" || stem == "nul";
}

/// Returns the characters of the name that an id may hold, at any length.
std::string plain_part(std::string_view name, IdFor place) {
  const IdForm& form = form_of(place);
  std::string id;
  bool owed = false;  // a joiner, if a character follows
  for (const char c : name) {
    if (!may_stand(c, form)) {
      owed = !id.empty();
    } else if (!id.empty() || may_begin(c, place) || (place == IdFor::variable && c != '_')) {
      if (id.empty() && !may_begin(c, place)) id = "x";
      if (owed) id += form.joiner;
      owed = false;
      id += c;
    }
  }
  while (place == IdFor::file && id.ends_with('.')) id.pop_back();
  return id;
}

std::string with_hash(const std::string& plain, const std::string& name, IdFor place, int attempt) {
  const IdForm& form = form_of(place);
  std::string id = plain.substr(0, form.most - kHashDigits - form.before.size());
  if (id.empty()) id = place == IdFor::file ? "name" : "x";
  while (place == IdFor::file && id.ends_with('.')) id.pop_back();
  if (place == IdFor::file && is_device(id)) id = "_" + id.substr(0, form.most - kHashDigits - form.before.size() - 1);
  const std::string hashed = attempt == 0 ? name : fmt::format("{} {}", attempt, name);
  return fmt::format("{}{}{}", id, form.before, sha256(hashed).substr(0, kHashDigits));
}

}  // namespace

std::vector<std::string> ids_of(const std::vector<std::string>& names,
                                IdFor place,
                                const std::vector<std::string_view>& reserved) {
  struct Claim {
    int names = 0, kept = 0;  ///< Names that become this id, and those that are it already.
  };
  std::set<std::string> taken;
  for (const std::string_view word : reserved) taken.insert(small_letters(std::string(word)));
  std::vector<std::string> plain, keys;
  std::map<std::string, Claim> claims;
  for (const std::string& name : names) {
    plain.push_back(plain_part(name, place));
    keys.push_back(small_letters(plain.back()));
    Claim& claim = claims[keys.back()];
    ++claim.names;
    claim.kept += plain.back() == name;
  }
  std::vector<std::string> ids(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Claim& claim = claims[keys[i]];
    const bool first = claim.names == 1 || (claim.kept == 1 && plain[i] == names[i]);
    const bool fits =
        !plain[i].empty() && plain[i].size() <= form_of(place).most && !(place == IdFor::file && is_device(plain[i]));
    if (first && fits && taken.insert(keys[i]).second) ids[i] = plain[i];
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (int attempt = 0; ids[i].empty(); ++attempt) {
      std::string id = with_hash(plain[i], names[i], place, attempt);
      if (taken.insert(small_letters(id)).second) ids[i] = std::move(id);
    }
  }
  return ids;
}

NameIds::NameIds(const std::vector<std::string>& names, IdFor place, const std::vector<std::string_view>& reserved)
    : place_(place) {
  const std::vector<std::string> ids = ids_of(names, place, reserved);
  for (std::size_t i = 0; i < names.size(); ++i) ids_.emplace(names[i], ids[i]);
}

std::string NameIds::of(const std::string& name) const {
  const auto found = ids_.find(name);
  return found != ids_.end() ? found->second : ids_of({name}, place_).front();
}

std::string text_refusal(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const CodePoint point = code_point_at(text, i);
    if (!point.valid)
      return fmt::format("byte {} is {:#04x}, which is no UTF-8; save the file in UTF-8", i + 1,
                         static_cast<unsigned>(point.value));
    if (is_control(point.value))
      return fmt::format("character U+{:04X} at byte {} is a control character; leave it out",
                         static_cast<unsigned>(point.value), i + 1);
    i += point.bytes;
  }
  return {};
}

std::string name_refusal(std::string_view text) {
  if (text.find_first_not_of(' ') == std::string_view::npos)
    return "found nothing that can be seen, expected a name of one character or more";
  return text_refusal(text);
}

}  // namespace myoid::inline ground
