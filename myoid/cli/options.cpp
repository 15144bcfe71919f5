#include "myoid/cli/options.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/cli/command_help.h"
#include "myoid/commands/twin.h"
#include "myoid/files/text_file.h"
#include "myoid/mat/results_mat.h"
#include "myoid/study/setting_rows.h"

namespace myoid::cli {
namespace {

bool is_number(const Setting& setting) {
  return setting.kind == SettingKind::number || setting.kind == SettingKind::count;
}

std::string option_name(const Setting& setting) { return fmt::format("--{}", setting.key); }

/// Returns the sentences of the guide with range and default, for a terminal.
std::string help_of(const Setting& setting, const SettingRow& row) {
  std::vector<std::string> facts;
  if (is_number(setting)) facts.push_back(without_markdown(row.allowed));
  const std::string usual = without_markdown(row.usual);
  if (usual != "–" && usual != "required" && usual != "off") facts.push_back("default: " + usual);
  const std::string text = without_markdown(row.says);
  return facts.empty() ? text : fmt::format("{} ({})", text, fmt::join(facts, "; "));
}

/// Returns "{delay,shared}", NUMBER, FILE or TEXT.
std::string type_of(const Setting& setting) {
  if (!setting.about.words.empty()) return fmt::format("{{{}}}", fmt::join(setting.about.words, ","));
  if (is_number(setting)) return "NUMBER";
  return setting.kind == SettingKind::path ? "FILE" : "TEXT";
}

/// Returns the check of a number or a word, with the sentence that study.toml gets too.
CLI::Validator check_of(const Setting& setting) {
  return CLI::Validator(
      [setting](const std::string& text) -> std::string {
        if (!is_number(setting)) return refusal(setting, text);
        const auto value = recording::parse_number(text);
        return value ? refusal(setting, *value) : fmt::format("found '{}', expected a number", text);
      },
      "");
}

SettingValue value_of(const Setting& setting, const std::vector<std::string>& given) {
  if (is_number(setting)) return *recording::parse_number(given.front());
  if (setting.kind == SettingKind::texts) return given;
  return given.front();
}

}  // namespace

void add_truth_option(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option("--truth", settings, "Keys of [truth] in place of the protocol's: moment_arm_sd=0.15 curves=millard")
      ->type_name("KEY=VALUE");
  command.footer([] { return commands::truth_help(help_width()); });
}

bool OptionDeclarer::met(const Setting& setting, const SettingValue& now, const Set& /*set*/) {
  const SettingRow row = setting_row(setting, now, SettingNotation::command_line);
  const std::string help = help_of(setting, row);
  if (setting.kind == SettingKind::flag) {
    command_->add_flag(option_name(setting), help);
    return false;
  }
  CLI::Option* const option = command_->add_option(option_name(setting), help);
  option->required(!setting.about.required.empty());
  option->type_name(type_of(setting));
  if (setting.kind == SettingKind::texts)
    option->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args();
  if (is_number(setting) || !setting.about.words.empty()) option->check(check_of(setting));
  return false;
}

bool OptionReader::met(const Setting& setting, const SettingValue& /*now*/, const Set& set) {
  const CLI::Option* const option = command_->get_option(option_name(setting));
  if (option->count() == 0) return false;
  set(setting.kind == SettingKind::flag ? SettingValue(true) : value_of(setting, option->results()));
  return true;
}

void add_video_options(CLI::App& command, VideoChoice& video) {
  command
      .add_option("--video", video.files, "Film that the report shows beside the model, [TRIAL=]FILE; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--video-offset", video.offset_s, "When these films begin, in seconds of the motion (default 0)");
}

MatOption::MatOption(CLI::App& command) {
  command.add_option("--mat", *file_, "Also write parameters, series, remarks and draws as one MATLAB file (.mat)");
}

void MatOption::prepare(const Context& context, const std::vector<std::string>& inputs) const {
  if (file_->empty()) return;
  check_mat_file(*file_);
  context.prepare_file(*file_, inputs);
}

void MatOption::write(const std::filesystem::path& folder) const {
  if (!file_->empty()) write_results_mat(folder, *file_);
}

}  // namespace myoid::cli
