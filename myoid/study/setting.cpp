#include "myoid/study/setting.h"

namespace myoid {

namespace {

template <typename T>
SettingValue or_nothing(const std::optional<T>& value) {
  return value ? SettingValue(*value) : SettingValue();
}

}  // namespace

bool SettingVisitor::flag(std::string_view key, bool& value, const About& about) {
  return met({key, SettingKind::flag, about}, value,
             [&](SettingValue given) { value = std::get<bool>(given); });
}

bool SettingVisitor::flag(std::string_view key, std::optional<bool>& value, const About& about) {
  return met({key, SettingKind::flag, about}, or_nothing(value),
             [&](SettingValue given) { value = std::get<bool>(given); });
}

bool SettingVisitor::either(std::string_view key, bool& value, const About& about) {
  return met({key, SettingKind::text, about}, std::string(about.words[value ? 1 : 0]),
             [&](SettingValue given) { value = std::get<std::string>(given) == about.words[1]; });
}

bool SettingVisitor::number(std::string_view key, double& value, const About& about) {
  return met({key, SettingKind::number, about}, value,
             [&](SettingValue given) { value = std::get<double>(given); });
}

bool SettingVisitor::number(std::string_view key,
                            std::optional<double>& value,
                            const About& about) {
  return met({key, SettingKind::number, about}, or_nothing(value),
             [&](SettingValue given) { value = std::get<double>(given); });
}

bool SettingVisitor::number(std::string_view key,
                            std::optional<double>& value,
                            bool& worded,
                            const About& about) {
  return met({key, SettingKind::number, about},
             worded ? SettingValue(std::string(about.word)) : or_nothing(value),
             [&](SettingValue given) {
               worded = std::holds_alternative<std::string>(given);
               value.reset();
               if (!worded) value = std::get<double>(given);
             });
}

bool SettingVisitor::count(std::string_view key, int& value, const About& about) {
  return met({key, SettingKind::count, about}, static_cast<double>(value),
             [&](SettingValue given) { value = static_cast<int>(std::get<double>(given)); });
}

bool SettingVisitor::text(std::string_view key, std::string& value, const About& about) {
  return met({key, SettingKind::text, about}, value,
             [&](SettingValue given) { value = std::get<std::string>(given); });
}

bool SettingVisitor::text(std::string_view key,
                          std::string& value,
                          std::optional<std::string>& instead,
                          const About& about) {
  using Table = std::map<std::string, std::string>;
  const std::string other(about.table);
  return met({key, SettingKind::text, about},
             instead ? SettingValue(Table{{other, *instead}}) : SettingValue(value),
             [&](SettingValue given) {
               if (const auto* table = std::get_if<Table>(&given)) {
                 instead = table->at(other);
               } else {
                 value = std::get<std::string>(given);
               }
             });
}

bool SettingVisitor::path(std::string_view key, std::filesystem::path& value, const About& about) {
  return met({key, SettingKind::path, about},
             value.empty() ? SettingValue() : SettingValue(value.string()),
             [&](SettingValue given) { value = std::get<std::string>(given); });
}

bool SettingVisitor::path(std::string_view key,
                          std::optional<std::filesystem::path>& value,
                          const About& about) {
  return met({key, SettingKind::path, about},
             value ? SettingValue(value->string()) : SettingValue(),
             [&](SettingValue given) { value = std::get<std::string>(given); });
}

bool SettingVisitor::texts(std::string_view key,
                           std::vector<std::string>& value,
                           const About& about) {
  const bool worded = value.empty() && !about.word.empty();
  return met({key, SettingKind::texts, about},
             worded ? SettingValue(std::string(about.word)) : SettingValue(value),
             [&](SettingValue given) {
               const auto* list = std::get_if<std::vector<std::string>>(&given);
               value = list != nullptr ? *list : std::vector<std::string>{};
             });
}

bool SettingVisitor::numbers(std::string_view key, std::vector<double>& value, const About& about) {
  return met({key, SettingKind::numbers, about},
             value.empty() ? SettingValue() : SettingValue(value),
             [&](SettingValue given) { value = std::get<std::vector<double>>(given); });
}

bool SettingVisitor::texts_by_name(std::string_view key,
                                   std::map<std::string, std::string>& value,
                                   const About& about) {
  return met({key, SettingKind::texts_by_name, about}, value, [&](SettingValue given) {
    value = std::get<std::map<std::string, std::string>>(given);
  });
}

bool SettingVisitor::numbers_by_name(std::string_view key,
                                     std::map<std::string, double>& value,
                                     const About& about) {
  return met({key, SettingKind::numbers_by_name, about}, value,
             [&](SettingValue given) { value = std::get<std::map<std::string, double>>(given); });
}

void SettingVisitor::must(bool /*holds*/,
                          std::string_view /*key*/,
                          const std::string& /*message*/) {}

}  // namespace myoid
