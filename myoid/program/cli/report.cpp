#include "myoid/program/commands/report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/page/write_report.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/wrong_line.h"
#include "myoid/results/cohort/group_report.h"

namespace myoid::program {
namespace {

struct Wishes {
  program::ReportOptions run;
  std::vector<std::string> persons, after;
  std::string out = "group";
};

void print_page(const std::filesystem::path& folder, const Context& context) {
  const std::string page = (folder / "report.html").string();
  context.print({{"report", page}}, page);
}

void report_run(Context& context, program::ReportOptions& run, const MatOption& mat) {
  context.overwrite = true;  // everything that this command writes is made anew
  mat.prepare(context, {});
  run.call = context.call();
  const program::ReportResult result = program::report(run);
  context.prepare_run_folder(run.folder);
  program::write_report(result, run.folder);
  mat.write(run.folder);
  context.end_progress();
  print_page(run.folder, context);
}

void report_group(Context& context, const Wishes& wishes) {
  context.prepare_folder(wishes.out);
  const page::Report page = results::group_report({.persons = {wishes.persons.begin(), wishes.persons.end()},
                                                   .after = {wishes.after.begin(), wishes.after.end()},
                                                   .folder = wishes.out});
  for (const page::Gate& gate : page.gates) context.warn(gate.value);
  page::write_report(page, wishes.out);
  print_page(wishes.out, context);
}

}  // namespace

void add_report(CLI::App& app, Context& context) {
  CLI::App& command =
      *app.add_subcommand("report",
                          "Rebuilds the report of a finished run from its recordings, provided that none of them has "
                          "changed since; or sets many finished runs side by side.\n"
                          "Example: myoid report results\n"
                          "Example: myoid report --group results/P01 results/P02 results/P03 --out group");
  const auto wishes = std::make_shared<Wishes>();
  CLI::Option* folder = command.add_option("folder", wishes->run.folder, "Folder of a run (with run.json)");
  add_video_options(command, wishes->run.video);
  CLI::Option* exports = add_export_option(command, wishes->run.exports);
  CLI::Option* group =
      command.add_option("--group", wishes->persons,
                         "Folders of runs, or folders that hold them (of a cohort, of a twin-study): one page of all");
  group->excludes(folder)->excludes(exports);
  command
      .add_option("--after", wishes->after, "The second sessions of the same persons in the same order: what changed")
      ->needs(group);
  command.add_option("--out", wishes->out, "Folder of the group's page")->needs(group)->capture_default_str();
  const MatOption mat(command);
  add_common_options(command, context, {.seed = false, .range = false});
  command.callback([&context, wishes, group, folder, mat] {
    if (group->count() > 0) {
      report_group(context, *wishes);
    } else if (folder->count() > 0) {
      report_run(context, wishes->run, mat);
    } else {
      throw WrongCommandLine("report needs the folder of a run, or --group with several");
    }
  });
}

}  // namespace myoid::program
