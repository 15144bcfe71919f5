#include <algorithm>
#include <set>
#include <string>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/checks/check_study.h"
#include "myoid/cli/context.h"
#include "myoid/core/counted.h"
#include "myoid/core/json_text.h"
#include "myoid/recording/laboratory_up.h"
#include "myoid/recording/recording.h"

namespace myoid::cli {

void add_check(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("check",
                                          "Reads every input of a study, or a single recording, "
                                          "and says what is wrong with it, worst first; computes "
                                          "nothing.\n"
                                          "Example: myoid check study.toml");
  struct Options {
    std::string input;
    std::string up;
  };
  const auto o = std::make_shared<Options>();
  command
      .add_option("study", o->input,
                  "study.toml, or a single recording: .c3d, .trc, .edf, .bdf, .anc, .csv, .tsv")
      ->required();
  command
      .add_option(
          "--up", o->up,
          "Vertical of a single recording's laboratory, for its force plates: x, y, z, -x, -y "
          "or -z (default: as the file says)")
      ->check(CLI::IsMember({"x", "y", "z", "-x", "-y", "-z"}));
  add_common_options(command, context, {.threads = false, .seed = false, .overwrite = false});
  command.callback([&context, o] {
    std::vector<Finding> findings;
    std::string what;
    if (recording::extension_of(o->input) == ".toml") {
      Study study = read_study(o->input);
      restrict_trials(study, context.start_s, context.end_s);
      findings = check_study(study);
      what = fmt::format("{}, {}", counted(study.trials.size(), "trial"),
                         counted(study.muscles.size(), "muscle"));
    } else {
      findings = check_recording(o->input, recording::axis_vector(o->up));
      what = o->input;
    }
    const auto errors = std::count_if(findings.begin(), findings.end(), [](const auto& f) {
      return f.level == Finding::Level::error;
    });
    if (context.json) {
      nlohmann::ordered_json json = nlohmann::ordered_json::array();
      for (const auto& f : findings) {
        json.push_back(
            {{"level", std::string(name(f.level))}, {"where", f.where}, {"message", f.message}});
        if (!f.fault) continue;
        json.back()["fault"] = std::string(name(f.fault->kind));
        json.back()["channel"] = f.fault->channel;
        json.back()["begin_s"] = f.fault->begin_s;
        json.back()["end_s"] = f.fault->end_s;
        json.back()["value"] = f.fault->value;
      }
      fmt::print("{}\n", json_text(json));
    } else {
      // What to do is said with the first of several faults that ask for the same.
      std::set<std::string> said;
      for (const auto& f : findings) {
        const bool again =
            f.fault && !f.fault->remedy.empty() && !said.insert(f.fault->remedy).second;
        fmt::print("{:<8} {}: {}\n", name(f.level), f.where, again ? f.fault->text : f.message);
      }
      fmt::print("{}: {}, {}\n", what, counted(static_cast<std::size_t>(errors), "error"),
                 counted(findings.size() - static_cast<std::size_t>(errors), "remark"));
    }
    if (errors > 0) context.exit_code = kBadInput;
  });
}

}  // namespace myoid::cli
