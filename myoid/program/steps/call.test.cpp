#include "myoid/program/steps/call.h"

#include <gtest/gtest.h>

namespace myoid::program {
namespace {

TEST(Remarks, AreHeardWhenTheyAreMadeAndKeptInOrder) {
  std::vector<std::string> heard;
  Call call;
  call.listener = [&](const Remark& remark) { heard.push_back(remark.says); };
  Remarks remarks(call);
  remarks.warn("first");
  EXPECT_EQ(heard, std::vector<std::string>{"first"});
  remarks.note("second");
  remarks.detail("third");
  ASSERT_EQ(remarks.list().size(), 3U);
  EXPECT_EQ(remarks.list()[0].severity, Severity::warning);
  EXPECT_EQ(remarks.list()[1].severity, Severity::note);
  EXPECT_EQ(remarks.list()[2].severity, Severity::detail);
  EXPECT_EQ(heard, (std::vector<std::string>{"first", "second", "third"}));
}

}  // namespace
}  // namespace myoid::program
