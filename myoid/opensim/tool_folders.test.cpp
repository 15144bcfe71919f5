#include "myoid/opensim/tool_folders.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"
#include "myoid/ground/files/result_record.h"

#include "tests/support/temporary_folder.h"

namespace myoid::opensim {
namespace {

TEST(ToolFolders, AFileBelongsToTheSetUpThatClaimsItFirst) {
  const test::TemporaryFolder folder;
  ToolFolders folders;
  folders.claim(folder / "ik.mot", "a.xml");
  EXPECT_NO_THROW(folders.claim(folder / "ik.mot", "a.xml"));
  EXPECT_NO_THROW(folders.claim(folder / "id.sto", "b.xml"));
  const std::string same = folder / "./ik.mot";
  EXPECT_THROW(folders.claim(same, "b.xml"), InvalidInput);
}

TEST(ToolFolders, TheFoldersListNamesTheFilesOfAllRuns) {
  const test::TemporaryFolder folder;
  {
    ToolFolders folders;
    for (const char* name : {"ik.mot", "id.sto"}) {
      folders.claim(folder / name, "a.xml");
      write_file(folder / name, name);
    }
    EXPECT_TRUE(folders.finish().empty());
  }
  EXPECT_EQ(author_of(folder / "ik.mot"), "run-tool");
  EXPECT_EQ(author_of(folder / "id.sto"), "run-tool");
}

}  // namespace
}  // namespace myoid::opensim
