#include "myoid/program/commands/update_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/program/cli/context.h"
#include "myoid/program/cli/option_checks.h"

namespace myoid::program {

void add_update_file(CLI::App& app, Context& context) {
  CLI::App& command = *app.add_subcommand("update-file",
                                          "Write an OpenSim model or set-up of any version in the newest form\n"
                                          "Example: myoid update-file gait2392_v2.osim gait2392.osim");
  const auto new_file = std::make_shared<std::string>();
  const auto o = std::make_shared<program::UpdateFileOptions>();
  command.add_option("old", o->file, "Model, set-up or set (.osim, .xml)")->required();
  command.add_option("new", *new_file, "File to write")->required();
  command
      .add_option("--compat", o->compat,
                  "exact: offsets of joints and inertias keep their digits; opensim: they are rounded to six, as "
                  "OpenSim converts them (default exact)")
      ->check(one_of({"exact", "opensim"}));
  add_common_options(command, context, {.threads = false, .seed = false, .range = false});
  command.callback([&context, o, new_file] {
    context.prepare_file(*new_file, {o->file});
    o->call = context.call();
    const program::UpdateFileResult result = program::update_file(*o);
    program::write_update_file(result, *new_file);
    nlohmann::ordered_json notes = nlohmann::ordered_json::array();
    for (const Remark& remark : result.remarks) notes.push_back(sentence(remark));
    context.print(
        {{"file", *new_file}, {"old_version", result.old_version}, {"version", result.version}, {"notes", notes}},
        fmt::format("version {} -> {}\n{}", result.old_version, result.version, *new_file));
  });
}

}  // namespace myoid::program
