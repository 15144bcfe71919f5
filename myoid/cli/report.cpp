#include "myoid/commands/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/held_folders.h"
#include "myoid/cli/mat_option.h"
#include "myoid/cli/video_options.h"
#include "myoid/core/json_text.h"

namespace myoid::cli {

void add_report(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("report",
                          "Rebuilds the report of a finished run from its recordings, provided "
                          "that none of them has changed since.\n"
                          "Example: myoid report results");
  const auto o = std::make_shared<commands::ReportOptions>();
  command.add_option("folder", o->folder, "Folder of a run (with run.json)")->required();
  add_video_options(command, o->video);
  const MatOption mat(command);
  add_common_options(command, context, {.seed = false, .range = false, .overwrite = false});
  command.callback([&context, o, mat] {
    context.overwrite = true;  // everything that this command writes is made anew
    mat.prepare(context, {});
    o->call = context.call();
    const commands::ReportResult result = commands::report(*o);
    hold_folder(std::make_unique<recording::ResultFolder>(o->folder, context.command_line));
    commands::write_report(result, o->folder);
    mat.write(o->folder);
    context.end_progress();
    const std::string page = (std::filesystem::path(o->folder) / "report.html").string();
    if (context.json) {
      fmt::print("{}\n", json_text(nlohmann::ordered_json{{"report", page}}));
    } else {
      fmt::print("{}\n", page);
    }
  });
}

}  // namespace myoid::cli
