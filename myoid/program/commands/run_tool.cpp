#include "myoid/program/commands/run_tool.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/counted.h"
#include "myoid/ground/core/json_text.h"
#include "myoid/program/commands/stage_input.h"

namespace myoid::program {

bool RunToolResult::good() const { return tool.frames_failed == 0 && !tool.wrong_unit; }

RunToolResult run_tool(const RunToolOptions& o) {
  check_word("--compat", o.compat, {"opensim", "exact"});
  Remarks remarks(o.call);
  RunToolResult result;
  result.tool = myoid::opensim::run_tool(o.setup, {.compat = body::parse_compat(o.compat),
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
