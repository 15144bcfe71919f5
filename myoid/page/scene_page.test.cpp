#include "myoid/page/scene_page.h"

#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "myoid/ground/core/error.h"

#include "tests/support/packed_codes.h"
#include "tests/support/small_scene.h"

namespace myoid::page {
namespace {

using nlohmann::json;
using test::small_scene;
using testing::HasSubstr;
using testing::Not;

std::string page_of(std::vector<Scene> scenes) {
  return scene_page({.title = "Arm & <hand>", .subtitle = "S01", .scenes = std::move(scenes)});
}

/// The JSON that the viewer reads.
json data_of(const std::string& page) {
  const std::string begin = "<script type=\"application/json\" id=\"scene\">";
  const std::size_t from = page.find(begin) + begin.size();
  return json::parse(page.substr(from, page.find("</script>", from) - from));
}

class ScenePageTest : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_viewer()) GTEST_SKIP() << "built without three.js or esbuild";
  }
};

TEST_F(ScenePageTest, HoldsEveryNameAndNumberOfFrames) {
  const json j = data_of(page_of({small_scene(), small_scene()}));
  EXPECT_EQ(j["title"], "Arm & <hand>");
  ASSERT_EQ(j["scenes"].size(), 2U);
  const json& scene = j["scenes"][1];
  EXPECT_EQ(scene["name"], "flex <slow>");
  EXPECT_EQ(scene["frames"], 2);
  // Both trials have one model.
  ASSERT_EQ(j["models"].size(), 1U);
  EXPECT_EQ(scene["model"], 0);
  const json& model = j["models"][0];
  EXPECT_EQ(model["bodies"][1]["name"], "forearm");
  EXPECT_EQ(model["bodies"][1]["sticks"][0][1], json({0.0, -0.25, 0.0}));
  EXPECT_EQ(model["muscles"][0]["points"][1], json({1, 0.02, -0.04, 0.0}));
  EXPECT_EQ(model["muscles"][1]["points"], json::array());
  EXPECT_EQ(scene["lines"]["muscles"], json({1}));
  EXPECT_EQ(test::read_codes(scene["lines"]["counts"]), (std::vector<int>{2, 3}));
  EXPECT_EQ(scene["values"][0]["unit"], "N");
  // Frame by frame: 0.1 and 0.2 of 4094, all of it, missing.
  EXPECT_EQ(test::read_codes(scene["values"][0]["numbers"], 2), (std::vector<int>{409, 819, 4094, 4095}));
  EXPECT_EQ(scene["measured"]["markers"], json({0}));
  EXPECT_EQ(model["surfaces"][0]["kind"], "cylinder");
}

TEST_F(ScenePageTest, IsOneFileThatLoadsNothing) {
  const std::string page = page_of({small_scene()});
  // Namespaces of SVG and XHTML are names, not addresses to load.
  const std::regex loading(R"re((<(script|img|link|iframe)[^>]*(src|href)\s*=)|@import|url\()re");
  const std::string head = page.substr(0, page.find("<script>"));
  EXPECT_FALSE(std::regex_search(head, loading));
  EXPECT_THAT(page, Not(HasSubstr("<script src")));
  EXPECT_THAT(page, Not(HasSubstr("<link")));
  EXPECT_THAT(page, HasSubstr("three.js authors"));
}

TEST_F(ScenePageTest, CannotBeLeftThroughAName) {
  Scene scene = small_scene();
  scene.name = "</script><script>alert(1)</script>";
  scene.muscles[0].name = "bad \xff utf-8";
  const std::string page = page_of({scene});
  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_THAT(page, HasSubstr("<title>Arm &amp; &lt;hand&gt;</title>"));
  EXPECT_EQ(data_of(page)["scenes"][0]["name"], scene.name);
}

TEST_F(ScenePageTest, HoldsEachMeshOnce) {
  ScenePage page{.title = "t", .scenes = {small_scene(), small_scene()}};
  page.meshes = {{.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}}}};
  for (Scene& scene : page.scenes) scene.bodies[1].meshes = {0};
  const json j = data_of(scene_page(page));
  EXPECT_EQ(j["meshes"].size(), 1U);
  EXPECT_EQ(test::read_codes(j["meshes"][0]["corners"], 3), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(j["models"][j["scenes"][1]["model"].get<std::size_t>()]["bodies"][1]["meshes"], json({0}));
  page.meshes[0].triangles[0][2] = 3;
  EXPECT_THROW((void)scene_page(page), InvalidInput);
  page.meshes.clear();
  EXPECT_THROW((void)scene_page(page), InvalidInput);
}

TEST_F(ScenePageTest, RefusesWhatIsNoScene) {
  EXPECT_THROW((void)page_of({}), InvalidInput);
  Scene scene = small_scene();
  scene.poses.clear();
  EXPECT_THROW((void)page_of({scene}), InvalidInput);
}

}  // namespace
}  // namespace myoid::page
