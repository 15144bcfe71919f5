#include "myoid/program/cli/options.h"

#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "myoid/ground/files/text_file.h"
#include "myoid/program/cli/command_help.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/commands/twin.h"
#include "myoid/results/mat/results_mat.h"
#include "myoid/study/setting_rows.h"

namespace myoid::program {
namespace {

bool is_number(const study::Setting& setting) {
  return setting.kind == study::SettingKind::number || setting.kind == study::SettingKind::count;
}

std::string option_name(const study::Setting& setting) { return fmt::format("--{}", setting.key); }

/// Returns the sentences of the guide with range and default, for a terminal.
std::string help_of(const study::Setting& setting, const study::SettingRow& row) {
  std::vector<std::string> facts;
  if (is_number(setting)) facts.push_back(study::without_markdown(row.allowed));
  const std::string usual = study::without_markdown(row.usual);
  if (usual != "–" && usual != "required" && usual != "off") facts.push_back("default: " + usual);
  const std::string text = study::without_markdown(row.says);
  return facts.empty() ? text : fmt::format("{} ({})", text, fmt::join(facts, "; "));
}

/// Returns "{delay,shared}", NUMBER, FILE or TEXT.
std::string type_of(const study::Setting& setting) {
  if (!setting.about.words.empty()) return fmt::format("{{{}}}", fmt::join(setting.about.words, ","));
  if (is_number(setting)) return "NUMBER";
  return setting.kind == study::SettingKind::path ? "FILE" : "TEXT";
}

/// Returns the check of a number or a word, with the sentence that study.toml gets too.
CLI::Validator check_of(const study::Setting& setting) {
  return CLI::Validator(
      [setting](const std::string& text) -> std::string {
        if (!is_number(setting)) return study::refusal(setting, text);
        const auto value = parse_number(text);
        return value ? study::refusal(setting, *value) : fmt::format("found '{}', expected a number", text);
      },
      "");
}

study::SettingValue value_of(const study::Setting& setting, const std::vector<std::string>& given) {
  if (is_number(setting)) return *parse_number(given.front());
  if (setting.kind == study::SettingKind::texts) return given;
  return given.front();
}

}  // namespace

void add_truth_option(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option("--truth", settings, "Keys of [truth] in place of the protocol's: moment_arm_sd=0.15 curves=millard")
      ->type_name("KEY=VALUE");
  command.footer([] { return program::truth_help(help_width()); });
}

bool OptionDeclarer::met(const study::Setting& setting, const study::SettingValue& now, const Set& /*set*/) {
  const study::SettingRow row = study::setting_row(setting, now, study::SettingNotation::command_line);
  const std::string help = help_of(setting, row);
  if (setting.kind == study::SettingKind::flag) {
    command_->add_flag(option_name(setting), help);
    return false;
  }
  CLI::Option* const option = command_->add_option(option_name(setting), help);
  option->required(!setting.about.required.empty());
  option->type_name(type_of(setting));
  if (setting.kind == study::SettingKind::texts)
    option->expected(1, CLI::detail::expected_max_vector_size)->allow_extra_args();
  if (is_number(setting) || !setting.about.words.empty()) option->check(check_of(setting));
  return false;
}

bool OptionReader::met(const study::Setting& setting, const study::SettingValue& /*now*/, const Set& set) {
  const CLI::Option* const option = command_->get_option(option_name(setting));
  if (option->count() == 0) return false;
  set(setting.kind == study::SettingKind::flag ? study::SettingValue(true) : value_of(setting, option->results()));
  return true;
}

void add_video_options(CLI::App& command, study::VideoChoice& video) {
  command
      .add_option("--video", video.files, "Film that the report shows beside the model, [TRIAL=]FILE; may be repeated")
      ->allow_extra_args(false);
  command.add_option("--video-offset", video.offset_s, "When these films begin, in seconds of the motion (default 0)");
}

CLI::Option* add_export_option(CLI::App& command, std::vector<results::ExportFormat>& formats) {
  return command
      .add_option("--export", formats,
                  "Muscles for other programs: ceinms, ceinms-rt, osimx; osim, the identified model, is always written")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->transform(one_of<results::ExportFormat>());
}

MatOption::MatOption(CLI::App& command) {
  command.add_option("--mat", *file_, "Also write parameters, series, remarks and draws as one MATLAB file (.mat)");
}

void MatOption::prepare(const Context& context, const std::vector<std::string>& inputs) const {
  if (file_->empty()) return;
  results::check_mat_file(*file_);
  context.prepare_file(*file_, inputs);
}

void MatOption::write(const std::filesystem::path& folder) const {
  if (!file_->empty()) results::write_results_mat(folder, *file_);
}

}  // namespace myoid::program
