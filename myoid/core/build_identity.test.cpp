#include "myoid/core/build_identity.h"

#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>

#include "myoid/core/provenance.h"

namespace myoid {
namespace {

TEST(BuildIdentity, IsTheDigestOfTheProgramThatRuns) {
  std::ifstream stream("/proc/self/exe", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  ASSERT_FALSE(bytes.empty());
  EXPECT_EQ(build_identity(), sha256(bytes));
}

}  // namespace
}  // namespace myoid
