#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/core/error.h"
#include "myoid/core/json_text.h"
#include "myoid/draft/study_draft.h"
#include "myoid/files/atomic_file.h"

namespace myoid::cli {

void add_init(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand(
      "init",
      "Writes a commented study.toml to start from: finds recordings, pairs EMG channels with "
      "muscles, and leaves TODO lines where it cannot know.\n"
      "Example: myoid init study --from recordings --model arm.osim");
  struct Options {
    std::string folder, model, coordinate;
    std::vector<std::string> from;
  };
  const auto o = std::make_shared<Options>();
  command.add_option("dir", o->folder, "Folder for study.toml")->required();
  command.add_option("--from", o->from,
                     "A recording or a folder of them, repeated (default: the folder itself)");
  command.add_option("--model", o->model,
                     "OpenSim model (.osim); default: the only one in the folders, else the "
                     "built-in arm4");
  command.add_option("--coordinate", o->coordinate,
                     "The joint, by the model's coordinate (default: guessed)");
  add_common_options(command, context, {.threads = false, .seed = false, .range = false});
  command.callback([&context, o] {
    DraftOptions options;
    for (const std::string& from : o->from) options.from.emplace_back(from);
    if (options.from.empty()) options.from.emplace_back(o->folder);
    if (!o->model.empty()) options.model = o->model;
    options.coordinate = o->coordinate;
    const std::filesystem::path file = std::filesystem::path(o->folder) / "study.toml";
    context.prepare_file(file, {});
    const StudyDraft draft = draft_study(o->folder, options);
    recording::write_file(file, draft.toml);
    for (const std::string& note : draft.notes) context.log(note);
    if (context.json) {
      fmt::print("{}\n", json_text({{"file", file.string()}, {"todo", draft.todo}}));
      return;
    }
    fmt::print("{}\n", file.string());
    for (const std::string& todo : draft.todo) fmt::print("TODO {}\n", todo);
    fmt::print("next: myoid check {}\n", file.string());
  });
}

}  // namespace myoid::cli
