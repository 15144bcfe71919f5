#include "myoid/ground/files/named_file.h"

#include <algorithm>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/core/nearest_word.h"
#include "myoid/ground/files/text_file.h"

namespace myoid::inline ground {
namespace {

namespace fs = std::filesystem;

std::string with_slashes(std::string_view name) {
  std::string text(trim(name));
  std::replace(text.begin(), text.end(), '\\', '/');
  return text;
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) && !fs::is_directory(path, ignored);
}

/// Returns the entry of a folder with that name or else the only entry that differs in case alone.
std::optional<fs::path> entry_of(const fs::path& folder, const std::string& name) {
  std::error_code ignored;
  if (fs::exists(folder / name, ignored)) return folder / name;
  std::vector<fs::path> alike;
  fs::directory_iterator entry(folder.empty() ? "." : folder, ignored);
  for (; entry != fs::directory_iterator(); entry.increment(ignored)) {
    if (equal_ignoring_case(entry->path().filename().string(), name))
      alike.push_back(folder / entry->path().filename());
  }
  return alike.size() == 1 ? std::optional(alike[0]) : std::nullopt;
}

/// Returns the file at folder/first/.../last, ignoring case.
std::optional<fs::path> file_at(fs::path place, const std::vector<std::string>& parts) {
  for (const std::string& part : parts) {
    const auto next = entry_of(place, part);
    if (!next) return std::nullopt;
    place = *next;
  }
  return is_file(place) ? std::optional(place) : std::nullopt;
}

/// Splits a path into folders and file, without drive, server's slashes, "." and "..".
std::vector<std::string> parts_of(const std::string& name) {
  std::vector<std::string> parts;
  for (const std::string_view part : split(name, '/')) {
    const bool is_drive = part.size() == 2 && part[1] == ':';
    if (!part.empty() && part != "." && part != ".." && !is_drive) parts.emplace_back(part);
  }
  return parts;
}

}  // namespace

bool is_windows_path(std::string_view name) {
  const std::string text = with_slashes(name);
  const bool drive = text.size() > 2 && text[1] == ':' && text[2] == '/' &&
                     ((text[0] >= 'a' && text[0] <= 'z') || (text[0] >= 'A' && text[0] <= 'Z'));
  return drive || text.starts_with("//");
}

fs::path native_path(const fs::path& folder, std::string_view name) { return folder / with_slashes(name); }

std::string last_part(std::string_view name) {
  const auto parts = parts_of(with_slashes(name));
  return parts.empty() ? std::string() : parts.back();
}

NamedFile find_named_file(const fs::path& folder, std::string_view name) {
  const fs::path named = native_path(folder, name);
  if (!is_windows_path(name) && is_file(named)) return {named, true};
  std::vector<std::string> parts = parts_of(with_slashes(name));
  const fs::path up = folder.empty() ? fs::path("..") : folder / "..";
  while (!parts.empty()) {
    for (const fs::path& place : {folder, up}) {
      if (const auto found = file_at(place, parts)) {
        return {
            found->lexically_normal(), true,
            fmt::format("'{}' is not on this computer; {} is taken", trim(name), found->lexically_normal().string())};
      }
    }
    parts.erase(parts.begin());
  }
  return {named, false};
}

std::string missing_file(const fs::path& folder, std::string_view name) {
  constexpr std::size_t kListed = 5, kMostEntries = 2000;
  const std::string wanted = last_part(name);
  const std::string ending = fs::path(wanted).extension().string();
  std::vector<std::string> alike;
  std::error_code ignored;
  std::size_t seen = 0;
  fs::directory_iterator entry(folder.empty() ? "." : folder, ignored);
  for (; entry != fs::directory_iterator() && seen < kMostEntries; entry.increment(ignored), ++seen) {
    const fs::path file = entry->path().filename();
    if (equal_ignoring_case(file.extension().string(), ending) && is_file(entry->path()))
      alike.push_back(file.string());
  }
  std::sort(alike.begin(), alike.end());
  std::string text = "there is no such file";
  text += did_you_mean(wanted, alike);
  if (!alike.empty()) {
    const std::size_t listed = std::min(kListed, alike.size());
    text += fmt::format("; in its folder {} {}{}", alike.size() == 1 ? "is" : "are",
                        fmt::join(alike.begin(), alike.begin() + static_cast<std::ptrdiff_t>(listed), ", "),
                        listed < alike.size() ? fmt::format(" and {} more", alike.size() - listed) : "");
  }
  return text + "; a file of that name beside the document or one folder up would be taken";
}

}  // namespace myoid::inline ground
