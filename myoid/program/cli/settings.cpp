#include "myoid/program/commands/settings.h"

#include <fmt/format.h>

#include "myoid/program/cli/context.h"
#include "myoid/program/cli/say.h"

namespace myoid::program {

void add_settings(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "settings",
      "Explains every setting of a study file; or prints a study with all settings that it leaves to their defaults.\n"
      "Example: myoid settings study.toml");
  const auto options = std::make_shared<program::SettingsOptions>();
  command.add_option("study", options->study, "study.toml; without it, the reference is printed");
  add_common_options(command, context, {.threads = false, .seed = false, .range = false, .overwrite = false});
  command.callback([&context, options] {
    options->call = context.call();
    const program::SettingsResult result = program::settings(*options);
    say_whole(context.json ? program::settings_json(result) : program::settings_text(result));
  });
}

}  // namespace myoid::program
