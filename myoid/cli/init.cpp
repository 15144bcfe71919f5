#include "myoid/commands/init.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/say.h"
#include "myoid/core/json_text.h"
#include "myoid/files/quoted_text.h"

namespace myoid::cli {

void add_init(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("init",
                                          "Writes a commented study.toml to start from: finds recordings, pairs EMG "
                                          "channels with muscles, and leaves TODO lines where it cannot know.\n"
                                          "Example: myoid init study --from recordings --model arm.osim");
  const auto o = std::make_shared<commands::InitOptions>();
  command.add_option("dir", o->folder, "Folder for study.toml")->required();
  command.add_option("--from", o->from, "A recording or a folder of them, repeated (default: the folder itself)");
  command.add_option("--model", o->model,
                     "OpenSim model (.osim); default: the only one in the folders, else the built-in arm4");
  command.add_option("--coordinate", o->coordinate, "The joint, by the model's coordinate (default: guessed)");
  add_common_options(command, context, {.threads = false, .seed = false, .range = false});
  command.callback([&context, o] {
    const std::filesystem::path file = std::filesystem::path(o->folder) / "study.toml";
    context.prepare_file(file, {});
    o->call = context.call();
    const commands::InitResult result = commands::init(*o);
    commands::write_init(result, file, o->call);
    const std::vector<std::string>& todos = result.draft.todo;
    if (context.json) {
      say_whole(json_text(nlohmann::ordered_json{{"file", file.string()}, {"todo", todos}}) + "\n");
      return;
    }
    say("{}\n", file.string());
    for (const std::string& todo : todos) say("TODO {}\n", todo);
    say("next: myoid check {}\n", recording::shell_word(file.string()));
  });
}

}  // namespace myoid::cli
