#include "myoid/program/commands/compare.h"

#include <fmt/format.h>

#include "myoid/ground/core/error.h"
#include "myoid/page/write_report.h"
#include "myoid/results/comparison/comparison_report.h"

namespace myoid::program {

void visit(CompareOptions& o, study::SettingVisitor& v) {
  v.folder("first", o.first,
           {.says = "Folder of a run (with parameters.json).", .required = "a folder", .option = {.by_place = true}});
  v.folder("second", o.second,
           {.says = "Folder of the run to compare it with.", .required = "a folder", .option = {.by_place = true}});
  v.folder("out", o.out, {.says = "Folder for report.html, figures and tables."});
}

CompareResult compare(const CompareOptions& o) {
  std::error_code ignored;
  if (std::filesystem::equivalent(o.first, o.second, ignored)) {
    throw InvalidInput(fmt::format("{} and {} are one folder; name two runs", o.first, o.second));
  }
  Remarks remarks(o.call);
  CompareResult result;
  result.comparison = results::compare_runs(o.first, o.second);
  for (const std::string& folder : {o.first, o.second}) remarks.warn_of_changes(folder, {"parameters.json"});
  for (const std::string& text : result.comparison.failed) remarks.warn(text);
  for (const std::string& text : result.comparison.unlike)
    remarks.warn(fmt::format("{} and {}: {}", o.first, o.second, text));
  result.remarks = remarks.list();
  return result;
}

void write_compare(const CompareResult& result, const std::filesystem::path& folder) {
  page::write_report(results::comparison_report(result.comparison), folder);
}

}  // namespace myoid::program
