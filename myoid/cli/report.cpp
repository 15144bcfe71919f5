#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/cli/context.h"
#include "myoid/cli/held_folders.h"
#include "myoid/core/error.h"
#include "myoid/core/json_text.h"
#include "myoid/files/text_file.h"
#include "myoid/report/write_report.h"
#include "myoid/results/study_report.h"
#include "myoid/results/study_scene.h"
#include "myoid/run/run_study.h"
#include "myoid/study/study_json.h"

namespace myoid::cli {

void add_report(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("report",
                          "Rebuilds the report of a finished run from its recordings, provided "
                          "that none of them has changed since.\n"
                          "Example: myoid report results");
  const auto folder = std::make_shared<std::string>();
  command.add_option("folder", *folder, "Folder of a run (with run.json)")->required();
  add_common_options(command, context, {.seed = false, .range = false, .overwrite = false});
  command.callback([&context, folder] {
    const std::filesystem::path path = std::filesystem::path(*folder) / "run.json";
    nlohmann::ordered_json run;
    try {
      run = nlohmann::ordered_json::parse(recording::read_text_file(path));
    } catch (const nlohmann::json::exception& error) {
      throw ReadError(path, 0,
                      fmt::format("not a run's record: {}; run the study again", error.what()));
    }
    if (!run.contains("study"))
      throw ReadError(path, 0, "does not name its study; run the study again");
    const Study study = read_study(run["study"].get<std::string>());
    const auto then = [&](const char* key) -> std::optional<double> {
      return run.contains(key) && run[key].is_number() ? std::optional<double>(run[key])
                                                       : std::nullopt;
    };
    const StudyResult result = run_study(
        study,
        {.start_s = then("start_s"), .end_s = then("end_s"), .progress = context.progress()});
    for (const InputFile& now : result.source.files) {
      for (const auto& recorded : run["inputs"]) {
        if (std::filesystem::path(recorded["path"].get<std::string>()).filename() ==
                std::filesystem::path(now.path).filename() &&
            recorded["sha256"] != now.sha256) {
          throw ReadError(
              now.path, 0,
              fmt::format("has changed since the run in {}; run the study again (myoid run)",
                          *folder));
        }
      }
    }
    Provenance provenance;
    provenance.command = run.value("command", context.command_line);
    provenance.inputs = result.source.files;
    provenance.options_json = study_json(result.source.study);
    hold_folder(*folder).sign(context.command_line, false);
    write_motion_page(result, *folder);
    report::write_report(study_report(result, provenance), *folder);
    context.end_progress();
    const std::string page = (std::filesystem::path(*folder) / "report.html").string();
    if (context.json) {
      fmt::print("{}\n", json_text({{"report", page}}));
    } else {
      fmt::print("{}\n", page);
    }
  });
}

}  // namespace myoid::cli
