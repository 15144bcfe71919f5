#include "myoid/program/commands/check.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/say.h"
#include "myoid/program/cli/wrong_line.h"
#include "myoid/study/read_study.h"
#include "myoid/study/setting_rows.h"
#include "myoid/study/study_text.h"

namespace myoid::program {
namespace {

nlohmann::ordered_json findings_json(const std::vector<Remark>& findings) {
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Remark& f : findings) {
    json.push_back({{"level", std::string(name(f.severity))},
                    {"where", f.where},
                    {"message", sentence(f)},
                    {"code", std::string(name(f.code))}});
    if (!f.when) continue;
    json.back()["fault"] = std::string(name(f.code));
    json.back()["channel"] = f.about;
    json.back()["begin_s"] = f.when->begin_s;
    json.back()["end_s"] = f.when->end_s;
    json.back()["value"] = f.value.value_or(0.0);
  }
  return json;
}

void print_findings(const program::CheckResult& result, const std::string& input) {
  // The first of several faults that ask for the same remedy names the remedy.
  std::set<std::string> said;
  const std::vector<Remark> lines = named_together(result.findings);
  for (const Remark& f : lines) {
    const bool again = !f.remedy.empty() && !said.insert(f.remedy).second;
    say("{:<8} {}: {}\n", name(f.severity), f.where, again ? f.says : sentence(f));
  }
  const std::string subject =
      result.of_study ? fmt::format("{}, {}", counted(result.trials, "trial"), counted(result.muscles, "muscle"))
                      : input;
  const auto errors = static_cast<std::size_t>(std::ranges::count(lines, Severity::error, &Remark::severity));
  say("{}: {}, {}\n", subject, counted(errors, "error"), counted(lines.size() - errors, "remark"));
  if (result.of_study && errors == 0)
    say("left to the fit of myoid run: exchanged electrodes that no dynamometer shows, and another gain or clock of "
        "one trial\n");
}

/// Returns the name of a table of study.toml without brackets.
std::string bare_name(const study::SettingTable& table) {
  std::string name = table.name;
  std::erase_if(name, [](char c) { return c == '[' || c == ']'; });
  return name;
}

/// Returns the reason to refuse a name that no table of study.toml has; empty: one has it.
std::string refused_table(const std::string& name) {
  std::vector<std::string> names;
  for (const study::SettingTable& table : study::setting_tables()) names.push_back(bare_name(table));
  const std::vector<std::string_view> words(names.begin(), names.end());
  return study::refusal({.key = {}, .kind = study::SettingKind::text, .about = {.words = words}}, name);
}

/// Prints the study with its defaults; without a study the reference of the settings, of one table if it is named.
void print_settings(const Context& context, const std::string& file, const std::string& section) {
  if (!file.empty()) {
    const study::Study study = study::read_study(file);
    say_whole(context.json ? study::study_json(study) + "\n" : study::study_toml(study));
    return;
  }
  std::vector<study::SettingTable> tables = study::setting_tables();
  if (!section.empty()) std::erase_if(tables, [&](const auto& table) { return bare_name(table) != section; });
  say_whole(context.json ? study::reference_json(tables) : study::reference_text(tables));
}

/// Prints the command that goes on after a check. A model and a motion have none.
void print_next(const program::CheckResult& result, const program::CheckOptions& o) {
  const auto format = format_of(o.input);
  const std::string word = shell_word(o.input);
  if (!format) return;
  if (result.errors > 0) {
    say("next: mend {}, then: myoid check {}\n", result.errors == 1 ? "the error" : "the errors, the first one first",
        word);
    return;
  }
  if (result.of_study) {
    const ResultsPlace place = place_for_results(o.input);
    say("next: myoid run {} --out {}{}\n", word, shell_word(place.folder.string()),
        place.overwrite ? " --overwrite" : "");
  } else if (is_recording(*format) && *format != FileFormat::storage) {
    say("next: myoid init STUDY --from {}\n", word);
  }
}

void carry_out(Context& context, const CheckOptions& o, const CLI::App& command) {
  if (command.count("--defaults") > 0 || command.count("--settings") > 0) {
    warn_of_idle_options(command, context, {"--settings", "--defaults"}, "settings");
    return print_settings(context, o.input, command["--settings"]->as<std::string>());
  }
  if (o.input.empty()) throw WrongCommandLine("check needs STUDY, or --settings; myoid check --help explains them");
  const program::CheckResult result = program::check(o);
  if (context.json) {
    say_whole(json_text(findings_json(result.findings)) + "\n");
  } else {
    print_findings(result, o.input);
    print_next(result, o);
  }
  if (result.errors > 0) context.exit_code = kBadInput;
}

}  // namespace

void add_check(CLI::App& app, Context& context) {
  CLI::App* const command = add_command<CheckOptions>(
      app, context, "check",
      "Reads every input of a study, a single recording or motion, or a model, and lists its faults, worst first; "
      "computes nothing. Or explains every setting of a study.\n"
      "Example: myoid check study.toml",
      {.threads = false, .seed = false, .overwrite = false}, carry_out);
  command->option_defaults()->group("In place of a check");
  CLI::Option* const settings =
      command
          ->add_option("--settings",
                       "Explains every setting of study.toml: values, default, meaning; or those of one table")
          ->expected(0, 1)
          ->type_name("TABLE")
          ->check(CLI::Validator(refused_table, ""))
          ->excludes(command->get_option("study"));
  command
      ->add_flag_callback(
          "--defaults", [] {},
          "Prints the study with all settings that it leaves to their defaults; without a study as --settings")
      ->excludes(settings);
  command->option_defaults()->group("Options");
}

}  // namespace myoid::program
