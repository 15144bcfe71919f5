#include "myoid/program/commands/report.h"

#include <nlohmann/json.hpp>

#include "myoid/page/write_report.h"
#include "myoid/program/cli/context.h"
#include "myoid/program/cli/options.h"
#include "myoid/program/cli/wrong_line.h"
#include "myoid/results/cohort/group_report.h"

namespace myoid::program {
namespace {

void print_page(const std::filesystem::path& folder, const Context& context) {
  const std::string page = (folder / "report.html").string();
  context.print({{"report", page}}, page);
}

void report_run(Context& context, const program::ReportOptions& o) {
  prepare_mat(context, o.mat, {});
  const program::ReportResult result = program::report(o);
  context.prepare_run_folder(o.folder);
  program::write_report(result, o.folder);
  write_mat(o.mat, o.folder);
  context.end_progress();
  print_page(o.folder, context);
}

void report_group(Context& context, const program::ReportOptions& o) {
  context.prepare_folder(o.out);
  const page::Report page = results::group_report(o.group());
  for (const page::Gate& gate : page.gates) context.warn(gate.value);
  page::write_report(page, o.out);
  print_page(o.out, context);
}

void carry_out(Context& context, const ReportOptions& o, const CLI::App& /*command*/) {
  if (!o.persons.empty()) return report_group(context, o);
  if (o.folder.empty()) throw WrongCommandLine("report needs the folder of a run, or --group with several");
  context.overwrite = true;  // everything that this command writes is made anew
  report_run(context, o);
}

}  // namespace

void add_report(CLI::App& app, Context& context) {
  add_command<ReportOptions>(
      app, context, "report",
      "Rebuilds the report of a finished run from its recordings, provided that none of them has "
      "changed since; or sets many finished runs side by side.\n"
      "Example: myoid report results\n"
      "Example: myoid report --group results/P01 results/P02 results/P03 --out group",
      {.seed = false, .range = false}, carry_out);
}

}  // namespace myoid::program
