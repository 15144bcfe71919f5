#include "myoid/study/study_text.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/study/study_settings.h"

namespace myoid::study {
namespace {

using nlohmann::ordered_json;

/// Collects the visited settings as a JSON object.
class SettingWriter : public SettingVisitor {
 public:
  /// Paths are written relative to `folder`; without a folder they stay unchanged.
  explicit SettingWriter(std::optional<std::filesystem::path> folder) : folder_(std::move(folder)) {}

  [[nodiscard]] ordered_json& object() { return object_; }

 protected:
  bool met(const Setting& setting, const SettingValue& now, const Set& /*set*/) override {
    ordered_json& written = object_[std::string(setting.key)];
    if (setting.about.silent || std::holds_alternative<std::monostate>(now)) return false;
    if (const auto* list = std::get_if<WordedStretches>(&now)) {
      for (const Stretch& each : list->stretches) written.push_back(ordered_json::array({each.begin_s, each.end_s}));
      if (list->worded) written.push_back(std::string(setting.about.word));
    } else if (setting.kind == SettingKind::path && folder_) {
      written = from_folder(std::get<std::string>(now)).string();
    } else if (setting.kind == SettingKind::paths && folder_) {
      for (const std::string& each : std::get<std::vector<std::string>>(now))
        written.push_back(from_folder(each).string());
    } else if (setting.kind == SettingKind::count) {
      written = static_cast<long>(std::get<double>(now));
    } else {
      std::visit([&written](const auto& value) { write(value, written); }, now);
    }
    return false;
  }

  bool entered(std::string_view key, bool present, const About& /*about*/, const Inside& inside) override {
    ordered_json& written = object_[std::string(key)];
    if (present) written = written_by(inside);
    return false;
  }

  void repeated(std::string_view key, std::size_t count, const About& /*about*/, const InsideEach& inside) override {
    ordered_json list = ordered_json::array();
    for (std::size_t i = 0; i < count; ++i) list.push_back(written_by([&](SettingVisitor& each) { inside(i, each); }));
    object_[std::string(key)] = std::move(list);
  }

 private:
  /// Returns the path relative to the folder.
  [[nodiscard]] std::filesystem::path from_folder(const std::filesystem::path& path) const {
    const auto [rest, own] = std::mismatch(folder_->begin(), folder_->end(), path.begin(), path.end());
    const bool below = rest == folder_->end() && own != path.end();
    return below || path.is_relative() ? path.lexically_proximate(*folder_) : path;
  }

  template <typename Value>
  static void write(const Value& value, ordered_json& written) {
    written = value;
  }
  static void write(std::monostate /*nothing*/, ordered_json& /*written*/) {}
  static void write(const WordedStretches& /*handled above*/, ordered_json& /*written*/) {}

  [[nodiscard]] ordered_json written_by(const Inside& inside) const {
    SettingWriter writer(folder_);
    inside(writer);
    return std::move(writer.object_);
  }

  std::optional<std::filesystem::path> folder_;
  ordered_json object_ = ordered_json::object();
};

ordered_json settings(Study study, std::optional<std::filesystem::path> folder) {
  SettingWriter writer(std::move(folder));
  visit(study, writer);
  return std::move(writer.object());
}

std::string toml_key(const std::string& key) {
  const bool bare = !key.empty() && std::ranges::all_of(key, [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
  return bare ? key : toml_text(key);
}

std::string toml_value(const ordered_json& value) {
  std::vector<std::string> parts;
  if (value.is_string()) return toml_text(value.get<std::string>());
  if (value.is_number_float()) return toml_number(value.get<double>());
  if (value.is_array()) {
    for (const ordered_json& each : value) parts.push_back(toml_value(each));
    return fmt::format("[{}]", fmt::join(parts, ", "));
  }
  if (value.is_object()) {
    for (const auto& [key, each] : value.items()) {
      if (!each.is_null()) parts.push_back(fmt::format("{} = {}", toml_key(key), toml_value(each)));
    }
    return fmt::format("{{ {} }}", fmt::join(parts, ", "));
  }
  return json_text(value, -1);
}

std::string toml_lines(const ordered_json& table) {
  std::string text;
  for (const auto& [key, value] : table.items()) {
    if (!value.is_null()) text += fmt::format("{} = {}\n", toml_key(key), toml_value(value));
  }
  return text;
}

}  // namespace

std::string study_json(const Study& study) { return json_text(settings(study, std::nullopt), -1); }

std::string study_toml(const Study& study) {
  std::string text;
  const ordered_json all = settings(study, study.file.parent_path());
  for (const auto& [key, value] : all.items()) {
    if (value.is_object()) text += fmt::format("[{}]\n{}\n", key, toml_lines(value));
    if (!value.is_array()) continue;
    for (const ordered_json& each : value) text += fmt::format("[[{}]]\n{}\n", key, toml_lines(each));
  }
  return text;
}

}  // namespace myoid::study
