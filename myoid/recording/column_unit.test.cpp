#include "myoid/recording/column_unit.h"

#include <gtest/gtest.h>

#include "myoid/ground/core/error.h"
#include "myoid/ground/files/atomic_file.h"

#include "tests/support/temporary_folder.h"

namespace myoid::recording {
namespace {

TEST(ColumnUnit, IsTheOneThatATableWritesOrTheFileIsRefused) {
  const test::TemporaryFolder folder;
  write_file(folder / "a.csv", "time,q [deg],m [Nmm],a [%],x\n0,1,2,3,4\n0.1,2,3,4,5\n");
  const SeriesFile file = read_series(folder / "a.csv");
  EXPECT_EQ(written_factor(file, 0), kDegree);
  EXPECT_EQ(written_factor(file, 1), 1e-3);
  EXPECT_EQ(written_factor(file, 3), 1.0);
  EXPECT_NO_THROW(require_unit("a.csv", file, 1, Unit::newton_meter));
  EXPECT_THROW(require_unit("a.csv", file, 0, Unit::newton_meter), ReadError);
  EXPECT_THROW(require_unit("a.csv", file, 2, Unit::newton_meter), ReadError);
  EXPECT_NO_THROW(require_unit("a.csv", file, 3, Unit::newton_meter));
  write_file(folder / "b.csv", "time,m [Nm/kg],q (deg),q (raw)\n0,1,2,3\n0.1,2,3,4\n");
  const SeriesFile other = read_series(folder / "b.csv");
  EXPECT_THROW(require_known_unit("b.csv", other, "m"), ReadError);
  EXPECT_NO_THROW(require_known_unit("b.csv", other, "q"));
  EXPECT_NO_THROW(require_known_unit("b.csv", other, "r"));
}

}  // namespace
}  // namespace myoid::recording
