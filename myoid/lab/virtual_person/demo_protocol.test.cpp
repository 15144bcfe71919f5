#include "myoid/lab/virtual_person/demo_protocol.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/text_file.h"

#include "tests/support/places.h"
#include "tests/support/temporary_folder.h"

namespace myoid::lab {
namespace {

TEST(DemoProtocol, IsTheExample) {
  EXPECT_EQ(demo_protocol_text(), read_text_file(test::source_dir() / "examples/demo/protocol.toml"));
  EXPECT_EQ(protocol_named("demo").trials.size(), 26U);  // seven angles in each direction
}

TEST(DemoProtocol, IsNoOtherFile) {
  const auto level0 = test::source_dir() / "examples/protocols/noise_free.toml";
  EXPECT_EQ(protocol_named(level0).trials.size(), read_protocol(level0).trials.size());
  EXPECT_THROW((void)protocol_named("no_such_protocol.toml"), InvalidInput);
}

TEST(DemoProtocol, IsNotHiddenByAFolderOfItsName) {
  const test::TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  std::filesystem::create_directory("demo");
  EXPECT_EQ(protocol_text("demo"), demo_protocol_text());
  EXPECT_THROW((void)protocol_text("./demo"), InvalidInput);
  std::filesystem::current_path(before);
}

}  // namespace
}  // namespace myoid::lab
