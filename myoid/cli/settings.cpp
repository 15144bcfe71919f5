#include "myoid/commands/settings.h"

#include <fmt/format.h>

#include "myoid/cli/context.h"
#include "myoid/cli/say.h"

namespace myoid::cli {

void add_settings(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "settings",
      "Explains every setting of a study file; or prints a study with all settings that it leaves to their defaults.\n"
      "Example: myoid settings study.toml");
  const auto options = std::make_shared<commands::SettingsOptions>();
  command.add_option("study", options->study, "study.toml; without it, the reference is printed");
  add_common_options(command, context, {.threads = false, .seed = false, .range = false, .overwrite = false});
  command.callback([&context, options] {
    options->call = context.call();
    const commands::SettingsResult result = commands::settings(*options);
    say_whole(context.json ? commands::settings_json(result) : commands::settings_text(result));
  });
}

}  // namespace myoid::cli
