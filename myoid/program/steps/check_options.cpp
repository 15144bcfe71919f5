#include "myoid/program/steps/check_options.h"

#include <algorithm>

#include <fmt/format.h>

#include "myoid/ground/core/error.h"

namespace myoid::program {
namespace {

class OptionCheck : public study::FlatSettingVisitor {
 protected:
  bool met(const study::Setting& setting, const study::SettingValue& now, const Set& /*set*/) override {
    const auto check = [&](const auto& value) {
      const std::string reason = study::refusal(setting, value);
      if (!reason.empty()) throw InvalidInput(fmt::format("--{}: {}", setting.key, reason));
    };
    if (const auto* number = std::get_if<double>(&now)) check(*number);
    if (const auto* word = std::get_if<std::string>(&now); word != nullptr && !word->empty()) check(*word);
    if (const auto* numbers = std::get_if<std::vector<double>>(&now)) {
      if (setting.about.count > 0 && numbers->size() != setting.about.count)
        throw InvalidInput(
            fmt::format("--{}: found {} numbers, expected {}", setting.key, numbers->size(), setting.about.count));
      std::ranges::for_each(*numbers, check);
    }
    return false;
  }
};

}  // namespace

void check_visited(const study::SettingVisitor::Inside& visit_all) {
  OptionCheck check;
  visit_all(check);
}

}  // namespace myoid::program
