// The modules of the viewer by their own tests (myoid/page/viewer/*.test.js), in a browser.
#include <algorithm>
#include <cstdlib>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "browser.h"
#include "program.h"
#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace {

namespace fs = std::filesystem;
using myoid::test::there_is;
using myoid::test::write_text;

TEST(ViewerModules, PassTheirOwnTests) {
  const std::string three = MYOID_THREE;
  if (!there_is("chromium") || !there_is("esbuild") || !fs::exists(three))
    GTEST_SKIP() << "needs the packages chromium, esbuild and libjs-three";
  const fs::path viewer = fs::path(myoid::test::source_dir()) / "myoid/page/viewer";
  std::vector<std::string> modules;
  for (const fs::directory_entry& file : fs::directory_iterator(viewer))
    if (file.path().string().ends_with(".test.js")) modules.push_back(file.path());
  std::sort(modules.begin(), modules.end());
  ASSERT_FALSE(modules.empty());
  std::string all;
  for (const std::string& module : modules) all += fmt::format("import '{}';\n", module);
  all += fmt::format("import {{ results }} from '{}';\nwindow.tested = results();\n", (viewer / "testing.js").string());
  const myoid::test::TemporaryFolder folder;
  write_text(folder / "all.js", all);
  write_text(folder / "page.html",
             "<!DOCTYPE html><body data-state=\"ready\"><script src=\"bundle.js\"></script></body>");
  const std::string bundle =
      fmt::format("esbuild '{}' --bundle --format=iife --log-level=warning --alias:three='{}' --outfile='{}'",
                  std::string(folder / "all.js"), three, std::string(folder / "bundle.js"));
  ASSERT_EQ(std::system(bundle.c_str()), 0);
  myoid::test::Browser browser(800, 600);
  browser.open("file://" + std::string(folder / "page.html"));
  const nlohmann::json tested = browser.evaluate("window.tested || []");
  EXPECT_GE(tested.size(), modules.size()) << testing::PrintToString(browser.complaints());
  for (const nlohmann::json& one : tested) EXPECT_EQ(one[1], "") << one[0];
}

}  // namespace
