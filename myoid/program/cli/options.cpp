#include "myoid/program/cli/options.h"

#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/files/text_file.h"
#include "myoid/results/mat/results_mat.h"
#include "myoid/study/setting_rows.h"

namespace myoid::program {
namespace {

std::string option_name(const study::Setting& setting) {
  return fmt::format("{}{}", setting.about.option.by_place ? "" : "--", setting.key);
}

std::string type_of(const study::Setting& setting) {
  using study::SettingKind;
  if (is_number(setting)) return "NUMBER";
  if (setting.kind == SettingKind::folder) return "FOLDER";
  return setting.kind == SettingKind::path || setting.kind == SettingKind::paths ? "FILE" : "TEXT";
}

/// Returns the check of a number or a word, with the sentence that study.toml gets too. Its name is the range or the
/// words: "0 to 0.3 s", "{delay,shared}".
CLI::Validator check_of(const study::Setting& setting) {
  const study::SettingLimits& limits = setting.about.limits;
  const bool is_limited = std::isfinite(limits.lower) || std::isfinite(limits.upper);
  return CLI::Validator(
      [setting](const std::string& text) -> std::string {
        if (!is_number(setting)) return study::refusal(setting, text);
        const auto value = parse_number(text);
        return value ? study::refusal(setting, *value) : fmt::format("found '{}', expected a number", text);
      },
      !is_number(setting) ? fmt::format("{{{}}}", fmt::join(setting.about.words, ","))
      : is_limited        ? study::range_text(limits)
                          : "");
}

study::SettingValue value_of(const study::Setting& setting, const std::vector<std::string>& given) {
  using study::SettingKind;
  if (setting.kind == SettingKind::flag) return true;
  if (setting.kind == SettingKind::texts || setting.kind == SettingKind::paths) return given;
  if (!is_number(setting)) return given.front();
  std::vector<double> numbers;
  for (const std::string& text : given) numbers.push_back(*parse_number(text));
  return setting.kind == SettingKind::numbers ? study::SettingValue(numbers) : numbers.front();
}

bool takes_several(const study::Setting& setting) {
  using study::SettingKind;
  return setting.kind == SettingKind::texts || setting.kind == SettingKind::paths ||
         setting.kind == SettingKind::numbers;
}

/// The options of a command by the names that stand in a text, separated by commas.
std::vector<CLI::Option*> options_named(CLI::App& command, std::string_view names) {
  std::vector<CLI::Option*> options;
  for (const std::string_view each : names.empty() ? std::vector<std::string_view>() : split(names, ',')) {
    CLI::Option* const option = command.get_option_no_throw(fmt::format("--{}", each));
    options.push_back(option != nullptr ? option : command.get_option(std::string(each)));
  }
  return options;
}

class OptionDeclarer : public study::FlatSettingVisitor {
 public:
  explicit OptionDeclarer(CLI::App& command) : command_(&command) {}

 protected:
  bool met(const study::Setting& setting, const study::SettingValue& now, const Set& /*set*/) override {
    const study::About& about = setting.about;
    const std::string name = option_name(setting);
    if (command_->get_option_no_throw(name) != nullptr) return false;  // of another struct of the command, too
    const study::SettingRow row = study::setting_row(setting, now, study::SettingNotation::command_line);
    const std::string names = fmt::format("{}{}{}", name, about.option.also.empty() ? "" : ",", about.option.also);
    const std::string text = study::without_markdown(row.says);
    const std::string says = text.substr(0, text.size() - (text.ends_with('.') ? 1 : 0));
    const auto nothing = [] {};
    const bool is_flag = setting.kind == study::SettingKind::flag;
    CLI::Option* const option =
        is_flag ? command_->add_flag_callback(names, nothing, says) : command_->add_option(names, says);
    if (!about.option.group.empty()) option->group(std::string(about.option.group));
    for (CLI::Option* needed : options_named(*command_, about.option.needs)) option->needs(needed);
    for (CLI::Option* other : options_named(*command_, about.option.excludes)) option->excludes(other);
    if (about.required.empty() && row.usual != "–" && row.usual != "off")
      option->default_str(study::without_markdown(row.usual));
    if (is_flag) return false;
    option->required(!about.required.empty())->type_name(type_of(setting));
    if (is_number(setting) || !about.words.empty()) option->check(check_of(setting));
    if (about.count > 0) option->expected(static_cast<int>(about.count));
    if (about.count == 0 && takes_several(setting))
      option->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args(!about.option.one_each);
    if (about.option.by_comma) option->delimiter(',');
    return false;
  }

 private:
  CLI::App* command_;
};

class OptionReader : public study::FlatSettingVisitor {
 public:
  explicit OptionReader(const CLI::App& command) : command_(&command) {}

 protected:
  bool met(const study::Setting& setting, const study::SettingValue& /*now*/, const Set& set) override {
    const CLI::Option* const option = command_->get_option(option_name(setting));
    if (option->count() == 0) return false;
    set(value_of(setting, option->results()));
    return true;
  }

 private:
  const CLI::App* command_;
};

}  // namespace

void declare_visited(CLI::App& command, const study::SettingVisitor::Inside& visit_all) {
  OptionDeclarer declarer(command);
  visit_all(declarer);
}

void read_visited(const CLI::App& command, const study::SettingVisitor::Inside& visit_all) {
  OptionReader reader(command);
  visit_all(reader);
}

void prepare_mat(const Context& context, const std::string& file, const std::vector<std::string>& inputs) {
  if (file.empty()) return;
  results::check_mat_file(file);
  context.prepare_file(file, inputs);
}

void write_mat(const std::string& file, const std::filesystem::path& folder) {
  if (!file.empty()) results::write_results_mat(folder, file);
}

}  // namespace myoid::program
