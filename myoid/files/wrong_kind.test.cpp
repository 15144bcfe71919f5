#include "myoid/files/wrong_kind.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "myoid/core/error.h"
#include "myoid/files/toml_table.h"
#include "myoid/tables/storage_reader.h"

namespace myoid::recording {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(WrongKind, NamesWhatTheFileIsAndWhatIsExpected) {
  EXPECT_THAT(wrong_kind("a/push.TRC", {".osim"}, "a model (.osim)"),
              AllOf(HasSubstr(".trc"), HasSubstr("markers"), HasSubstr("a model (.osim)")));
  EXPECT_EQ(wrong_kind("a.osim", {".osim"}, "a model"), "");
  EXPECT_EQ(wrong_kind("a.dat", {".osim"}, "a model"), "");
}

TEST(WrongKind, TheReadersSayIt) {
  const auto message = [](auto read) -> std::string {
    try {
      read();
    } catch (const ReadError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(message([] { static_cast<void>(parse_storage("<xml/>\n", "m.osim")); }),
              HasSubstr("m.osim: this is a .osim file (a model)"));
  EXPECT_THAT(message([] { static_cast<void>(parse_toml("<xml/>\n", "m.osim")); }),
              HasSubstr("a study or protocol (.toml) is expected"));
}

}  // namespace
}  // namespace myoid::recording
