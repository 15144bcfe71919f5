#include "myoid/program/commands/check.h"

#include <set>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/file_format.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"
#include "myoid/program/cli/say.h"

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
  for (const Remark& f : result.findings) {
    const bool again = !f.remedy.empty() && !said.insert(f.remedy).second;
    say("{:<8} {}: {}\n", name(f.severity), f.where, again ? f.says : sentence(f));
  }
  const std::string subject =
      result.of_study ? fmt::format("{}, {}", counted(result.trials, "trial"), counted(result.muscles, "muscle"))
                      : input;
  say("{}: {}, {}\n", subject, counted(result.errors, "error"),
      counted(result.findings.size() - result.errors, "remark"));
}

}  // namespace

void add_check(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "check",
      "Reads every input of a study, a single recording or motion, or a model, and lists its faults, worst first; "
      "computes nothing.\n"
      "Example: myoid check study.toml");
  const auto o = std::make_shared<program::CheckOptions>();
  const std::string recordings = endings_text([](const FormatEntry& entry) { return is_recording(entry.format); });
  command.add_option("study", o->input, "study.toml, a model (.osim), or a single recording: " + recordings)
      ->required();
  command.add_option("--model", o->model,
                     "Model of a motion (.mot, .sto), whose columns are its coordinates: a file (.osim), or arm4");
  command
      .add_option("--up", o->up,
                  "Vertical of a single recording's laboratory, for its force plates: x, y, z, -x, -y or -z (default: "
                  "as the file says)")
      ->check(one_of({"x", "y", "z", "-x", "-y", "-z"}));
  add_common_options(command, context, {.threads = false, .seed = false, .overwrite = false});
  command.callback([&context, o] {
    o->call = context.call();
    const program::CheckResult result = program::check(*o);
    if (context.json) {
      say_whole(json_text(findings_json(result.findings)) + "\n");
    } else {
      print_findings(result, o->input);
    }
    if (result.errors > 0) context.exit_code = kBadInput;
  });
}

}  // namespace myoid::program
