#include "myoid/program/commands/run_tool.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace myoid::program {
namespace {

TEST(RunToolFunction, IsGoodIfEveryFrameIsSolvedInTheRightUnit) {
  RunToolResult result;
  EXPECT_TRUE(result.good());
  result.tool.wrong_unit = true;
  EXPECT_FALSE(result.good());
  result.tool.wrong_unit = false;
  result.tool.frames_failed = 1;
  EXPECT_FALSE(result.good());
}

TEST(RunToolFunction, ItsJsonHoldsTheFieldsThatScriptsRead) {
  RunToolResult result;
  result.tool.tool = "ScaleTool";
  result.tool.files = {"a.osim"};
  result.tool.frames = 3;
  const nlohmann::json json = nlohmann::json::parse(run_tool_json(result));
  EXPECT_EQ(json.at("tool"), "ScaleTool");
  EXPECT_EQ(json.at("frames"), 3);
  EXPECT_EQ(json.at("frames_failed"), 0);
  EXPECT_EQ(json.at("files").at(0), "a.osim");
  EXPECT_TRUE(json.at("notes").empty());
  EXPECT_TRUE(json.contains("summary"));
}

}  // namespace
}  // namespace myoid::program
