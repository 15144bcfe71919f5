#include "myoid/ground/files/named_file.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace myoid::inline ground {
namespace {

namespace fs = std::filesystem;

class NamedFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder_ / "setup" / "data");
    for (const char* name : {"setup/ik.mot", "setup/data/grf.mot", "model.osim", "setup/Walk.TRC"})
      std::ofstream(folder_ / name) << "x";
  }
  [[nodiscard]] NamedFile find(const char* name) const { return find_named_file(folder_ / "setup", name); }
  test::TemporaryFolder temporary_;
  fs::path folder_ = temporary_.path();
};

TEST_F(NamedFiles, ANameThatHoldsIsTakenWithoutANote) {
  for (const char* name : {"ik.mot", "./ik.mot", ".\\ik.mot", "data\\grf.mot", " ../model.osim "}) {
    const NamedFile found = find(name);
    EXPECT_TRUE(found.exists) << name;
    EXPECT_EQ(found.note, "") << name;
  }
  EXPECT_EQ(find((folder_ / "model.osim").c_str()).note, "");
}

TEST_F(NamedFiles, ANameFromAnotherComputerStandsForTheFileBesideOrOneFolderUp) {
  for (const auto& [name, place] :
       {std::pair{"C:\\Users\\jane\\trial\\ik.mot", "setup/ik.mot"}, std::pair{"D:/work/ik.mot", "setup/ik.mot"},
        std::pair{"\\\\server\\share\\walk\\ik.mot", "setup/ik.mot"},
        std::pair{"C:\\Users/jane\\data\\grf.mot", "setup/data/grf.mot"},
        std::pair{"/home/jane/models/model.osim", "model.osim"}, std::pair{"..\\..\\models\\model.osim", "model.osim"},
        std::pair{"c:\\trial\\walk.trc", "setup/Walk.TRC"}}) {
    const NamedFile found = find(name);
    EXPECT_TRUE(found.exists) << name;
    std::error_code ignored;
    EXPECT_TRUE(fs::equivalent(found.path, folder_ / place, ignored)) << name << found.path;
    EXPECT_THAT(found.note, ::testing::HasSubstr(name));
  }
}

TEST_F(NamedFiles, AFileThatIsNowhereStaysWhereItIsNamed) {
  const std::string long_name(5000, 'a');
  for (const char* name : {"none.mot", "C:\\trial\\none.mot", "data", "", "//", long_name.c_str()})
    EXPECT_FALSE(find(name).exists) << name;
  EXPECT_EQ(find("sub\\none.mot").path, folder_ / "setup" / "sub/none.mot");
  // Two files differ only in case: neither is meant.
  std::ofstream(folder_ / "setup" / "WALK.trc") << "x";
  EXPECT_FALSE(find("walk.trc").exists);
}

TEST_F(NamedFiles, WindowsPathsAreKnownByDriveOrServer) {
  EXPECT_TRUE(is_windows_path("C:\\a"));
  EXPECT_TRUE(is_windows_path("c:/a"));
  EXPECT_TRUE(is_windows_path("\\\\server\\a"));
  EXPECT_FALSE(is_windows_path("a\\b"));
  EXPECT_FALSE(is_windows_path("/home/a"));
  EXPECT_EQ(last_part("C:\\a\\b.sto"), "b.sto");
  EXPECT_EQ(last_part("b.sto"), "b.sto");
}

}  // namespace
}  // namespace myoid::inline ground
