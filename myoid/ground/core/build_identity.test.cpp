#include "myoid/ground/core/build_identity.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

#include "myoid/ground/core/provenance.h"

namespace myoid::inline ground {
namespace {

TEST(BuildIdentity, IsTheDigestOfTheProgramThatRuns) {
  std::ifstream stream("/proc/self/exe", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  ASSERT_FALSE(bytes.empty());
  EXPECT_EQ(build_identity(), sha256(bytes));
}

TEST(BuildIdentity, IsThatOfTheProgramAndNotOfTheLoaderThatWasToldToStartIt) {
  const char* loader = "/lib64/ld-linux-x86-64.so.2";
  if (access(loader, X_OK) != 0) GTEST_SKIP() << "no " << loader;
  std::ifstream stream("/proc/self/exe", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::string program = std::filesystem::read_symlink("/proc/self/exe").string();
  const std::string command = std::string(loader) + " " + program + " --gtest_filter=BuildIdentity.PrintsItself";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> child(popen(command.c_str(), "r"), &pclose);
  ASSERT_NE(child, nullptr);
  std::string told;
  for (int c = std::fgetc(child.get()); c != EOF; c = std::fgetc(child.get())) told += static_cast<char>(c);
  EXPECT_NE(told.find("identity " + sha256(bytes)), std::string::npos) << told;
}

/// The test above runs this one by the loader.
TEST(BuildIdentity, PrintsItself) {
  std::printf("identity %s\n", build_identity().c_str());
  EXPECT_EQ(build_identity().size(), 64U);
}

}  // namespace
}  // namespace myoid::inline ground
