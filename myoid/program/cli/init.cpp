#include "myoid/program/commands/init.h"

#include <sstream>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/json_text.h"
#include "myoid/ground/files/quoted_text.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/say.h"

namespace myoid::program {
namespace {

/// Prints the questions of a draft with their lines, by which an editor finds them.
void print_questions(const std::string& toml) {
  static constexpr std::string_view kMark = "# TODO: ";
  std::istringstream lines(toml);
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (line.starts_with(kMark)) say("TODO line {}: {}\n", number, line.substr(kMark.size()));
  }
}

}  // namespace

void add_init(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("init",
                                          "Writes a commented study.toml to start from: finds recordings, pairs EMG "
                                          "channels with muscles, and leaves TODO lines where it cannot know.\n"
                                          "Example: myoid init study --from recordings --model arm.osim");
  const auto o = std::make_shared<program::InitOptions>();
  command.add_option("dir", o->folder, "Folder for study.toml")->required();
  command.add_option("--from", o->from,
                     "A recording or a folder of them, repeated, or a project of CEINMS, CEINMS-RT or NMSM (default: "
                     "the folder itself)");
  command.add_option("--model", o->model,
                     "OpenSim model (.osim); default: the only one in the folders, else the built-in arm4");
  command.add_option("--coordinate", o->coordinate, "The joint, by the model's coordinate (default: guessed)");
  add_common_options(command, context, {.threads = false, .seed = false, .range = false});
  command.callback([&context, o] {
    const std::filesystem::path file = std::filesystem::path(o->folder) / "study.toml";
    context.prepare_file(file, {});
    o->call = context.call();
    const program::InitResult result = program::init(*o);
    program::write_init(result, file, o->call);
    const std::vector<std::string>& todos = result.draft.todo;
    if (context.json) {
      say_whole(json_text(nlohmann::ordered_json{{"file", file.string()}, {"todo", todos}}) + "\n");
      return;
    }
    say("{}\n", file.string());
    print_questions(result.draft.toml);
    say("next: myoid check {}\n", shell_word(file.string()));
  });
}

}  // namespace myoid::program
