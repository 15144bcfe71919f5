#include "myoid/page/viewer_bundle.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/page/scene_page.h"

namespace myoid::page {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ViewerBundle, HoldsScriptStyleAndTheLicenseOfWhatIsInIt) {
  if (!has_viewer()) GTEST_SKIP() << "built without three.js or esbuild";
  const ViewerBundle bundle = viewer_bundle();
  EXPECT_THAT(std::string(bundle.license), testing::AllOf(HasSubstr("MIT License"), HasSubstr("three.js authors")));
  EXPECT_THAT(std::string(bundle.style), HasSubstr("canvas"));
  EXPECT_GT(bundle.script.size(), 100'000U);  // three.js is in it
  EXPECT_LT(bundle.script.size(), 700'000U);  // and nothing else of that size
}

TEST(ViewerBundle, CanStandInsideAPage) {
  const ViewerBundle bundle = viewer_bundle();
  EXPECT_THAT(std::string(bundle.script), Not(HasSubstr("</script")));
  EXPECT_THAT(std::string(bundle.style), Not(HasSubstr("</style")));
  EXPECT_THAT(std::string(bundle.license), Not(HasSubstr("-->")));
}

}  // namespace
}  // namespace myoid::page
