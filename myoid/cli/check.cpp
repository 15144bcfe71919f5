#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/pipeline/check_study.h"

namespace myoid::cli {

void add_check(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("check",
                                          "Reads every input of a study and says what is wrong "
                                          "with it, worst first; computes nothing.\n"
                                          "Example: myoid check study.toml");
  const auto study_file = std::make_shared<std::string>();
  command.add_option("study", *study_file, "study.toml")->required();
  add_common_options(command, context, {.threads = false, .seed = false, .overwrite = false});
  command.callback([&context, study_file] {
    pipeline::Study study = pipeline::read_study(*study_file);
    pipeline::restrict_trials(study, context.start_s, context.end_s);
    const std::vector<pipeline::Finding> findings = pipeline::check_study(study);
    const auto errors = std::count_if(findings.begin(), findings.end(), [](const auto& f) {
      return f.level == pipeline::Finding::Level::error;
    });
    if (context.json) {
      nlohmann::ordered_json json = nlohmann::ordered_json::array();
      for (const auto& f : findings)
        json.push_back(
            {{"level", std::string(name(f.level))}, {"where", f.where}, {"message", f.message}});
      fmt::print("{}\n", json.dump(2));
    } else {
      for (const auto& f : findings)
        fmt::print("{:<8} {}: {}\n", name(f.level), f.where, f.message);
      const auto counted = [](auto count, std::string_view noun) {
        return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
      };
      fmt::print("{}, {}: {}, {}\n", counted(study.trials.size(), "trial"),
                 counted(study.muscles.size(), "muscle"), counted(errors, "error"),
                 counted(static_cast<long>(findings.size()) - errors, "remark"));
    }
    if (errors > 0) context.exit_code = kBadInput;
  });
}

}  // namespace myoid::cli
