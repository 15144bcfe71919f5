#include "myoid/program/commands/run_tool.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/json_text.h"

namespace myoid::program {

bool RunToolResult::good() const { return tool.frames_failed == 0 && !tool.wrong_unit; }

void visit(RunToolOptions& o, study::SettingVisitor& v) {
  v.path("setup", o.setup, {.says = "Set-up file (.xml).", .required = "a file", .option = {.by_place = true}});
  visit_setup_run(o, v);
}

void visit_setup_run(RunToolOptions& o, study::SettingVisitor& v) {
  v.path("model", o.files.model, {.says = "Model (.osim), instead of the set-up's."});
  v.path("motion", o.files.motion,
         {.says = "Coordinates or states (.mot, .sto), for inverse kinematics and scaling markers (.trc), instead of "
                  "the set-up's."});
  v.path("external-loads", o.files.external_loads, {.says = "External loads (.xml), instead of the set-up's."});
  v.folder("out", o.files.out,
           {.says = "Folder of the results, instead of the set-up's; of several set-ups a folder in it for each."});
  v.flag("anywhere", o.anywhere,
         {.says = "Write outside the folder of the set-up too, where the set-up says so.", .otherwise = "refused"});
  v.choice("compat", o.compat,
           {.says = "opensim: paths of muscles as OpenSim 4.5.2 computes them; exact: as their geometry is."});
}

RunToolResult run_tool(const RunToolOptions& o) {
  Remarks remarks(o.call);
  RunToolResult result;
  result.tool = myoid::opensim::run_tool(o.setup, {.compat = body::compat_of(o.compat),
                                                   .files = o.files,
                                                   .anywhere = o.anywhere,
                                                   .progress = o.call.progress,
                                                   .folders = o.folders});
  for (const Remark& remark : result.tool.remarks) remarks.add(remark);
  if (result.tool.replaced > 0)
    remarks.note(fmt::format("{} of an earlier run {} replaced",
                             counted(static_cast<std::size_t>(result.tool.replaced), "file"),
                             result.tool.replaced == 1 ? "is" : "are"));
  result.remarks = remarks.list();
  return result;
}

nlohmann::ordered_json run_tool_object(const RunToolResult& result) {
  const opensim::ToolResult& tool = result.tool;
  nlohmann::ordered_json json{{"tool", tool.tool},
                              {"summary", tool.summary},
                              {"frames", tool.frames},
                              {"frames_failed", tool.frames_failed},
                              {"notes", sentences(tool.remarks)}};
  for (const std::filesystem::path& file : tool.files) json["files"].push_back(file.string());
  return json;
}

std::string run_tool_json(const RunToolResult& result) { return json_text(run_tool_object(result)) + "\n"; }

}  // namespace myoid::program
