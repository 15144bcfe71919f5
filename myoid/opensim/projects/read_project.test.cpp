#include "myoid/opensim/projects/read_project.h"

#include <gtest/gtest.h>

#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::opensim {
namespace {

TEST(ReadProject, IsEmptyForWhatIsNone) {
  const test::TemporaryFolder folder;
  EXPECT_FALSE(read_project(folder.path()));
  EXPECT_FALSE(read_project(folder / "none"));
  write_file(folder / "a.xml", "<OpenSimDocument><InverseKinematicsTool/></OpenSimDocument>");
  write_file(folder / "subject.xml", "<subject><age>3</age></subject>");
  EXPECT_FALSE(read_project(folder.path()));
  EXPECT_FALSE(read_project(folder / "a.xml"));
}

}  // namespace
}  // namespace myoid::opensim
