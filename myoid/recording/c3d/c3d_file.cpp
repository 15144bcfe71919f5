#include "myoid/recording/c3d/c3d_file.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/file_words.h"

namespace myoid::recording {
namespace {

/// Returns true for names of groups and parameters that mean the same.
bool same_name(std::string_view stored, std::string_view wanted) {
  if (equal_ignoring_case(trim(stored), wanted)) return true;
  if (wanted == "FORCE_PLATFORM") {
    return equal_ignoring_case(stored, "FORCE_PLATEFORM") || equal_ignoring_case(stored, "FORCE_PLATFORMS") ||
           equal_ignoring_case(stored, "FORCE PLATFORM");
  }
  if (wanted == "OFFSET") return equal_ignoring_case(stored, "OFFSETS");
  return false;
}

}  // namespace

const C3dParameter* C3dFile::find(std::string_view group, std::string_view name) const {
  for (const C3dGroup& g : groups) {
    if (!same_name(g.name, group)) continue;
    const C3dParameter* other_spelling = nullptr;
    for (const C3dParameter& p : g.parameters) {
      if (equal_ignoring_case(trim(p.name), name)) return &p;
      if (same_name(p.name, name)) other_spelling = &p;
    }
    if (other_spelling != nullptr) return other_spelling;
  }
  return nullptr;
}

bool C3dFile::says_unsigned() const {
  const C3dParameter* format = find("ANALOG", "FORMAT");
  return format != nullptr && !texts(*format).empty() && equal_ignoring_case(texts(*format)[0], "UNSIGNED");
}

std::string block_name(std::string_view name, int block) {
  return block == 1 ? std::string(name) : fmt::format("{}{}", name, block);
}

std::vector<std::string> all_texts(const C3dFile& file, std::string_view group, std::string_view name) {
  std::vector<std::string> list;
  for (int block = 1; const C3dParameter* p = file.find(group, block_name(name, block)); ++block) {
    for (std::string& text : texts(*p)) list.push_back(std::move(text));
  }
  return list;
}

std::vector<double> all_numbers(const C3dFile& file, std::string_view group, std::string_view name) {
  std::vector<double> list;
  for (int block = 1; const C3dParameter* p = file.find(group, block_name(name, block)); ++block)
    list.insert(list.end(), p->numbers.begin(), p->numbers.end());
  return list;
}

std::vector<std::string> texts(const C3dParameter& parameter) {
  std::vector<std::string> list;
  if (parameter.type != C3dType::text) return list;
  const std::size_t width = parameter.dimensions.empty() ? 1 : std::size_t{parameter.dimensions.front()};
  std::size_t count = 1;
  for (std::size_t d = 1; d < parameter.dimensions.size(); ++d) count *= parameter.dimensions[d];
  count = std::min<std::size_t>(count, 65535);  // texts of length 0 may state any count
  for (std::size_t i = 0; i < count; ++i) {
    std::string_view text = parameter.text;
    text = i * width < text.size() ? text.substr(i * width, width) : std::string_view();
    text = text.substr(0, text.find('\0'));
    list.push_back(to_utf8(text));
  }
  return list;
}

std::optional<double> number_at(const C3dParameter* parameter, std::size_t index) {
  if (parameter == nullptr || index >= parameter->numbers.size() || !std::isfinite(parameter->numbers[index]))
    return std::nullopt;
  return parameter->numbers[index];
}

}  // namespace myoid::recording
